// peeling/truth/chain_list.cpp - generates fragments by the device's kernels or in binary64, depending on which links
// are exact (chain_list.h).
#include "peeling/truth/chain_list.h"

#include <algorithm>

#include "peeling/frame/prepared_lists.h"
#include "peeling/raster_state.h"
#include "peeling/truth/real_geometry.h"
#include "peeling/truth/real_texture.h"
#include "pipeline/stages/alpha_test.h"
#include "pipeline/textures/texture_sample.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::peeling {

using namespace pipeline;
using rasterizer::DepthRequest;
using rasterizer::FragmentBatch;
using rasterizer::RasterRules;
using rasterizer::Rect;

namespace {

// The profile of the device with some links exact.
[[nodiscard]] DeviceProfile device_of(const ChainScene& scene, const Chain& chain) {
    DeviceProfile device = scene.profile;
    if (!chain.snap) return device;
    device.raster.subpixel_bits = 12;
    device.raster.snap = rasterizer::Snap::nearest_even;
    return device;
}

[[nodiscard]] View view_of(const ChainScene& scene, const Chain& chain) {
    View view = scene.view;
    view.vertex_path = chain.transform ? VertexPath::double_precision
                                       : scene.options.vertex_paths.first.value_or(scene.view.vertex_path);
    return view;
}

// The depth of a cleared buffer in the unit of the fragments' depths.
[[nodiscard]] double far_of(const Chain& chain, rasterizer::DepthFormat format) {
    if (!chain.conversion) return rasterizer::max_code(format);
    return chain.plane ? 1.0 : rasterizer::buffer_units(format);
}

[[nodiscard]] constexpr int tiles_along(int pixels) noexcept {
    return (pixels + ChainList::tile_size - 1) / ChainList::tile_size;
}

}  // namespace

DepthRequest ChainScene::depth() const {
    DepthRequest request;
    request.format = profile.depth_buffer(options.depth);
    request.path = options.depth_path.value_or(profile.raster.depth_path);
    return request;
}

Format ChainScene::color_format() const {
    const bool is_exact = profile.raster.depth_path == rasterizer::DepthPath::exact;
    return options.color_format.value_or(is_exact ? Format::rgba32f : Format::rgba8);
}

rasterizer::RasterState ChainScene::raster() const { return raster_state(options, profile); }

ChainList::ChainList(const ChainScene& scene, const Chain& chain, Selection selection)
    : scene_{scene},
      chain_{chain},
      depth_{scene.depth()},
      frame_{0, 0, scene.options.width, scene.options.height},
      far_{far_of(chain, depth_.format)},
      alpha_scale_{scene.options.alpha.value_or(1.0f)},
      is_real_{chain.snap && chain.plane && chain.color} {
    const PrepareOptions options{.selection = selection,
                                 .alpha_scale = alpha_scale_,
                                 .depth_quotient = takes_quotient(depth_),
                                 .tile_size = tile_size,
                                 .threads = scene.options.threads};
    const View view = view_of(scene, chain);
    if (!is_real_) {
        prepared_ = prepare(scene.list, view, scene.raster(), device_of(scene, chain), options);
        return;
    }
    triangles_ = real_triangles(scene.list, view, scene.raster(), options,
                                chain.transform ? RealPositions::binary64 : RealPositions::vertex_stage);
    const int across = tiles_along(frame_.x1);
    bins_.resize(tile_count());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Rect box = triangles_[i].box(frame_);
        if (box.area() == 0) continue;
        for (int y = box.y0 / tile_size; y <= (box.y1 - 1) / tile_size; ++y)
            for (int x = box.x0 / tile_size; x <= (box.x1 - 1) / tile_size; ++x)
                bins_[static_cast<std::size_t>(y * across + x)].push_back(static_cast<std::uint32_t>(i));
    }
}

void ChainList::fragments_of(std::size_t tile, std::vector<ChainFragment>& out) const {
    if (is_real_)
        real_fragments(tile, out);
    else
        device_fragments(tile, out);
}

std::size_t ChainList::tile_count() const noexcept {
    return static_cast<std::size_t>(tiles_along(frame_.x1)) * static_cast<std::size_t>(tiles_along(frame_.y1));
}

Rect ChainList::tile_rect(std::size_t tile) const noexcept {
    const auto across = static_cast<std::size_t>(tiles_along(frame_.x1));
    const int x = static_cast<int>(tile % across) * tile_size, y = static_cast<int>(tile / across) * tile_size;
    return intersection({x, y, x + tile_size, y + tile_size}, frame_);
}

// The depth of the exact plane, converted or not.
double ChainList::real_depth(double z) const {
    if (chain_.conversion) return z;
    return rasterizer::depth_code(
        z, rasterizer::depth_conversion(depth_.format, scene_.profile.raster.depth_rounding, 1.0));
}

std::optional<std::array<double, 4>> ChainList::real_color(const RealTriangle& triangle,
                                                           const RealWeights& weights) const {
    const auto values = triangle.values(weights);
    std::array<double, 4> color{values[0], values[1], values[2], values[3]};
    const Material& material = scene_.list.materials[triangle.material()];
    if (material.texture >= 0) {
        const auto texel =
            unquantized_sample(scene_.list.textures[static_cast<std::size_t>(material.texture)], values[4], values[5]);
        for (std::size_t c = 0; c < color.size(); ++c) color[c] *= texel[c];
    }
    if (material.alpha_mode != AlphaMode::mask) return color;
    if (color[3] < double{material.alpha_cutoff}) return std::nullopt;
    color[3] *= double{alpha_scale_};
    return color;
}

void ChainList::real_fragments(std::size_t tile, std::vector<ChainFragment>& out) const {
    const Rect rect = tile_rect(tile);
    for (const std::uint32_t number : bins_[tile]) {
        const RealTriangle& triangle = triangles_[number];
        const Rect box = triangle.box(rect);
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x) {
                const RealWeights weights = triangle.weights(x, y);
                if (!weights.is_inside) continue;
                const auto color = real_color(triangle, weights);
                if (!color) continue;
                const auto pixel = static_cast<std::uint32_t>((y - rect.y0) * rect.width() + (x - rect.x0));
                out.push_back({pixel, real_depth(triangle.depth(weights)), *color});
            }
    }
}

// If a value is evaluated at the corners, triangles are drawn one by one, so that a batch belongs to one triangle.
void ChainList::device_fragments(std::size_t tile, std::vector<ChainFragment>& out) const {
    const rasterizer::Geometry& geometry = prepared_.geometry;
    const bool needs_corners = chain_.color || (chain_.plane && chain_.conversion);
    const rasterizer::FragmentNeeds needs{.shader_z = true,
                                          .code = true,
                                          .exact_code = chain_.plane && !chain_.conversion,
                                          .color = !chain_.color,
                                          .texcoord = !chain_.color && prepared_.needs.texcoord,
                                          .facing = false,
                                          .reference = !chain_.plane && chain_.conversion};
    rasterizer::TileRasterizer rasterizer{tile_rect(tile)};
    std::optional<RealTriangle> triangle;
    auto sink = [&](FragmentBatch& batch) { take(batch, triangle ? &*triangle : nullptr, out); };
    const auto bin = geometry.bin(tile);
    if (!needs_corners) return rasterizer.draw(geometry, bin, depth_, needs, rasterizer::BatchSink{sink});
    for (const std::uint32_t& number : bin) {
        triangle = real_triangle(geometry, number);
        rasterizer.draw(geometry, std::span{&number, 1}, depth_, needs, rasterizer::BatchSink{sink});
    }
}

// Processes a batch as Stages::shade does.
void ChainList::take(FragmentBatch& batch, const RealTriangle* triangle, std::vector<ChainFragment>& out) const {
    const auto count = static_cast<std::size_t>(batch.count);
    const MaterialStage& material = prepared_.materials[batch.material];
    rasterizer::Lanes<std::uint32_t> alive;
    std::fill_n(alive.begin(), count, ~0u);
    if (!chain_.color) {
        if (material.texture != nullptr) {
            std::array<rasterizer::Lanes<float>, 4> texel;
            sample(*material.texture, scene_.profile.texture_filter, batch.texcoord[0], batch.texcoord[1], texel,
                   batch.count);
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t i = 0; i < count; ++i) batch.color[c][i] *= texel[c][i];
        }
        if (material.mask.enabled) {
            const bool eight_bit = is_eight_bit_alpha(scene_.profile.alpha_test, info(scene_.color_format()).type);
            alpha_test(material.mask, eight_bit, batch.color[3].data(), alive.data(), batch.count);
            for (std::size_t i = 0; i < count; ++i) batch.color[3][i] *= material.alpha_scale;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (alive[i] == 0) continue;
        ChainFragment fragment{.pixel = batch.pixel[i], .depth = double(batch.code[i])};
        const RealWeights weights = triangle ? triangle->weights(batch.x[i], batch.y[i]) : RealWeights{};
        if (chain_.plane)
            fragment.depth = chain_.conversion ? triangle->depth(weights) : double(batch.exact_code[i]);
        else if (chain_.conversion)
            fragment.depth = batch.reference_z[i];
        if (!chain_.color) {
            for (std::size_t c = 0; c < 4; ++c) fragment.color[c] = double{batch.color[c][i]};
        } else if (const auto color = real_color(*triangle, weights)) {
            fragment.color = *color;
        } else {
            continue;
        }
        out.push_back(fragment);
    }
}

}  // namespace strata::peeling
