// tools/oracle/verdict/hypothesis.h - how an implementation may keep and round the colours that it composites.
//
// Rule     A hypothesis holds for a whole picture. It names the order of blending, how colours are kept at each end,
//          and what the picture is stored in. It says nothing of which fragments are composited: that is the structure.
// Source   GL 4.6 17.3.6 and Direct3D 11.3 17 leave formats, roundings and the source's precision to the
//          implementation.
// Tests    tests/tools/oracle/verdict/composite_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/oracle/codes.h"

namespace strata::oracle::verdict {

// What an accumulator or a picture keeps of a colour.
enum class Storage : std::uint8_t { unorm8, unorm10, unorm16, half, single };
[[nodiscard]] std::string_view name(Storage storage) noexcept;
// Whether colours are whole numbers of a unit.
[[nodiscard]] constexpr bool has_codes(Storage storage) noexcept {
    return storage != Storage::half && storage != Storage::single;
}
// Of a picture's codes; integers have none and are taken for binary32.
[[nodiscard]] Storage storage_of(Code code) noexcept;

// What becomes of a fragment's colour before it is blended.
enum class Source : std::uint8_t {
    stored,  // rounded to the accumulator's format, as a layer or as an 8-bit blender's operand; halves go up
    stored_either_way,  // the same, halves up or down
    premultiplied,      // times alpha, then rounded like `stored`
    premultiplied_either_way,
    premultiplied_cut,  // the same, cut
    unrounded,          // binary32, as Direct3D allows
    any                 // any of these
};

// How a blend's exact result becomes a stored one. Floats have `nearest` and `any`; the latter may cut.
enum class Rounding : std::uint8_t {
    nearest,
    cut,       // toward zero
    products,  // each product by itself, then the sum: half a code twice
    held,      // nearest, or kept in binary32 until the pass ends
    any        // up to one code either way
};

struct End {
    Storage storage = Storage::unorm8;
    Source source = Source::stored;
    Rounding rounding = Rounding::nearest;
    friend bool operator==(const End&, const End&) = default;
};

enum class Order : std::uint8_t {
    over,            // back to front, onto the background
    over_apart,      // back to front onto nothing; the result is blended over the background
    under,           // front to back
    both_ends,       // near layers UNDER, far ones OVER the background; of an odd number the middle one is near
    both_ends_far,   // the middle one is far
    both_ends_apart  // as both_ends, the far ones onto nothing
};
[[nodiscard]] std::string_view name(Order order) noexcept;
[[nodiscard]] constexpr bool has_front(Order order) noexcept {
    return order != Order::over && order != Order::over_apart;
}
[[nodiscard]] constexpr bool has_back(Order order) noexcept { return order != Order::under; }

struct Hypothesis {
    Order order = Order::over;
    End front{}, back{};  // of `over` the back alone counts, of `under` the front; the background is kept as `back` is
    End result{};         // its source counts for nothing
    double slack = 0;     // by which a fragment's colours and alpha may be off, of values in [0, 1]
    friend bool operator==(const Hypothesis&, const Hypothesis&) = default;
};

// "accumulators 8-bit rounded to nearest, front to back": for a sentence.
[[nodiscard]] std::string describe(const Hypothesis& hypothesis);

// Those of one order and one pair of storages; the widest one holds what any of the others does.
struct HypothesisFamily {
    Hypothesis widest{};
    std::vector<Hypothesis> members{};
};
using Families = std::vector<HypothesisFamily>;

// All that are tried for a picture of this storage, once with each slack, in increasing order. Definite ones have one
// rounding and one format an end, as a device or a program may; loose ones may round anyhow beside that.
enum class Looseness : std::uint8_t { definite, loose };
[[nodiscard]] Families families(Storage result, const std::vector<double>& slacks, Looseness looseness);
// One of each order, which holds what any other one of the families does.
[[nodiscard]] std::vector<Hypothesis> widest(const Families& all);

}  // namespace strata::oracle::verdict
