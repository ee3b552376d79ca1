#include "tools/lab/cost/cost_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "peeling/registry.h"
#include "peeling/truth/chain_list.h"
#include "tools/lab/bench/bench_report.h"
#include "tools/lab/cost/cost_run.h"
#include "tools/strata/options/choices.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

constexpr std::array cost_columns{"cell",
                                  "scene",
                                  "knob",
                                  "value",
                                  "opened",
                                  "outcome",
                                  "max_difference",
                                  "rmse",
                                  "psnr",
                                  "pixels_differ",
                                  "ssim",
                                  "order_errors",
                                  "from_default",
                                  "layers",
                                  "geometry_passes",
                                  "full_screen_passes",
                                  "vertices",
                                  "fragments",
                                  "bytes",
                                  "bytes_per_pixel",
                                  "modelled_seconds",
                                  "printed_seconds"};

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

// A text with a comma is quoted; none of these contains a quotation mark.
[[nodiscard]] std::string cost_field(const ordered_json& value) {
    if (value.is_null()) return "";
    if (!value.is_string()) return value.dump();
    const auto text = value.get<std::string>();
    return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

[[nodiscard]] std::optional<Spread> spread_in(const ordered_json& timing, const char* key) {
    if (!timing.contains(key) || timing[key].is_null()) return std::nullopt;
    const ordered_json& s = timing[key];
    return Spread{s["median"], s["least"], s["greatest"], s["rounds"]};
}

// Divides by the smallest median of each scene, so that its cheapest cell has 1.
template <class Median, class Scale>
void relate(std::vector<CostRow>& rows, Median median, Scale scale) {
    std::map<std::string, double> least;
    for (CostRow& row : rows)
        if (const auto value = median(row)) {
            const auto [found, is_new] = least.emplace(row.scene, *value);
            if (!is_new) found->second = std::min(found->second, *value);
        }
    for (CostRow& row : rows)
        if (median(row)) scale(row, 1 / least[row.scene]);
}

void relate_spread(std::vector<CostRow>& rows, std::optional<Spread> CostRow::*column) {
    relate(
        rows, [&](const CostRow& row) { return row.*column ? std::optional((row.*column)->median) : std::nullopt; },
        [&](CostRow& row, double factor) {
            Spread& s = *(row.*column);
            s = {s.median * factor, s.least * factor, s.greatest * factor, s.runs};
        });
}

// The oracle is not a device's algorithm, sorting triangles is work of the CPU, and what programs read and write in
// buffers is not counted: the card's rates do not apply.
[[nodiscard]] bool runs_on_a_card(const std::string& name) {
    const peeling::Algorithm* const algorithm = peeling::find_algorithm(name);
    if (algorithm == nullptr) return true;
    const bool has_buffers =
        std::ranges::find(algorithm->features, pipeline::Feature::unordered_access) != algorithm->features.end();
    return !algorithm->is_oracle && !has_buffers && algorithm->order != peeling::ListOrder::back_to_front;
}

}  // namespace

std::vector<std::string> cost_keys() { return {cost_columns.begin(), cost_columns.end()}; }

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
    line["order_errors"] = or_null(result.order_errors);
    line["from_default"] = if_ran(result.from_default);
    line["layers"] = if_drawn(result.layers);
    line["geometry_passes"] = if_drawn(result.passes.geometry);
    line["full_screen_passes"] = if_drawn(result.passes.full_screen);
    line["vertices"] = if_drawn(result.work.vertices);
    line["fragments"] = if_drawn(result.work.fragments);
    line["bytes"] = if_drawn(result.work.bytes);
    line["bytes_per_pixel"] = if_drawn(result.bytes_per_pixel);
    line["modelled_seconds"] = if_drawn(result.modelled);
    line["printed_seconds"] = or_null(is_drawn ? printed_seconds(scene.name, cell.algorithm->name) : std::nullopt);
    return line;
}

ordered_json cost_timing(std::size_t number, const CostTimes& times) {
    return {{"cell", number},
            {"seconds", to_json(times.seconds)},
            {"default", to_json(times.ratios)},
            {"literal", to_json(times.literal)}};
}

std::string cost_csv(const Lines& lines) {
    std::string text = fmt::format("{}\n", fmt::join(cost_columns, ","));
    for (const ordered_json& line : lines) {
        std::vector<std::string> fields;
        for (const char* column : cost_columns) fields.push_back(cost_field(line.at(column)));
        text += fmt::format("{}\n", fmt::join(fields, ","));
    }
    return text;
}

std::vector<CostRow> cost_rows(const Lines& lines, const Lines& timings) {
    std::map<std::size_t, const ordered_json*> timing_of;
    for (const ordered_json& timing : timings) timing_of[timing.at("cell").get<std::size_t>()] = &timing;
    std::vector<CostRow> rows;
    for (const ordered_json& line : lines) {
        CostRow row;
        row.scene = line.at("scene");
        row.knob = line.at("knob");
        row.value = line.at("value");
        row.opened = line.at("opened");
        row.refusal = line.at("refusal");
        if (row.refusal.empty()) {
            row.rmse = line.at("rmse");
            row.from_default = line.at("from_default");
        }
        if (runs_on_a_card(line.at("algorithm").get<std::string>()) && !line.at("modelled_seconds").is_null())
            row.modelled = line.at("modelled_seconds").get<double>();
        if (const auto timing = timing_of.find(line.at("cell")); timing != timing_of.end()) {
            row.usual = spread_in(*timing->second, "default");
            row.literal = spread_in(*timing->second, "literal");
        }
        rows.push_back(std::move(row));
    }
    relate_spread(rows, &CostRow::usual);
    relate_spread(rows, &CostRow::literal);
    relate(
        rows, [](const CostRow& row) { return row.modelled; },
        [](CostRow& row, double factor) { *row.modelled *= factor; });
    return rows;
}

}  // namespace strata::tools
