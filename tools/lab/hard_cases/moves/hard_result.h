// tools/lab/hard_cases/moves/hard_result.h - the visible result of a renderer at each pixel (triangles, their layers,
// the colour), and the differences of two such results.
//
// Rule     A fragment's place is the number of its layer from near to far; fragments of one layer share it, and a
//          fragment that was never composited has none. Between two results a fragment is gained or lost if only one of
//          them composites it. Two fragments of a pixel that both composite are reordered if their relation (in front,
//          behind, equal) changes. The colour change is the largest of three channels, at pixels without gains and
//          losses; the depth change is the largest of a fragment that both composite.
// Tests    tests/tools/lab/hard_cases/hard_result_test.cpp
#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace strata::peeling {
struct Algorithm;
class Renderer;
}  // namespace strata::peeling

namespace strata::tools {

struct ResultFragment {
    std::uint32_t primitive = 0;
    int layer = -1;    // -1: never composited
    double depth = 0;  // as stored, of the depth range 0 to 1
    friend auto operator<=>(const ResultFragment&, const ResultFragment&) = default;
};

struct ResultPixel {
    std::vector<ResultFragment> fragments;  // all visible ones, sorted
    int layers = 0;                         // composited layers, counting repetitions
    std::array<double, 3> color{};
};

// Row by row.
using ResultPixels = std::vector<ResultPixel>;

struct Changes {
    std::uint64_t gained = 0, lost = 0, reordered = 0;
    double color = 0;  // summed over the pixels, in 1/255
    double depth = 0;
    Changes& operator+=(const Changes& other);
    // True if a fragment was gained or lost, or an order changed.
    [[nodiscard]] bool is_any() const noexcept { return gained + lost + reordered > 0; }
    friend bool operator==(const Changes&, const Changes&) = default;
};

[[nodiscard]] Changes changes(const ResultPixel& before, const ResultPixel& after);

enum class FragmentOrderMatch : std::uint8_t { in_order, in_any_order };
// True if the pixel composites exactly the fragments of `exact`, each once, and, if `what` requires it, in their order.
[[nodiscard]] bool matches(const ResultPixel& pixel, const ResultPixel& exact, FragmentOrderMatch what);

struct RenderedPixels {
    ResultPixels pixels;
    std::string refusal;             // the message; empty: it ran
    bool reports_misplaced = false;  // a diagnostic explains misplaced fragments
};
[[nodiscard]] RenderedPixels render(peeling::Renderer& renderer, const peeling::Algorithm& algorithm, int width);
// The same without the algorithm's passes: layers are the distinct stored depths, and each is the first submitted
// fragment of its depth.
[[nodiscard]] RenderedPixels result_of_depths(peeling::Renderer& renderer, const peeling::Algorithm& algorithm);

}  // namespace strata::tools
