// tools/lab/hard_cases/hard_seen.h - what a renderer shows at each pixel: which triangles, in which layers, of which
// colour; and how two such pictures differ.
//
// Rule     A fragment's place is the number of its layer from near to far; two fragments of one layer share it, and one
//          that was never composited has none. Between two pictures a fragment is gained or lost if only one of them
//          composites it; two fragments of a pixel that both composite are reordered if what is before, behind or equal
//          changes; the colour change is the greatest of three channels, at pixels that gain and lose nothing, and the
//          depth change the greatest of a fragment that both composite.
// Tests    tests/tools/hard_cases/hard_seen_test.cpp
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

struct SeenFragment {
    std::uint32_t primitive = 0;
    int place = -1;    // -1: never composited
    double depth = 0;  // as stored, of the depth range 0 to 1
    friend auto operator<=>(const SeenFragment&, const SeenFragment&) = default;
};

struct SeenPixel {
    std::vector<SeenFragment> fragments;  // sorted; every visible one
    int layers = 0;                       // composited, repeated ones as often as they were
    std::array<double, 3> color{};
};

// Row by row.
using Seen = std::vector<SeenPixel>;

struct Changes {
    std::uint64_t gained = 0, lost = 0, reordered = 0;
    double color = 0;  // summed over the pixels, in 1/255
    double depth = 0;
    Changes& operator+=(const Changes& other);
    // Whether a fragment or an order changed.
    [[nodiscard]] bool is_any() const noexcept { return gained + lost + reordered > 0; }
    friend bool operator==(const Changes&, const Changes&) = default;
};

[[nodiscard]] Changes changes(const SeenPixel& before, const SeenPixel& after);

enum class Shown : std::uint8_t { in_order, in_any_order };
// Whether the pixel composites exactly the fragments of `exact`, each once, and if asked for in their order.
[[nodiscard]] bool shows(const SeenPixel& pixel, const SeenPixel& exact, Shown what);

struct Looked {
    Seen seen;
    std::string refusal;           // the sentence; empty: it ran
    bool names_misplaced = false;  // a diagnostic explains fragments in wrong places
};
[[nodiscard]] Looked look(peeling::Renderer& renderer, const peeling::Algorithm& algorithm, int width);
// The same without the algorithm's passes: layers are the distinct stored depths, and the first submitted has each.
[[nodiscard]] Looked look_at_depths(peeling::Renderer& renderer, const peeling::Algorithm& algorithm);

}  // namespace strata::tools
