// tools/oracle/program/lists.h - what a port composites: the fragments of every pixel, near to far, what is behind
// them, and the colour that the candidate has there.
//
// Rule     A pixel's fragments are the visible ones by depth code. What a port does with equal codes is not part of the
//          question; the list counts that comes closest: all of a group, its first, its last, or one layer by MAX, as
//          in ties.h of the rules. A pixel at an edge that only another rasterizer's coverage explains (coverages.h)
//          has no list, as it shows no mistake.
// Numbers  `unit` is the step in which residuals are counted: one code of the candidate's format, 2^-11 of halves,
//          2^-18 of binary32.
// Tests    tests/tools/oracle/program/parts_test.cpp
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/oracle/program/rounding.h"

namespace strata::oracle::verdict {
class SceneFragments;
class Colors;
struct Fragment;
}  // namespace strata::oracle::verdict

namespace strata::oracle::program {

using Color = std::array<double, 3>;
inline constexpr std::size_t tie_orders = 2;

struct ListFragment {
    Color color{};  // not premultiplied
    double alpha = 0;
    double depth = 0;              // in [0, 1], less is nearer
    std::uint32_t code = 0;        // stored depth
    std::uint32_t submission = 0;  // its rank among the pixel's fragments in submission order
    double triangle_depth = 0;     // mean of its triangle in the picture
    std::uint32_t primitive = 0, instance = 0, material = 0;
    bool is_front_facing = true;
};

struct ListPixel {
    int x = 0, y = 0;
    std::size_t first = 0;  // fragments of all pixels before it
    std::span<const ListFragment> fragments{};
    // If depth codes are equal: the list with their groups in other orders (`tie_orders` of them), then with one layer
    // for each group.
    std::vector<std::vector<ListFragment>> ties{};
    Color behind{};  // the opaque surface, or the background
    bool has_opaque = false;
    std::uint32_t opaque_code = 0;  // its stored depth
    Color seen{};                   // the candidate's
};

// Row by row from the top. Pixels refer to `fragments`, so that lists move and are not copied.
struct Lists {
    Lists() = default;
    Lists(Lists&&) = default;
    Lists& operator=(Lists&&) = default;
    Lists(const Lists&) = delete;
    Lists& operator=(const Lists&) = delete;
    ~Lists() = default;

    int width = 0, height = 0;
    PortFormat format = PortFormat::unorm8;  // of the candidate
    std::vector<ListFragment> fragments{};
    std::vector<ListPixel> pixels{};
    [[nodiscard]] double unit() const noexcept { return step_of(format); }
};

// The lists of a scene whose fragments are kept; with the other coverage of its edges, if that was found.
// `has_all_pixels`: also of pixels that only another coverage explains.
[[nodiscard]] Lists lists_of(const verdict::SceneFragments& scene, const verdict::Colors& candidate,
                             bool has_all_pixels = false);
// A fragment among those of its pixel.
[[nodiscard]] ListFragment list_fragment(const verdict::Fragment& fragment, std::span<const verdict::Fragment> of);

// Sets the spans of the pixels, whose `first` are known, the triangles' depths, and, if the order of equal codes is
// open (`is_tied`), the lists with other ones.
void complete(Lists& lists, bool is_tied = true);

}  // namespace strata::oracle::program
