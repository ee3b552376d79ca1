// Suite ZPass_pixel_count: ZPass, ZPassPointSize[VS]-0x<size>, ZPassLineWidth-0x<width>, all [_ZB], sizes in 1/8 pixel.
// The pixels that the chip's occlusion query counts. pipeline/reference/chip-fragment.md 6.
#include <algorithm>
#include <vector>

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/splits.h"
#include "tools/lab/hardware_check/drawing/suite.h"

namespace strata::hardware_check {
namespace {

// The greatest code of the 16-bit buffer. Window z is in codes.
constexpr double units = 65535.0;
// A fragment counts if it passes LESS. draw() returns the number of those that did: the chip's report.
const pipeline::DrawState counted{.depth = {.enabled = true, .func = pipeline::CompareFunc::less, .write = true}};

// A 128 x 128 square at world z, drawn with the fixed-function pipeline.
std::uint64_t draw_square(pipeline::Surface& surface, float x, float y, double z, Argb color) {
    const float l = x + viewport_offset, t = y + viewport_offset;
    return surface.draw(counted, box({l, t, l + 128, t + 128}, color, static_cast<float>(window_z(z, units))));
}

// The two reports of ZPass: after four squares, of which the second is behind the first and the fourth half outside the
// screen, and after one more. Reading the counter does not reset it, so the second report includes the first.
std::vector<std::uint64_t> draw_squares(pipeline::Surface& surface) {
    std::uint64_t count = draw_square(surface, 32, 240, 0, 0xff773377);
    count += draw_square(surface, 32, 240, 1, 0xff0000ff);
    count += draw_square(surface, 224, 240, 0, 0xff337777);
    count += draw_square(surface, 576, 240, 0, 0xffe0e0e0);
    const std::uint64_t first = count;
    count += draw_square(surface, 576, 176, -0.1, 0xff33cc33);
    return {first, count};
}

constexpr Argb white = 0xffffffff;

std::uint64_t draw_shape(pipeline::Surface& surface, Topology topology, const std::vector<ClipVertex>& vertices,
                         float size_px) {
    pipeline::DrawState state = counted;
    state.point_size_px = state.line_width_px = size_px;
    SplitDraw draw = split_draw(topology, vertices, PolygonMode::fill);
    return surface.draw(state, std::move(draw.soup), draw.primitive);
}

// The registers keep 1 pixel if a value does not fit.
float size_of(std::uint32_t value) { return value < 512 ? static_cast<float>(value) / 8.0f : 1.0f; }

// Points of the fixed-function pipeline at the centres of two squares; the first is behind its square.
std::uint64_t draw_fixed_points(pipeline::Surface& surface, std::uint32_t size) {
    const float near = static_cast<float>(window_z(0, units)), behind = static_cast<float>(window_z(1.5, units));
    std::uint64_t count = draw_square(surface, 32, 240, 0, 0xff773377);
    const auto point = [&](float x, float z) {
        return at(x + viewport_offset, 304 + viewport_offset, z, to_float(white));
    };
    count += draw_shape(surface, Topology::points, {point(96, behind)}, size_of(size));
    return count + draw_shape(surface, Topology::points, {point(288, near)}, size_of(size));
}

std::uint64_t draw_program_points(pipeline::Surface& surface, std::uint32_t size) {
    std::uint64_t count = surface.draw(counted, box({32, 240, 160, 368}, 0xff773377, 0));
    count += draw_shape(surface, Topology::points, {at(96, 304, 1.5f, to_float(white))}, size_of(size));
    return count + draw_shape(surface, Topology::points, {at(288, 304, 0, to_float(white))}, size_of(size));
}

// Horizontal lines of 64 pixels through the middle of the squares.
std::uint64_t draw_lines(pipeline::Surface& surface, std::uint32_t width) {
    std::uint64_t count = draw_square(surface, 32, 240, 0, 0xff773377);
    const float z = static_cast<float>(window_z(1.5, units)), y = 304 + viewport_offset;
    for (const float x : {32.0f, 288.0f}) {
        const float left = x + viewport_offset;
        count += draw_shape(surface, Topology::lines,
                            {at(left, y, z, to_float(white)), at(left + 64, y, z, to_float(white))}, size_of(width));
    }
    return count;
}

// A kind of picture whose name ends with a size register's hexadecimal digits.
struct Sized {
    std::string_view prefix;
    // The largest register value that pipeline/reference/chip-fragment.md 6 describes.
    std::uint32_t largest;
    std::uint64_t (*draw)(pipeline::Surface&, std::uint32_t size);
};
constexpr Sized kinds[] = {{"ZPassPointSizeVS-0x", 513, draw_program_points},
                           {"ZPassPointSize-0x", 511, draw_fixed_points},
                           {"ZPassLineWidth-0x", 511, draw_lines}};

}  // namespace

Drawing draw_zpass_pixel_count(std::string_view name, const pipeline::DeviceProfile& profile) {
    const bool shows_depth = take_last(name, "_ZB");
    const Sized* const sized = std::find_if(std::begin(kinds), std::end(kinds),
                                            [&](const Sized& kind) { return name.starts_with(kind.prefix); });
    const bool is_sized = sized != std::end(kinds);
    const auto size = is_sized ? to_hexadecimal(name.substr(sized->prefix.size())) : std::nullopt;
    if (!size && name != "ZPass") return unknown_name;
    if (size && *size > sized->largest)
        return {std::nullopt, "what the chip makes of so large a size is not described"};
    pipeline::Surface surface{profile, {.depth = pipeline::DepthFormat::d16}};
    surface.clear_color(unpack(0xff333333));
    surface.clear_depth(0xffff);
    SuitePicture picture;
    if (size)
        picture.reports = {sized->draw(surface, *size)};
    else
        picture.reports = draw_squares(surface);
    if (shows_depth) picture.reading = CaptureFormat::depth16;
    picture.image = shows_depth ? surface.depth() : surface.color();
    return {std::move(picture), {}};
}

}  // namespace strata::hardware_check
