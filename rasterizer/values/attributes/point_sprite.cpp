// rasterizer/values/attributes/point_sprite.cpp - see point_sprite.h.
#include "rasterizer/values/attributes/point_sprite.h"

#include "rasterizer/chip/truncated_weights.h"
#include "rasterizer/coverage/line_coverage.h"

namespace strata::rasterizer {
namespace {

// `from_point` is c - p in pixels. The product is exact in binary64: 22 bits times 24.
[[nodiscard]] float chip_coordinate(double from_point, int eighths) noexcept {
    if (eighths == 0) return 0.5f;
    return static_cast<float>(truncate_bits(0.5 + 8.0 * from_point * truncate_bits(1.0 / eighths, 24), 24));
}
[[nodiscard]] float square_coordinate(double from_point, float size) noexcept {
    return static_cast<float>(0.5 + from_point / double{size});
}

}  // namespace

void fill_sprite_coordinates(const TriangleFragments& f) noexcept {
    const Geometry& geometry = f.triangle.geometry;
    const float size = geometry.state.point_size_px;
    const int bits = geometry.rules.subpixel_bits;
    const bool is_chip = geometry.rules.points == PointRule::reciprocal;
    const SubpixelPoint p = geometry.points(f.triangle.record)[2];
    const auto coordinate = [&](int from_point) {
        const double pixels = static_cast<double>(from_point) / (1 << bits);
        return is_chip ? chip_coordinate(pixels, register_of_size(size)) : square_coordinate(pixels, size);
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(f.count()); ++i) {
        const SubpixelPoint c = pixel_centre(f.x()[i], f.y()[i], bits);
        f.batch.texcoord[0][f.first + i] = coordinate(c.x - p.x);
        f.batch.texcoord[1][f.first + i] = coordinate(c.y - p.y);
    }
}

}  // namespace strata::rasterizer
