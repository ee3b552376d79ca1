// tools/oracle/rounding/hypothesis.h - describes how an implementation may store and round the colours that it
// composites.
//
// Rule     A hypothesis applies to a whole picture. It states the order of blending, the storage of colours at each
//          end, and the storage of the picture. Which fragments are composited is not part of it: that is the structure
//          (structure.h).
// Source   GL 4.6 17.3.6 and Direct3D 11.3 17 leave formats, rounding and the precision of sources to the
//          implementation.
// Tests    tests/tools/oracle/rounding/composite_test.cpp
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/picture/codes.h"

namespace strata::oracle::verdict {

// The storage of colours in an accumulator or a picture.
enum class Storage : std::uint8_t { unorm8, unorm10, unorm16, half, single };
[[nodiscard]] std::string_view name(Storage storage) noexcept;
// True if colours are stored as whole numbers of a unit.
[[nodiscard]] constexpr bool has_codes(Storage storage) noexcept {
    return storage != Storage::half && storage != Storage::single;
}
// The storage for a picture's code type; plain integers are treated as binary32.
[[nodiscard]] Storage storage_of(Code code) noexcept;

// The rounding of a fragment's colour before it is blended.
enum class SourceRounding : std::uint8_t {
    stored,  // rounded to the accumulator's format, as for a layer or an operand of an 8-bit blender; ties go up
    stored_either_way,  // the same, with ties in either direction
    premultiplied,      // multiplied by alpha, then rounded like `stored`
    premultiplied_either_way,
    premultiplied_truncated,  // the same, truncated
    // Of accumulators of binary32: layers and background were stored in another format, rounded to nearest.
    stored_half,
    premultiplied_half,
    stored_unorm8,
    premultiplied_unorm8,
    unrounded,  // binary32, as Direct3D allows
    any         // any of the above
};

// The format of layers that is not the accumulator's.
[[nodiscard]] std::optional<Storage> layer_storage(SourceRounding source) noexcept;

// The rounding of a blend's exact result. Floats have only `nearest`, for binary16 `truncated`, and `any` of these.
enum class Rounding : std::uint8_t {
    nearest,
    truncated,          // truncated
    products,           // each product is rounded, then added: twice half a code
    held,               // to nearest, or kept in binary32 until the end of the pass
    held_then_nearest,  // the same, and the result is rounded at the end, as by a cache of tiles
    any                 // an error of up to one code in either direction
};

struct End {
    Storage storage = Storage::unorm8;
    SourceRounding source = SourceRounding::stored;
    Rounding rounding = Rounding::nearest;
    friend bool operator==(const End&, const End&) = default;
};

enum class Order : std::uint8_t {
    over,            // back to front, onto the background
    over_apart,      // back to front onto nothing; the result is blended over the background
    under,           // front to back
    both_ends,       // near layers UNDER, far ones OVER the background; a middle layer counts as near
    both_ends_far,   // a middle layer counts as far
    both_ends_apart  // as both_ends, with the far layers onto nothing
};
[[nodiscard]] std::string_view name(Order order) noexcept;
[[nodiscard]] constexpr bool has_front(Order order) noexcept {
    return order != Order::over && order != Order::over_apart;
}
[[nodiscard]] constexpr bool has_back(Order order) noexcept { return order != Order::under; }

struct Hypothesis {
    Order order = Order::over;
    End front{}, back{};  // `over` uses only the back, `under` only the front; the background is stored as `back`
    End result{};         // its source is not used
    double slack = 0;     // possible error of a fragment's colours and alpha, whose values are in [0, 1]
    // The picture's colours were divided by its alpha, which adds an error of up to one code to results of floats.
    bool is_divided = false;
    friend bool operator==(const Hypothesis&, const Hypothesis&) = default;
};

// A phrase for messages, such as "accumulators 8-bit rounded to nearest, front to back".
[[nodiscard]] std::string describe(const Hypothesis& hypothesis);

// The hypotheses of one order and one pair of storages. The widest one includes all values of the others.
struct HypothesisFamily {
    Hypothesis widest{};
    std::vector<Hypothesis> members{};
};
using Families = std::vector<HypothesisFamily>;

// All hypotheses that are tried for a picture of this storage, once per slack, in increasing order. Definite ones have
// one rounding and one format per end, as a device or a program has; loose ones also include arbitrary rounding.
enum class Looseness : std::uint8_t { definite, loose };
[[nodiscard]] Families families(Storage result, const std::vector<double>& slacks, Looseness looseness,
                                bool is_divided = false);
// One hypothesis per order, which includes all values of the families of that order.
[[nodiscard]] std::vector<Hypothesis> widest(const Families& all);

}  // namespace strata::oracle::verdict
