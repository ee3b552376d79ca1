// tools/port/beside/reference.cpp - transforms and renders the scene by Strata for comparison with the OpenGL program
// (reference.h).
#include "tools/port/beside/reference.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/formats/convert.h"
#include "pipeline/fragments/tile_cache.h"
#include "pipeline/stages/blend.h"
#include "pipeline/stages/target_storage.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "tools/port/beside/mesa_pow.h"

namespace strata::port {

namespace {

// The OpenGL program supports neither textures nor an alpha test, and has no pass for opaque materials.
void check_materials(const Subject& subject) {
    for (const pipeline::Material& m : subject.scene.list.materials) {
        if (m.texture >= 0) throw InputError(subject.scene.name, m.name, "a material without texture", "one with");
        if (m.alpha_mode == pipeline::AlphaMode::mask ||
            (m.alpha_mode == pipeline::AlphaMode::opaque && !subject.alpha))
            throw InputError(subject.scene.name, m.name, "a transparent material (or --alpha)",
                             "an opaque or MASK one");
    }
}

DrawKind kind_of(rasterizer::Shape shape) {
    if (shape == rasterizer::Shape::line) return DrawKind::lines;
    return shape == rasterizer::Shape::point ? DrawKind::points : DrawKind::triangles;
}

}  // namespace

rasterizer::TriangleSoup clip_vertices(const Subject& subject) {
    check_materials(subject);
    return pipeline::transform(subject.scene.list, subject.view,
                               {.alpha_scale = subject.alpha.value_or(1.0f), .threads = subject.threads});
}

IndexedMesh mesh_of(const rasterizer::TriangleSoup& soup) {
    IndexedMesh mesh;
    for (const rasterizer::ClipVertex& v : soup.vertices)
        mesh.vertices.push_back({{v.x, v.y, v.z, v.w}, v.front, v.back});
    for (const rasterizer::TriangleRun& run : soup.runs) {
        const DrawKind kind = kind_of(rasterizer::shape_of(run.primitive));
        const auto first = static_cast<std::uint32_t>(mesh.indices.size());
        // A line has its first end twice, a point its vertex three times.
        const std::uint32_t unused = kind == DrawKind::triangles ? 0 : kind == DrawKind::lines ? 1 : 2;
        for (std::uint32_t i = 0; i < run.index_count; ++i)
            if (i % 3 >= unused) mesh.indices.push_back(soup.indices[run.first_index + i]);
        const auto count = static_cast<std::uint32_t>(mesh.indices.size()) - first;
        mesh.draws.push_back({first, count, true, run.double_sided, run.mirrored, kind});
    }
    return mesh;
}

pipeline::Format strata_format(const PixelFormat& format) {
    using enum pipeline::Format;
    if (format == port::rgba8) return rgba8;
    if (format == port::rgba16f) return rgba16f;
    if (format == port::rgba32f) return rgba32f;
    if (format == port::d16) return d16;
    if (format == port::d24) return d24;
    if (format == port::d32f) return d32f;
    throw std::invalid_argument(std::string("a format that no job stores: ") + format.name);
}

pipeline::Image as_image(const PixelCodes& image) {
    pipeline::Image codes(strata_format(image.format), image.size.width, image.size.height);
    const auto bytes = static_cast<std::size_t>(image.format.bytes);
    for (std::size_t i = 0; i < codes.codes.size(); ++i) {
        std::uint32_t code = 0;
        std::memcpy(&code, &image.bytes[i * bytes], bytes);
        codes.codes[i] = code;
    }
    return codes;
}

FragmentCounts count_fragments(const rasterizer::TriangleSoup& soup, const pipeline::DeviceProfile& profile,
                               FrameSize size) {
    rasterizer::RasterState state;
    // Row 0 is the top on both sides: the port sets GL_UPPER_LEFT.
    state.viewport = {0, 0, size.width, size.height};
    const rasterizer::Geometry geometry = rasterizer::set_up(soup, state, profile.raster, 0);
    std::vector<std::uint32_t> triangles(geometry.triangles.size()), counts(size.area());
    std::iota(triangles.begin(), triangles.end(), 0u);
    auto count = [&counts](const rasterizer::FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) ++counts[batch.pixel[i]];
    };
    // The whole frame as one tile. No values are needed: only coverage is counted.
    rasterizer::TileRasterizer(state.viewport)
        .draw(geometry, triangles, {}, {.shader_z = false, .code = false, .color = false},
              rasterizer::BatchSink{count});
    return {std::move(counts), geometry.counters.clipped};
}

namespace {

// A target to which one pass adds: with blending, or in tiles that a profile keeps in binary32
// (pipeline/reference/fragment-stages.md 9.5).
class SumTarget {
  public:
    SumTarget(const rasterizer::Rect& frame, const pipeline::DeviceProfile& profile, pipeline::Format format)
        : profile_{profile},
          size_{frame.width(), frame.height()},
          target_{format, 1, frame.area()},
          cache_{frame, frame} {
        alive_.fill(~0u);
        if (profile.blend_storage != pipeline::BlendStorage::target &&
            pipeline::TileCache::knows(pipeline::blend_mode::sum, format))
            cache_.hold(0, profile, pipeline::blend_mode::sum, {format, target_.pixels(), {target_.texels(0)}});
    }

    void add(const rasterizer::FragmentBatch& batch) {
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                source_[c][i] = c == 3 ? batch.color[3][i] : batch.color[c][i] * batch.color[3][i];
        if (cache_.holds(0)) return cache_.blend(0, {batch, source_, alive_, alive_, 0});
        target_.gather(batch.pixel, batch.count, 0, codes_);
        const pipeline::ChannelType type = pipeline::info(target_.format()).type;
        pipeline::blend(pipeline::blend_mode::sum, type, profile_, 4, source_, codes_, batch.count);
        target_.scatter(batch.pixel, alive_, batch.count, 0, 0xfu, codes_);
    }

    [[nodiscard]] pipeline::Image image() {
        cache_.close();
        pipeline::Image image(target_.format(), size_.width, size_.height);
        for (std::size_t i = 0; i < image.codes.size(); ++i)
            image.codes[i] = target_.code(i / 4, static_cast<int>(i % 4), 0);
        return image;
    }

  private:
    const pipeline::DeviceProfile& profile_;
    FrameSize size_;
    pipeline::TargetStorage target_;
    pipeline::TileCache cache_;
    pipeline::ColorLanes source_{};
    rasterizer::Lanes<std::uint32_t> alive_{};
    pipeline::ColorCodes codes_{};
};

// Premultiplied colours summed by blending in one pass, in submission order.
Rendered sums(const Subject& subject, const pipeline::DeviceProfile& profile, pipeline::Format format) {
    const rasterizer::Rect frame{0, 0, subject.size.width, subject.size.height};
    SumTarget adding{frame, profile, format};
    rasterizer::RasterState state;
    state.viewport = frame;
    const rasterizer::Geometry geometry = rasterizer::set_up(clip_vertices(subject), state, profile.raster, 0);
    std::vector<std::uint32_t> triangles(geometry.triangles.size());
    std::iota(triangles.begin(), triangles.end(), 0u);
    auto add = [&](const rasterizer::FragmentBatch& batch) { adding.add(batch); };
    rasterizer::TileRasterizer(frame).draw(geometry, triangles, {}, {.shader_z = false, .code = false},
                                           rasterizer::BatchSink{add});
    return {adding.image(), 1};
}

// The average that ends in the driver's pow: the stored sums, the count as an exact number, over black.
Rendered average_by_pow(const Subject& subject, const pipeline::DeviceProfile& profile, pipeline::Format format,
                        pipeline::Format sum_format) {
    const Rendered summed = sums(subject, profile, sum_format);
    const FragmentCounts counts = count_fragments(clip_vertices(subject), profile, subject.size);
    const MesaPow mesa(profile.raster.plane_rule == rasterizer::PlaneRule::reciprocal_area_fused);
    Rendered result{pipeline::Image(format, subject.size.width, subject.size.height), 1};
    for (std::size_t pixel = 0; pixel < counts.pixels.size(); ++pixel) {
        std::array<float, 4> sum{}, color{0, 0, 0, 1};
        pipeline::scalar::decode(pipeline::info(sum_format).type, &summed.image.codes[4 * pixel], sum.data(), 4);
        const auto n = static_cast<float>(counts.pixels[pixel]);
        if (n > 0.0f && sum[3] > 0.0f) {
            const float transmitted = mesa.pow(1.0f - sum[3] / n, n);
            for (std::size_t c = 0; c < 3; ++c) color[c] = sum[c] / sum[3] * (1.0f - transmitted);
        }
        pipeline::scalar::encode(pipeline::info(format).type, profile.color_rounding(), color.data(),
                                 &result.image.codes[4 * pixel], 4);
    }
    return result;
}

}  // namespace

Rendered render(const Subject& subject, const pipeline::DeviceProfile& profile, const std::string& job,
                const TargetFormats& formats, int max_passes) {
    if (job == "sums") return sums(subject, profile, strata_format(formats.color == rgba32f ? rgba32f : rgba16f));
    if (job == "weighted_average_pow")
        return average_by_pow(subject, profile, strata_format(formats.color),
                              strata_format(formats.color == rgba32f ? rgba32f : rgba16f));
    const bool depth = job == "depth";
    peeling::RenderOptions options;
    options.width = subject.size.width;
    options.height = subject.size.height;
    options.alpha = subject.alpha;
    options.color_format = strata_format(formats.color);
    options.depth = pipeline::depth_format(strata_format(formats.depth));
    options.max_passes = max_passes;
    options.threads = subject.threads;
    // Without audit, and the nearest depth only for `depth`.
    options.audit = false;
    options.nearest_depth = depth;
    peeling::Renderer renderer(subject.scene.list, subject.view, profile, options);
    // weighted_average finds the nearest binary32 depths in one pass; fixed-point codes are those that a peel stores.
    const std::string finder = formats.depth == d32f ? "weighted_average" : "front_to_back";
    const std::string name = depth ? finder : job;
    auto result = renderer.render(*peeling::find_algorithm(name));
    return {depth ? std::move(result.frame.depth) : std::move(result.frame.color), result.frame.passes.geometry};
}

}  // namespace strata::port
