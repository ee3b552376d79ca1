#include "tools/bench/mesa/reference.h"

#include <algorithm>
#include <numeric>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/stages/blend.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::mesa {

namespace {

// The OpenGL program has neither textures nor an alpha test, and no pass for opaque materials.
void check_materials(const Subject& subject) {
    for (const pipeline::Material& m : subject.scene.list.materials) {
        if (m.texture >= 0) throw InputError(subject.scene.name, m.name, "a material without texture", "one with");
        if (m.alpha_mode == pipeline::AlphaMode::mask ||
            (m.alpha_mode == pipeline::AlphaMode::opaque && !subject.alpha))
            throw InputError(subject.scene.name, m.name, "a transparent material (or --alpha)",
                             "an opaque or MASK one");
    }
}

}  // namespace

rasterizer::TriangleSoup clip_vertices(const Subject& subject) {
    check_materials(subject);
    return pipeline::transform(subject.scene.list, subject.view,
                               {.alpha_scale = subject.alpha.value_or(1.0f), .threads = subject.threads});
}

FragmentCounts count_fragments(const rasterizer::TriangleSoup& soup, const pipeline::DeviceProfile& profile,
                               Size size) {
    rasterizer::RasterState state;
    // Row 0 is the top on both sides: strata_mesa sets GL_UPPER_LEFT.
    state.viewport = {0, 0, size.width, size.height};
    const rasterizer::Geometry geometry = rasterizer::set_up(soup, state, profile.raster, 0);
    std::vector<std::uint32_t> triangles(geometry.triangles.size()), counts(size.area());
    std::iota(triangles.begin(), triangles.end(), 0u);
    auto count = [&counts](const rasterizer::FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) ++counts[batch.pixel[i]];
    };
    // The whole frame as one tile. No values are needed: counting looks at coverage alone.
    rasterizer::TileRasterizer(state.viewport)
        .draw(geometry, triangles, {}, {.shader_z = false, .code = false, .color = false},
              rasterizer::BatchSink{count});
    return {std::move(counts), geometry.counters.clipped};
}

namespace {

// Premultiplied colours added up as a blend on the target would, in submission order.
Rendered sums(const Subject& subject, const pipeline::DeviceProfile& profile, pipeline::Format format) {
    rasterizer::RasterState state;
    state.viewport = {0, 0, subject.size.width, subject.size.height};
    const rasterizer::Geometry geometry = rasterizer::set_up(clip_vertices(subject), state, profile.raster, 0);
    std::vector<std::uint32_t> triangles(geometry.triangles.size());
    std::iota(triangles.begin(), triangles.end(), 0u);
    pipeline::Image image(format, subject.size.width, subject.size.height);
    std::array<rasterizer::Lanes<float>, 4> source;
    std::array<rasterizer::Lanes<std::uint32_t>, 4> codes;
    auto add = [&](const rasterizer::FragmentBatch& batch) {
        const auto count = static_cast<std::size_t>(batch.count);
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < count; ++i) {
                source[c][i] = c == 3 ? batch.color[3][i] : batch.color[c][i] * batch.color[3][i];
                codes[c][i] = image.codes[4 * std::size_t{batch.pixel[i]} + c];
            }
        pipeline::blend(pipeline::blend_mode::sum, pipeline::info(format).type, profile, 4, source, codes, batch.count);
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < count; ++i) image.codes[4 * std::size_t{batch.pixel[i]} + c] = codes[c][i];
    };
    rasterizer::TileRasterizer(state.viewport)
        .draw(geometry, triangles, {}, {.shader_z = false, .code = false}, rasterizer::BatchSink{add});
    return {std::move(image), 1};
}

}  // namespace

Rendered render(const Subject& subject, const pipeline::DeviceProfile& profile, const std::string& job,
                const TargetFormats& formats, int max_passes) {
    if (job == "sums")
        return sums(subject, profile,
                    formats.color == pipeline::Format::rgba32f ? formats.color : pipeline::Format::rgba16f);
    const bool depth = job == "depth";
    peeling::RenderOptions options;
    options.width = subject.size.width;
    options.height = subject.size.height;
    options.alpha = subject.alpha;
    options.color_format = formats.color;
    options.depth = pipeline::depth_format(formats.depth);
    options.max_passes = max_passes;
    options.threads = subject.threads;
    // The audit compares nothing here, and the nearest depth is wanted for `depth` alone.
    options.audit = false;
    options.nearest_depth = depth;
    peeling::Renderer renderer(subject.scene.list, subject.view, profile, options);
    // weighted_average finds the nearest binary32 depths in one pass; codes of fixed point are those that a peel stores.
    const char* const finder = formats.depth == pipeline::Format::d32f ? "weighted_average" : "front_to_back";
    auto result = renderer.render(*peeling::find_algorithm(depth ? finder : job));
    return {depth ? std::move(result.frame.depth) : std::move(result.frame.color), result.frame.passes.geometry};
}

}  // namespace strata::mesa
