// Suite ZPass_pixel_count: ZPass, ZPassPointSize[VS]-0x<size>, ZPassLineWidth-0x<width>, all [_ZB], sizes in 1/8 pixel.
// The pixels that the chip's occlusion query counts. pipeline/reference/chip-fragment.md 6.
#include <algorithm>

#include "tools/lab/hardware_check/drawing/fixed_pipeline.h"
#include "tools/lab/hardware_check/drawing/names.h"
#include "tools/lab/hardware_check/drawing/shapes.h"
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

// A square of `side` pixels around (x, y): pixel centres in [c - side / 2, c + side / 2).
std::uint64_t draw_point(pipeline::Surface& surface, float x, float y, float side, float z) {
    const float h = side / 2;
    return surface.draw(counted, box({x - h, y - h, x + h, y + h}, white, z));
}

// The fixed-function pipeline counts whole pixels, at least one.
std::uint64_t draw_fixed_points(pipeline::Surface& surface, std::uint32_t size) {
    const float side = static_cast<float>(std::max(1u, size >> 3));
    const float near = static_cast<float>(window_z(0, units)), behind = static_cast<float>(window_z(1.5, units));
    std::uint64_t count = draw_square(surface, 32, 240, 0, 0xff773377);
    count += draw_point(surface, 96.5f, 304.5f, side, behind);
    return count + draw_point(surface, 288.5f, 304.5f, side, near);
}

// A vertex program's size is not rounded, except for 0 and the end of the range.
std::uint64_t draw_program_points(pipeline::Surface& surface, std::uint32_t size) {
    // 0 draws one pixel at the point itself, 504 to 511 a square of side 64, and 512 and above wrap around to one pixel
    // (pipeline/reference/chip-fragment.md 6.1).
    const bool is_zero = size == 0, wraps = size >= 512;
    const float side = is_zero || wraps ? 1.0f : size >= 504 ? 64.0f : static_cast<float>(size) / 8.0f;
    const float shift = is_zero ? 0.5f : 0.0f;
    std::uint64_t count = surface.draw(counted, box({32, 240, 160, 368}, 0xff773377, 0));
    count += draw_point(surface, 96 + shift, 304 + shift, side, 1.5f);
    return count + draw_point(surface, 288 + shift, 304 + shift, side, 0);
}

// A horizontal line of 64 pixels: rows starting at 304 - width / 2.
std::uint64_t draw_lines(pipeline::Surface& surface, std::uint32_t width) {
    std::uint64_t count = draw_square(surface, 32, 240, 0, 0xff773377);
    // The register value 0 draws no line.
    if (width == 0) return count;
    const std::uint32_t rows = std::max(1u, width >> 3);
    const float y = 304.0f - static_cast<float>(rows >> 1), z = static_cast<float>(window_z(1.5, units));
    for (const float x : {33.0f, 289.0f})
        count += surface.draw(counted, box({x, y, x + 64, y + static_cast<float>(rows)}, white, z));
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
