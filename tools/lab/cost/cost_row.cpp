#include "tools/lab/cost/cost_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "peeling/registry.h"
#include "peeling/truth/chain_list.h"
#include "tools/lab/bench/spread.h"
#include "tools/lab/cost/cost_run.h"
#include "tools/lab/sweep/csv.h"
#include "tools/strata/options/choices.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

constexpr std::array cost_columns{"/cell",
                                  "/scene",
                                  "/knob",
                                  "/value",
                                  "/opened",
                                  "/outcome",
                                  "/max_difference",
                                  "/rmse",
                                  "/psnr",
                                  "/pixels_differ",
                                  "/ssim",
                                  "/sorted_rmse",
                                  "/order_errors",
                                  "/from_default",
                                  "/layers",
                                  "/geometry_passes",
                                  "/full_screen_passes",
                                  "/vertices",
                                  "/fragments",
                                  "/bytes",
                                  "/bytes_per_pixel",
                                  "/modelled_seconds",
                                  "/printed_seconds"};

template <class T>
[[nodiscard]] ordered_json or_null(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

[[nodiscard]] ordered_json to_json(const std::vector<double>& values) {
    if (values.empty()) return nullptr;
    const Spread spread = spread_of(values);
    return {
        {"median", spread.median}, {"least", spread.least}, {"greatest", spread.greatest}, {"rounds", values.size()}};
}

// The oracle is not a device's algorithm, sorting triangles is work of the CPU, and what programs read and write in
// buffers is not counted: the card's rates do not apply.
[[nodiscard]] bool runs_on_a_card(const peeling::Algorithm& algorithm) {
    const bool has_buffers =
        std::ranges::find(algorithm.features, pipeline::Feature::unordered_access) != algorithm.features.end();
    return !algorithm.is_oracle && !has_buffers && algorithm.order != peeling::ListOrder::back_to_front;
}

}  // namespace

ordered_json cost_description(std::size_t number, const CostScene& scene, const CostCell& cell) {
    const peeling::ChainScene asked{scene.session.scene.list, scene.session.view, cell.profile, cell.options};
    const bool has_limit = cell.options.termination.rule == pipeline::TerminationRule::fixed;
    return {{"cell", number},
            {"scene", scene.name},
            {"width", cell.options.width},
            {"height", cell.options.height},
            {"profile", cell.profile.name},
            {"knob", cell.knob},
            {"value", cell.value},
            {"opened", cell.opened},
            {"algorithm", cell.algorithm->name},
            {"subpixel_bits", cell.profile.raster.subpixel_bits},
            {"depth_format", name_of(depth_formats, asked.depth().format)},
            {"depth_path", name_of(depth_paths(), asked.depth().path)},
            {"color_format", name_of(color_formats, asked.color_format())},
            {"average_count", name_of(count_formats, cell.options.average_count)},
            {"peels", has_limit ? cell.options.termination.passes : 0},
            {"execution", name_of(executions, cell.options.execution)},
            {"effects", name_of(effects, cell.options.effects)}};
}

ordered_json cost_line(std::size_t number, const CostScene& scene, const CostCell& cell, const CostResult& result) {
    ordered_json line = cost_description(number, scene, cell);
    const bool ran = result.refusal.empty(), is_drawn = ran && !cell.chain;
    const auto if_drawn = [&](const ordered_json& value) { return is_drawn ? value : ordered_json(nullptr); };
    const auto if_ran = [&](const ordered_json& value) { return ran ? value : ordered_json(nullptr); };
    line["outcome"] = ran ? "done" : "refused";
    line["refusal"] = result.refusal;
    line["max_difference"] = if_ran(result.error.max_difference);
    line["rmse"] = if_ran(result.error.rmse);
    line["psnr"] = or_null(result.error.psnr);
    line["pixels_differ"] = if_ran(result.error.pixels);
    line["ssim"] = if_ran(result.error.ssim);
    line["sorted_rmse"] = or_null(result.sorted_rmse);
    line["order_errors"] = or_null(result.order_errors);
    line["from_default"] = if_ran(result.from_default);
    line["layers"] = if_drawn(result.layers);
    line["geometry_passes"] = if_drawn(result.passes.geometry);
    line["full_screen_passes"] = if_drawn(result.passes.full_screen);
    line["vertices"] = if_drawn(result.work.vertices);
    line["fragments"] = if_drawn(result.work.fragments);
    line["bytes"] = if_drawn(result.work.bytes);
    line["bytes_per_pixel"] = if_drawn(result.bytes_per_pixel);
    line["modelled_seconds"] =
        is_drawn && runs_on_a_card(*cell.algorithm) ? ordered_json(result.modelled) : ordered_json(nullptr);
    line["printed_seconds"] = or_null(is_drawn ? printed_seconds(scene.name, cell.algorithm->name) : std::nullopt);
    return line;
}

ordered_json cost_timing(std::size_t number, const CostTimes& times) {
    return {{"cell", number},
            {"seconds", to_json(times.seconds)},
            {"default", to_json(times.ratios)},
            {"literal", to_json(times.literal)}};
}

std::string cost_csv(const Lines& lines) { return csv_of_columns({cost_columns.begin(), cost_columns.end()}, lines); }

}  // namespace strata::tools
