// pipeline/region/surface.cpp - a surface is a frame of one region whose list of triangles changes from draw to draw
// (pipeline/reference/execution.md 12). It uses the region's own stages, so that the rules of a stage have one
// implementation.
#include "pipeline/region/surface.h"

#include <algorithm>

#include "pipeline/device/check.h"
#include "pipeline/formats/narrow.h"
#include "pipeline/region/fragment_path.h"
#include "pipeline/region/region_shortcuts.h"
#include "rasterizer/base/float_environment.h"

namespace strata::pipeline {

struct Surface::State {
    State(const DeviceProfile& p, const SurfaceLayout& l)
        : profile{p},
          layout{l},
          list{empty(l)},
          frame{make_frame(profile, l, list)},
          region{frame, {frame.rect()}, statistics},
          color{region.make(l.color)},
          depth{region.make_depth()},
          stencil{region.make(Format::s8)} {}

    // Not copyable: the region points to the frame, and the frame to the profile and the list.
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    static PreparedDraw empty(const SurfaceLayout& layout) {
        PreparedDraw list;
        list.geometry.state.viewport = {0, 0, layout.width, layout.height};
        return list;
    }
    static Frame make_frame(const DeviceProfile& profile, const SurfaceLayout& layout, const PreparedDraw& list) {
        Frame frame;
        frame.profile = &profile;
        frame.transparent = &list;
        frame.depth = {profile.raster.depth_path, profile.stored(layout.depth)};
        frame.color_format = layout.color;
        return frame;
    }

    DeviceProfile profile;
    SurfaceLayout layout;
    PreparedDraw list;  // the triangles of the current draw
    Frame frame;
    RegionStatistics statistics;
    Region region;
    Target color, depth, stencil;
};

namespace {

void require(std::optional<Refusal> lacking, const DeviceProfile& profile) {
    if (lacking) throw Refused{profile, *std::move(lacking)};
}

// Sets up one draw: all triangles have one material, and the soup's positions are window positions.
PreparedDraw prepared(const DeviceProfile& profile, const SurfaceLayout& layout, const DrawState& state,
                      rasterizer::TriangleSoup soup, rasterizer::Primitive primitive) {
    rasterizer::RasterState raster;
    raster.viewport = {0, 0, layout.width, layout.height};
    raster.y_direction = rasterizer::YDirection::up;  // facing is as seen in the window; positions are not changed
    raster.front_face = state.front_face;
    raster.cull = state.cull;
    raster.scissor = state.window_clip;
    raster.depth_near = state.depth_near;
    raster.depth_far = state.depth_far;
    raster.depth_clamp = state.depth_clamp;
    raster.polygon_offset = state.polygon_offset;
    raster.range_culls_triangles = state.range_culls_triangles;
    raster.line_width_px = state.line_width_px;
    raster.point_size_px = state.point_size_px;
    raster.point_sprites = state.point_sprites;
    raster.line_style = state.line_style;
    raster.smooth_polygons = state.smooth_polygons;
    raster.polygon_stipple = state.polygon_stipple;
    raster.w_scale = 1.0f;
    raster.window_positions = true;
    raster.depth_format = profile.stored(layout.depth);
    soup.runs = {{.first_index = 0,
                  .index_count = static_cast<std::uint32_t>(soup.indices.size()),
                  .double_sided = state.cull == rasterizer::CullFace::none,
                  .primitive = primitive}};
    PreparedDraw list;
    list.geometry = set_up(std::move(soup), raster, profile.raster, 1);
    bin_triangles(list.geometry, 128);
    list.materials.emplace_back().texture = state.texture;
    list.needs.texcoord = state.texture != nullptr;
    return list;
}

// Stores the same codes in every pixel of `target`; all lanes of `codes` are equal.
template <class Target>
void store_everywhere(Region& region, Target target, std::size_t pixels, const ColorCodes& codes) {
    for (std::size_t first = 0; first < pixels; first += batch_capacity)
        RegionShortcuts{region}.store_pixels(target, static_cast<std::uint32_t>(first),
                                             static_cast<int>(std::min<std::size_t>(batch_capacity, pixels - first)),
                                             codes);
}

}  // namespace

Surface::Surface(const DeviceProfile& profile, const SurfaceLayout& layout) {
    require(check(profile, layout.color), profile);
    require(check(profile, layout.depth), profile);
    state_ = std::make_unique<State>(profile, layout);
    clear_color({0, 0, 0, 0});
    clear_depth(0);
}

Surface::~Surface() = default;
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;

void Surface::clear_color(const PixelCode& value) {
    ColorCodes codes{};
    for (int c = 0; c < 4; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        codes[channel].fill(narrowed(state_->layout.color, c, value[channel]));
    }
    store_everywhere(state_->region, state_->color, state_->frame.rect().area(), codes);
}

// Stores the code directly: a clear of a region would convert a float and could not express every code (formats.md
// 5.5).
void Surface::clear_depth(std::uint32_t code) {
    ColorCodes codes{};
    codes[0].fill(code);
    store_everywhere(state_->region, state_->depth, state_->frame.rect().area(), codes);
}

void Surface::clear_stencil(std::uint8_t value) { state_->region.clear(state_->stencil, {.stencil = value}); }

void Surface::fill(const std::function<PixelCode(int x, int y)>& value) {
    State& s = *state_;
    ColorCodes codes{};
    for (int y = 0; y < s.layout.height; ++y)
        for (int x = 0; x < s.layout.width; x += batch_capacity) {
            const int count = std::min(batch_capacity, s.layout.width - x);
            for (int i = 0; i < count; ++i) {
                const PixelCode pixel = value(x + i, y);
                for (int c = 0; c < 4; ++c)
                    codes[static_cast<std::size_t>(c)][static_cast<std::size_t>(i)] =
                        narrowed(s.layout.color, c, pixel[static_cast<std::size_t>(c)]);
            }
            RegionShortcuts{s.region}.store_pixels(s.color, static_cast<std::uint32_t>(y * s.layout.width + x), count,
                                                   codes);
        }
}

// The number of fragments that pass all tests, as an occlusion query counts them, is the increase of the counter
// `blended`.
std::uint64_t Surface::draw(const DrawState& state, rasterizer::TriangleSoup soup, rasterizer::Primitive primitive) {
    const FloatEnvironment ours;
    State& s = *state_;
    s.list = prepared(s.profile, s.layout, state, std::move(soup), primitive);
    s.frame.depth.path = state.depth_path.value_or(s.profile.raster.depth_path);
    PassState pass;
    pass.alpha = state.alpha;
    pass.stencil = state.stencil;
    pass.depth = state.depth;
    pass.depth_target = s.depth;
    if (state.stencil.enabled) pass.stencil_target = s.stencil;
    pass.color[0] = s.color;
    pass.blend[0] = state.blend;
    pass.blend[0].write_mask = state.color_mask;
    pass.needs.shader_z = false;
    pass.needs.code = false;
    const std::uint64_t before = s.statistics.counters.blended;
    if (state.path != nullptr) {
        FragmentPathProgram program{s.region, *state.path};
        program.apply(pass);
        static_cast<void>(s.region.draw(pass, program));
    } else {
        static_cast<void>(s.region.draw(pass, [](const FragmentBatch& in, const Loads&, Outputs& out) {
            for (std::size_t c = 0; c < 4; ++c) std::copy_n(in.color[c].begin(), in.count, out.color[0][c].begin());
        }));
    }
    return s.statistics.counters.blended - before;
}

// A narrow surface stores 8-bit codes with the missing bits filled in, so its image has format rgba8.
Image Surface::color() const {
    Image image = state_->region.targets().image(state_->color);
    image.format = Format::rgba8;
    return image;
}

Image Surface::depth() const { return state_->region.targets().image(state_->depth); }
Image Surface::stencil() const { return state_->region.targets().image(state_->stencil); }

}  // namespace strata::pipeline
