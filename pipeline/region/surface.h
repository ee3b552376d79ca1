// pipeline/region/surface.h - immediate mode: a colour surface with depth and stencil, and draws with arbitrary state
// changes, one after the other, like a driver's calls. For scenes other than peels: hardware checks, render to texture.
//
// Rule     A draw is set up, rasterized and finished by the stages of region_stages.cpp before the next one begins. A
//          surface is a single region. Another surface can sample its contents: `color` and `depth` return finished
//          images.
// Tests    tests/tools/lab/hardware_check/suites_test.cpp: hardware captures
#pragma once
#include <cstdint>
#include <functional>
#include <memory>

#include "pipeline/device/state.h"
#include "pipeline/formats/image.h"
#include "pipeline/vertices/prepare.h"

namespace strata::pipeline {

struct FragmentPath;  // pipeline/region/fragment_path.h

struct SurfaceLayout {
    Format color = Format::rgba8;
    DepthFormat depth = DepthFormat::d24;  // d24 includes 8 bits of stencil
    int width = 640, height = 480;         // pixels
};

// The state of one draw. Vertex positions are window coordinates, y down, with z in the profile's window z units.
struct DrawState {
    AlphaTest alpha{};
    StencilTest stencil{};
    DepthTest depth{};
    Blend blend{};
    std::uint8_t color_mask = 0xf;                  // bit 0 r, 1 g, 2 b, 3 a
    std::optional<rasterizer::Rect> window_clip{};  // half-open, like every Rect
    rasterizer::CullFace cull = rasterizer::CullFace::none;
    rasterizer::FrontFace front_face = rasterizer::FrontFace::counter_clockwise;  // as seen in the window
    float depth_near = 0.0f, depth_far = 1.0f;  // fragments outside are dropped, or clamped
    bool depth_clamp = false;
    bool range_culls_triangles = false;  // drops triangles if all corners' z are outside the range on the same side
    rasterizer::PolygonOffset polygon_offset{};
    std::optional<rasterizer::DepthPath> depth_path{};  // empty: the profile's
    float line_width_px = 1.0f, point_size_px = 1.0f;
    bool point_sprites = false;
    rasterizer::LineStyle line_style = rasterizer::LineStyle::band;
    bool smooth_polygons = false;
    std::optional<rasterizer::PolygonStipple> polygon_stipple{};
    const Texture* texture = nullptr;  // multiplies the vertex colour; rectangle: texel units
    // Replaces the texture by texture shader and combiners; the soup's extras provide the units' coordinates. Depth
    // textures are images.
    const FragmentPath* path = nullptr;
};

using PixelCode = std::array<std::uint8_t, 4>;  // r g b a

class Surface {
  public:
    // Contents are 0. Throws Refused for a format that the profile lacks.
    Surface(const DeviceProfile& profile, const SurfaceLayout& layout);
    ~Surface();
    Surface(Surface&&) noexcept;
    Surface& operator=(Surface&&) noexcept;

    void clear_color(const PixelCode& value);
    void clear_depth(std::uint32_t code);  // the stored code
    void clear_stencil(std::uint8_t value);
    // Writes every pixel like the CPU: no stage is applied, only the truncation of the format.
    void fill(const std::function<PixelCode(int x, int y)>& value);

    // Draws the primitives of `soup` in listed order, all of one kind, ignoring its runs. Returns the number of
    // fragments that passed all tests, as an occlusion query does.
    std::uint64_t draw(const DrawState& state, rasterizer::TriangleSoup soup,
                       rasterizer::Primitive primitive = rasterizer::Primitive::triangles);

    [[nodiscard]] Image color() const;  // as rgba8: the codes that the blender would read
    [[nodiscard]] Image depth() const;
    [[nodiscard]] Image stencil() const;  // zero without a stencil buffer

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::pipeline
