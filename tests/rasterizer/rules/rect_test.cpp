// Tests rectangles as sets of pixels, counted one by one.
#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/coverage/window_corner.h"
#include "rasterizer/rules/raster_state.h"

namespace {

using namespace strata::rasterizer;

constexpr int rect_low = -2, rect_high = 3;

[[nodiscard]] bool rect_holds(const Rect& r, int x, int y) { return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1; }

[[nodiscard]] std::vector<Rect> all_rects() {
    std::vector<Rect> all;
    for (int x0 = rect_low; x0 <= rect_high; ++x0)
        for (int x1 = rect_low; x1 <= rect_high; ++x1)
            for (int y = rect_low; y <= rect_high; ++y) all.push_back({x0, y, x1, (x0 + 2 * x1 + 5) % 6 - 2});
    return all;
}

}  // namespace

TEST_CASE("a rectangle has as many pixels as it contains and none if its ends are reversed") {
    std::uint64_t wrong = 0;
    for (int x0 = rect_low; x0 <= rect_high; ++x0)
        for (int y0 = rect_low; y0 <= rect_high; ++y0)
            for (int x1 = rect_low; x1 <= rect_high; ++x1)
                for (int y1 = rect_low; y1 <= rect_high; ++y1) {
                    const Rect r{x0, y0, x1, y1};
                    std::size_t columns = 0, rows = 0;
                    for (int i = rect_low; i < rect_high; ++i) {
                        columns += i >= x0 && i < x1 ? 1 : 0;
                        rows += i >= y0 && i < y1 ? 1 : 0;
                    }
                    wrong += static_cast<std::size_t>(r.width()) != columns ||
                                     static_cast<std::size_t>(r.height()) != rows || r.area() != columns * rows
                                 ? 1
                                 : 0;
                }
    CHECK(wrong == 0);
    CHECK(Rect{0, 0, 1 << 20, 1 << 20}.area() == std::size_t{1} << 40);
}

TEST_CASE("two rectangles share exactly the pixels that both contain in either order") {
    std::uint64_t wrong = 0, shared = 0;
    const std::vector<Rect> all = all_rects();
    for (std::size_t i = 0; i < all.size(); i += 2)
        for (const Rect& b : all) {
            const Rect& a = all[i];
            const Rect both = intersection(a, b), other = intersection(b, a);
            for (int y = rect_low; y < rect_high; ++y)
                for (int x = rect_low; x < rect_high; ++x) {
                    const bool expected = rect_holds(a, x, y) && rect_holds(b, x, y);
                    shared += expected ? 1 : 0;
                    wrong += rect_holds(both, x, y) != expected || rect_holds(other, x, y) != expected ? 1 : 0;
                }
        }
    CHECK(wrong == 0);
    CHECK(shared > 500);
}

TEST_CASE("a box is relative to the viewport's corner on each axis") {
    const PixelBox box = in_viewport({15, 9, 40, 30}, {13, 7, 60000, 50000});
    CHECK(box.x0 == 2);
    CHECK(box.y0 == 2);
    CHECK(box.x1 == 27);
    CHECK(box.y1 == 23);
    const PixelBox whole = in_viewport({1000, 2000, 66535, 67535}, {1000, 2000, 66535, 67535});
    CHECK(whole.x0 == 0);
    CHECK(whole.y0 == 0);
    CHECK(whole.x1 == 65535);
    CHECK(whole.y1 == 65535);
}
