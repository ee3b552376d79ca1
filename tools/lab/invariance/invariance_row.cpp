// tools/lab/invariance/invariance_row.cpp - writes a cell and its result as JSON and CSV: settings, errors, witnesses,
// advice (invariance_row.h).
#include "tools/lab/invariance/invariance_row.h"

#include <fmt/format.h>

#include <filesystem>

#include "peeling/algorithms/algorithm.h"
#include "peeling/registry.h"
#include "tools/lab/invariance/invariance_summary.h"
#include "tools/lab/sweep/csv.h"
#include "tools/request/choices.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// The columns of results.csv: the description of the measurement, and the results that a printed table needs.
// results.jsonl has all keys.
constexpr std::array columns{"cell",
                             "scene",
                             "width",
                             "height",
                             "profile",
                             "algorithm",
                             "orbit",
                             "camera",
                             "alpha",
                             "write_path",
                             "compare_path",
                             "depth_format",
                             "subpixel_bits",
                             "near",
                             "far",
                             "remedy",
                             "bias_constant",
                             "bias_slope",
                             "compare_epsilon",
                             "vertex_path",
                             "quantize_reference",
                             "split",
                             "hypothesis",
                             "max_passes",
                             "fragments",
                             "differing",
                             "ulp_max",
                             "passes",
                             "layers_true",
                             "duplicated",
                             "lost",
                             "pixels_touched",
                             "max_difference",
                             "rmse",
                             "psnr",
                             "safe_bias",
                             "outcome"};

// The pair of fragments that determines a value (scenes/reference/reports.md 5.2). `width` is for converting the
// pixel's index to x and y.
ordered_json witness(const peeling::PathPair& pair, int width) {
    return {{"x", static_cast<int>(pair.pixel) % width},
            {"y", static_cast<int>(pair.pixel) / width},
            {"primitive", pair.primitive},
            {"stored", fmt::format("0x{:08x}", pair.stored)},
            {"reference", fmt::format("0x{:08x}", pair.reference)}};
}

// The interval, or, if it is empty, the fragment that is peeled twice below `lowest` and the pair that loses one above
// `highest`.
ordered_json to_json(const std::optional<peeling::SafeRange>& found, int width) {
    if (!found) return nullptr;
    const peeling::SafeRange& range = *found;
    ordered_json json{{"safe", !range.is_empty()}, {"lowest", nullptr}, {"highest", nullptr}};
    if (range.lowest) json["lowest"] = *range.lowest;
    if (range.highest) json["highest"] = *range.highest;
    if (range.lowest) json["repeated_below"] = witness(range.repeated, width);
    if (range.highest) json["lost_above"] = witness(range.behind_opaque ? range.front : range.behind, width);
    if (range.highest && !range.behind_opaque) json["lost_behind"] = witness(range.front, width);
    return json;
}

// Shortest form: reads back to the same double.
ordered_json to_json(const std::optional<peeling::SafeAbsolute>& range) {
    if (!range) return nullptr;
    ordered_json json{{"safe", !range->is_empty}, {"lowest", nullptr}, {"highest", nullptr}};
    if (range->lowest) json["lowest"] = *range->lowest;
    if (range->highest) json["highest"] = *range->highest;
    return json;
}

// Bins of differences in codes: lowest, highest, count (peeling/reference/audit.md 8.2).
ordered_json histogram(const peeling::PathComparison& paths) {
    ordered_json bins = ordered_json::array();
    for (const peeling::UlpBin& bin : paths.histogram) bins.push_back({bin.low, bin.high, bin.count});
    return bins;
}

// The keys after `refusal`, in the order of scenes/reference/reports.md 5.2. A refused cell has them, too, with counts
// of 0.
void add_findings(ordered_json& line, const Cell& cell, const peeling::Measurement& m) {
    const bool ran = !m.refusal && m.peeled;
    line["fragments"] = m.paths.fragments;
    line["differing"] = m.paths.differing;
    line["unmatched"] = m.paths.unmatched;
    // Only the magnitude; its sign is in the histogram.
    line["ulp_max"] = m.paths.largest < 0 ? -m.paths.largest : m.paths.largest;
    line["ulp_max_at"] = m.paths.differing > 0 ? witness(m.paths.where, cell.width) : ordered_json(nullptr);
    line["histogram"] = histogram(m.paths);
    line["passes"] = m.passes;
    line["layers_true"] = m.errors.layers_max;
    line["layers"] = m.errors.layers;
    line["duplicated"] = m.errors.duplicated;
    line["lost"] = m.errors.lost;
    line["pixels_touched"] = m.errors.touched.pixels;
    line["first_touched"] = {m.errors.touched.first_x, m.errors.touched.first_y};
    line["max_difference"] = m.image.max_difference;
    line["rmse"] = m.image.rmse;
    line["psnr"] = m.image.psnr ? ordered_json(*m.image.psnr) : ordered_json(nullptr);
    line["digest"] = ran ? pipeline::digest(m.picture) : "";
    line["safe_epsilon_ulps"] = to_json(m.advice.epsilon_ulps, cell.width);
    line["safe_epsilon"] = to_json(m.advice.epsilon);
    line["safe_bias"] = to_json(m.advice.bias, cell.width);
}

// The double whose shortest decimals are those of the float: 0.1f becomes 0.1, not 0.10000000149.
double shortest(float value) { return *to_number<double>(fmt::format("{}", value)); }

// Results contain no path: only a file's name.
std::string without_folder(const std::string& name) {
    return scenes::is_procedural(name) ? name : std::filesystem::path(name).filename().string();
}

// One of the outcomes of scenes/reference/reports.md 5.2.
std::string outcome(const CellResult& result) {
    if (!result.refusal.empty()) return "refused";
    if (!result.measured.peeled) return "compared";
    return result.measured.ended ? "done" : "never_ends";
}

}  // namespace

ordered_json description(std::size_t number, const Cell& cell, const CellView& view) {
    // The path that is really written: a remedy may replace the cell's own.
    const auto write = cell.remedy.depth_replace ? rasterizer::DepthPath::depth_replace : cell.write;
    // A view of the scene's own has no given angles or planes.
    const auto unless_own = [&](const ordered_json& value) { return view.is_own ? ordered_json(nullptr) : value; };
    return {{"cell", number},
            {"scene", without_folder(cell.scene)},
            {"width", cell.width},
            {"height", cell.height},
            {"profile", without_folder(cell.profile)},
            {"algorithm", cell.algorithm->name},
            {"orbit", unless_own({cell.azimuth, cell.elevation})},
            {"camera", cell.camera.empty() ? ordered_json(nullptr) : ordered_json(without_folder(cell.camera))},
            {"alpha", shortest(cell.alpha)},
            {"write_path", name_of(depth_paths(), write)},
            {"compare_path", name_of(depth_paths(), cell.compare)},
            {"depth_format", name_of(depth_formats, cell.format)},
            {"subpixel_bits", view.subpixel_bits},
            {"near", unless_own(view.near)},
            {"far", unless_own(view.far)},
            {"remedy", name_of(cell.remedy)},
            {"bias_constant", shortest(cell.remedy.bias_constant)},
            {"bias_slope", shortest(cell.remedy.bias_slope)},
            {"compare_epsilon", cell.remedy.epsilon_text},
            {"vertex_path", cell.vertex_path},
            {"quantize_reference", cell.remedy.quantize_reference},
            {"split", name_of(cell.split)},
            {"hypothesis", cell.hypothesis},
            {"max_passes", cell.max_passes}};
}

ordered_json to_line(std::size_t number, const Cell& cell, const CellResult& result) {
    ordered_json line = description(number, cell, result.view);
    line["outcome"] = outcome(result);
    line["refusal"] = result.refusal;
    add_findings(line, cell, result.measured);
    return line;
}

std::string csv_header() { return fmt::format("{}\n", fmt::join(columns, ",")); }

std::string to_csv(const ordered_json& line) {
    std::vector<std::string> fields;
    const bool is_peeled = line.at("outcome") == "done" || line.at("outcome") == "never_ends";
    for (const std::string key : columns) {
        const ordered_json& value = line.at(key);
        if (key == "orbit" && !value.is_null())
            fields.push_back(csv_field(orbit_text(value)));
        else if (key == "safe_bias")
            fields.push_back(safe_text(value));
        else if (key == "psnr" && value.is_null())  // of equal images, or of none
            fields.push_back(is_peeled ? "inf" : "");
        else
            fields.push_back(value.is_null() ? "" : csv_field(value));
    }
    return fmt::format("{}\n", fmt::join(fields, ","));
}

std::string csv_of(const Lines& lines) {
    std::string text = csv_header();
    for (const ordered_json& line : lines) text += to_csv(line);
    return text;
}

}  // namespace strata::tools
