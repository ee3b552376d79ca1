// tools/lab/invariance/precision.cpp - measures the steps of precision.h.
#include "tools/lab/invariance/precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/vertices/prepare.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "scenes/camera.h"
#include "tools/request/parse.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using rasterizer::DepthFormat, rasterizer::DepthPath;

// The code of a surface at a distance; a farther one has a greater code, or key (rasterizer/rules/depth_key.h).
class DistantCode {
  public:
    DistantCode(const DepthChoice& choice, const DepthSpan& span)
        : choice_{choice}, profile_{*pipeline::find_profile(choice.profile)} {
        state_.viewport = {0, 0, 1, 1};
        state_.depth_format = choice.format;
        scenes::ClipConvention convention;
        if (choice.is_reversed) {
            state_.depth_order = convention.depth_order = rasterizer::DepthOrder::greater;
            state_.clip_depth = convention.clip_depth = rasterizer::ClipDepth::zero_to_one;
        }
        scenes::LookAt camera;
        camera.eye = {0, 0, 0};
        camera.center = {0, 0, -1};
        camera.near = span.near;
        camera.far = span.far;
        view_ = scenes::with_clip_convention(scenes::look_at(camera, 1.0), {}, convention);
        list_.materials.emplace_back().double_sided = true;
        list_.materials[0].unlit = true;
        list_.instances.push_back({.mesh = 0, .material = 0});
        list_.meshes.emplace_back().indices = {0, 1, 2};
        options_.threads = 1;
    }

    [[nodiscard]] std::uint32_t operator()(double distance) {
        const auto d = static_cast<float>(distance);
        list_.meshes[0].positions = {{-d, -d, -d}, {3 * d, -d, -d}, {-d, 3 * d, -d}};
        const pipeline::PreparedDraw drawn = prepare(list_, view_, state_, profile_, options_);
        std::uint32_t code = 0;
        auto take = [&](rasterizer::FragmentBatch& batch) { code = batch.code[0]; };
        rasterizer::TileRasterizer{state_.viewport}.draw(
            drawn.geometry, drawn.geometry.all_triangles, {choice_.path, choice_.format},
            {.shader_z = false, .code = true, .color = false}, rasterizer::BatchSink{take});
        return code;
    }

  private:
    const DepthChoice& choice_;
    const pipeline::DeviceProfile& profile_;
    rasterizer::RasterState state_;
    pipeline::View view_;
    pipeline::DrawList list_;
    pipeline::PrepareOptions options_;
};

constexpr int surfaces = 16;  // at each distance

std::string step_text(double step) { return fmt::format("{:.3g}", step); }

std::optional<double> step_at(DistantCode& code, double distance, double far) {
    const std::uint32_t own = code(distance);
    const auto is_told = [&](double e) { return code(distance + e) > own; };
    double most = distance * 0x1p-26, least = 0;
    while (!is_told(most)) {
        least = most;
        most *= 2;
        if (distance + most >= far) return std::nullopt;
    }
    while (most - least > most / 1000) {
        const double middle = (least + most) / 2;
        (is_told(middle) ? most : least) = middle;
    }
    return most;
}

}  // namespace

std::span<const DepthChoice> depth_choices() {
    static const std::vector<DepthChoice> all{
        {"d16", "ideal", DepthFormat::d16, DepthPath::float32},
        {"d24", "geforce8", DepthFormat::d24, DepthPath::float32},
        {"d32f", "geforce8", DepthFormat::d32f, DepthPath::float32},
        {"d32f reversed", "geforce8", DepthFormat::d32f, DepthPath::float32, true},
        {"d24 logarithmic", "geforce8", DepthFormat::d24, DepthPath::logarithmic},
        {"d32f logarithmic", "geforce8", DepthFormat::d32f, DepthPath::logarithmic},
        {"packed_rgba8", "geforce8", DepthFormat::d32f, DepthPath::packed_rgba8},
        {"d24 w buffer", "geforce3", DepthFormat::d24, DepthPath::w_buffer}};
    return all;
}

std::optional<double> depth_step(const DepthChoice& choice, const DepthSpan& span, double distance) {
    DistantCode code{choice, span};
    double largest = 0;
    for (int k = 0; k < surfaces; ++k) {
        const auto step = step_at(code, distance * (1 + k / 1024.0), span.far);
        if (!step) return std::nullopt;
        largest = std::max(largest, *step);
    }
    return largest;
}

std::vector<double> distances_in(const DepthSpan& span) {
    std::vector<double> all;
    for (int exponent = -12; exponent <= 12; ++exponent)
        for (const int digit : {1, 2, 5}) {
            const auto distance = to_number<double>(fmt::format("{}e{}", digit, exponent));
            if (*distance >= span.near && *distance * 1.02 < span.far) all.push_back(*distance);
        }
    return all;
}

std::vector<PrecisionRow> precision_rows(const DepthSpan& span) {
    std::vector<PrecisionRow> rows;
    for (const double distance : distances_in(span)) {
        PrecisionRow& row = rows.emplace_back(PrecisionRow{.distance = distance});
        for (const DepthChoice& choice : depth_choices()) row.steps.push_back(depth_step(choice, span, distance));
    }
    return rows;
}

std::string precision_csv(const std::vector<PrecisionRow>& rows) {
    std::string text = "distance";
    for (const DepthChoice& choice : depth_choices()) text += "," + choice.name;
    text += '\n';
    for (const PrecisionRow& row : rows) {
        text += fmt::format("{}", row.distance);
        for (const auto& step : row.steps) text += step ? "," + step_text(*step) : ",";
        text += '\n';
    }
    return text;
}

std::string precision_table(const std::vector<PrecisionRow>& rows) {
    Table table{{{"distance", Align::right}}, {}};
    for (const DepthChoice& choice : depth_choices()) table.columns.push_back({choice.name, Align::right});
    for (const PrecisionRow& row : rows) {
        std::vector<std::string>& cells = table.rows.emplace_back();
        cells.push_back(fmt::format("{}", row.distance));
        for (const auto& step : row.steps) cells.push_back(step ? step_text(*step) : "none");
    }
    return to_text(table);
}

}  // namespace strata::tools
