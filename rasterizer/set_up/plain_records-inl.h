// rasterizer/set_up/plain_records-inl.h - common parts of the kernels of plain_triangles.h: loading the corners of a
// group of triangles and writing their records. For *_simd.cpp only: Highway compiles it once per instruction set, in
// each file that includes foreach_target.h. Tests: tests/rasterizer/set_up/plain_triangles_test.cpp
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "hwy/highway.h"
#include "rasterizer/set_up/plain_triangles.h"

#if defined(STRATA_RASTERIZER_PLAIN_RECORDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_RASTERIZER_PLAIN_RECORDS_INL_H
#undef STRATA_RASTERIZER_PLAIN_RECORDS_INL_H
#else
#define STRATA_RASTERIZER_PLAIN_RECORDS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::rasterizer::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U = hn::CappedTag<std::uint32_t, TriangleGroup::size>;
using I = hn::RebindToSigned<U>;
using VU = hn::Vec<U>;
using VI = hn::Vec<I>;
using Mask = hn::Mask<I>;
constexpr std::size_t lanes = hn::MaxLanes(U{}), group_size = TriangleGroup::size;
alignas(64) constexpr std::uint32_t numbers[group_size] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

HWY_INLINE VI set(std::int32_t v) { return hn::Set(I{}, v); }

// The words of a group's records, in groups of four.
struct Records {
    alignas(64) std::array<std::uint32_t, 4> first[group_size], second[group_size];
};
static_assert(sizeof(TriangleRecord) == 2 * sizeof(Records::first[0]) && std::is_trivially_copyable_v<TriangleRecord>);

HWY_INLINE std::uint32_t bits_of(Mask mask) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(I{}, mask, bytes);
    return static_cast<std::uint32_t>(bytes[1]) << 8 | bytes[0];
}

// A corner is three 64-bit words: snapped x and y, unsnapped x and y, z and 1 / w.
static_assert(sizeof(WindowCorner) == 3 * sizeof(std::uint64_t) && offsetof(WindowCorner, p) == 0 &&
              offsetof(WindowCorner, unsnapped) == sizeof(std::uint64_t));
using Words = hn::Repartition<std::uint64_t, U>;
// Loads two words of each corner, starting at `corners`, for every second triangle from the one at `index`: one load
// per corner, because a gather takes as long as three loads.
template <class D>
HWY_INLINE hn::Vec<D> load_words(D d, const std::uint64_t* corners, const std::uint32_t* index) {
    if constexpr (hn::MaxLanes(D{}) == 2) {
        return hn::LoadU(d, corners + 3 * std::size_t{*index});
    } else {
        const hn::Half<D> half;
        constexpr std::size_t next = 3 * hn::MaxLanes(half);
        return hn::Combine(d, load_words(half, corners, index + next), load_words(half, corners, index));
    }
}
// The halves of word `word` (0 or 1) of corner `index` of `lanes` triangles.
HWY_INLINE void load_halves(const WindowCorner* corners, std::size_t word, const std::uint32_t* index, VI& low,
                            VI& high) {
    const auto* const words = reinterpret_cast<const std::uint64_t*>(corners) + word;
    const auto pairs = [&](const std::uint32_t* from) HWY_ATTR {
        return hn::BitCast(
            I{}, hn::InterleaveLower(Words{}, load_words(Words{}, words, from), load_words(Words{}, words, from + 3)));
    };
    const VI before = pairs(index), behind = pairs(index + 3 * lanes / 2);
    low = hn::ConcatEven(I{}, behind, before);
    high = hn::ConcatOdd(I{}, behind, before);
}

// A kernel's results for `lanes` triangles: boxes of window pixels, 0 by 0 if none is in the viewport.
struct PlainShapes {
    Mask is_degenerate, is_negative;  // the sign of the area
    VI x0, y0, width, height;
    Mask is_tiny;       // as in the record
    VI covered;         // the covered pixels, as in the record
    Mask is_uncovered;  // known to cover nothing
};

// Adds the records of `lanes` triangles, starting at record `first` of the group, and their fates; sets a bit of
// kept_bits for each kept triangle.
HWY_INLINE void add_records(const PlainTriangleRules& rules, const PlainShapes& s, const std::uint32_t* indices,
                            std::uint32_t primitive, std::size_t first, Records& records, PlainFates& fates,
                            std::uint32_t& kept_bits) {
    VU vertex[3];
    hn::LoadInterleaved3(U{}, indices + 3 * first, vertex[0], vertex[1], vertex[2]);
    for (VU& v : vertex) v = hn::Add(v, hn::Set(U{}, rules.first_vertex));
    const Mask is_front = rules.positive_is_front ? hn::Not(s.is_negative) : s.is_negative;
    const VI drops_front = set(rules.drops_front ? -1 : 0), drops_back = set(rules.drops_back ? -1 : 0);
    const Mask is_dropped = hn::MaskFromVec(hn::IfThenElse(is_front, drops_front, drops_back));
    const Mask is_culled = hn::AndNot(s.is_degenerate, is_dropped);
    const Mask is_gone = hn::Or(s.is_degenerate, is_culled);
    const Mask has_no_box = hn::Or(hn::Eq(s.width, hn::Zero(I{})), hn::Eq(s.height, hn::Zero(I{})));
    const Mask has_box = hn::Not(hn::Or(is_gone, has_no_box));
    const Mask is_uncovered = hn::And(has_box, s.is_uncovered);
    fates.degenerate += static_cast<std::uint32_t>(hn::CountTrue(I{}, s.is_degenerate));
    fates.culled += static_cast<std::uint32_t>(hn::CountTrue(I{}, is_culled));
    fates.outside += static_cast<std::uint32_t>(hn::CountTrue(I{}, hn::AndNot(is_gone, has_no_box)));
    fates.uncovered += static_cast<std::uint32_t>(hn::CountTrue(I{}, is_uncovered));
    kept_bits |= bits_of(hn::AndNot(is_uncovered, has_box)) << first;
    const VI left = hn::Sub(s.x0, set(rules.x0)), above = hn::Sub(s.y0, set(rules.y0));
    const auto pair = [](VI low, VI high) HWY_ATTR { return hn::BitCast(U{}, hn::Or(low, hn::ShiftLeft<16>(high))); };
    const VI facing = hn::IfThenElseZero(is_front, set(1)), tiny = hn::IfThenElseZero(s.is_tiny, set(2));
    const VU number = hn::Add(hn::Set(U{}, primitive), hn::Load(U{}, numbers + first));
    hn::StoreInterleaved4(vertex[0], vertex[1], vertex[2], number, U{}, records.first[first].data());
    hn::StoreInterleaved4(
        hn::Set(U{}, rules.material), pair(left, above), pair(hn::Add(left, s.width), hn::Add(above, s.height)),
        pair(hn::Or(facing, tiny), hn::IfThenElseZero(s.is_tiny, s.covered)), U{}, records.second[first].data());
}

// SetUpPlainTriangles. `find(rules, indices, corners, first, shapes)` computes the shapes of `lanes` triangles,
// starting at triangle `first` of the group; it returns false if one of them is not plain.
template <auto find>
bool set_up_plain_group(const PlainTriangleRules& rules, const std::uint32_t* indices, std::uint32_t primitive,
                        std::span<const WindowCorner> corners, const std::uint32_t* marks, TriangleRecord* out,
                        PlainFates& fates) {
    std::uint32_t marked = 0;
    for (std::size_t i = 0; marks != nullptr && i < 3 * group_size; ++i) marked |= marks[indices[i]];
    if (marked != 0) return false;
    Records records;
    std::uint32_t kept = 0;
    PlainFates found = fates;
    for (std::size_t first = 0; first < group_size; first += lanes) {
        PlainShapes shapes;
        if (!find(rules, indices, corners.data(), first, shapes)) return false;
        add_records(rules, shapes, indices, primitive, first, records, found, kept);
    }
    for (std::size_t k = 0; k < group_size; ++k) {
        // Written whether it is kept or not: if not, the next record overwrites it.
        auto* const bytes = reinterpret_cast<std::byte*>(out);
        std::memcpy(bytes, &records.first[k], sizeof records.first[k]);
        std::memcpy(bytes + sizeof records.first[k], &records.second[k], sizeof records.second[k]);
        out += kept >> k & 1;
    }
    found.kept += static_cast<std::uint32_t>(std::popcount(kept));
    fates = found;
    return true;
}

}  // namespace strata::rasterizer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
