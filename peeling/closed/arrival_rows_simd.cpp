// peeling/closed/arrival_rows_simd.cpp - arrival_rows.h for every instruction set.
// How kernels are written: kernels.md. Tests: tests/peeling/closed/arrival_rows_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peeling/closed/arrival_rows_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "peeling/closed/arrival_rows.h"
#include "peeling/programs/keys-inl.h"
#include "pipeline/stages/color_planes-inl.h"
#include "pipeline/stages/tiny_colors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::peeling::HWY_NAMESPACE {
namespace {

namespace raster = rasterizer::HWY_NAMESPACE;
using pipeline::HWY_NAMESPACE::ColorPlanes;
using raster::F32;
using raster::F64;
using raster::U32;
using raster::V32;
using rasterizer::DrawnTriangle;
using WordVec = hn::Vec<U32>;
using WordMask = hn::Mask<U32>;
using Wide = hn::Rebind<std::uint64_t, F64>;
constexpr std::size_t lane_count = hn::MaxLanes(U32{});

// The places of neighbours after the first one's: of a triangle of one colour, and of others.
alignas(32) constexpr std::uint32_t after_first[2][8] = {{0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 2, 3, 4, 5, 6, 7}};

// Sets without a walk over rows call neither this nor put_one.
[[maybe_unused]] HWY_INLINE std::uint32_t bits_of(WordMask mask) {
    return raster::bits_of(hn::RebindMask(F32{}, mask));
}

struct AppendState {
    Arrivals& to;
    rasterizer::DepthConversion<float> to_code;
    double z_units;
    std::uint64_t fragments = 0;
    bool has_room = true;
};

// Without room the word is dropped and the walk goes on: its caller gives the whole band up.
[[maybe_unused]] HWY_INLINE void put_one(AppendState& state, const Arrivals& to, std::uint32_t pixel,
                                         std::uint64_t word) {
    const std::uint32_t rank = to.count[pixel];
    if (HWY_UNLIKELY(rank >= to.ranks)) {
        state.has_room = false;
        return;
    }
    to.count[pixel] = rank + 1;
    to.word[rank * to.stride + pixel] = word;
}
// Hidden fragments are counted and not kept. A float key never counts as exactly at the surface, as in scalar::append.
template <bool by_shader_z>
HWY_INLINE void hide_one(const Arrivals& to, std::uint32_t pixel, std::uint32_t key) {
    ++to.hidden[pixel];
    to.at_surface[pixel] += !by_shader_z && key == to.opaque[to.same_opaque ? 0 : pixel] ? 1 : 0;
}

// The body of a walk over rows (rasterizer/walk/row_walk-inl.h): one Shade a triangle, called for each vector of its
// pixels.
template <bool by_shader_z>
struct AppendOf {
    // Pixels of tiny triangles, each a place of its own: a triangle of one colour goes the other way.
    template <bool unsnapped>
    class TinyOf {
      public:
        using Triangles = raster::TinyTriangles<unsnapped>;

        HWY_INLINE TinyOf(AppendState& state, const raster::TinyTriangles<unsnapped>& triangles)
            : state_{state}, to_{state.to}, triangles_{triangles}, color_{triangles}, depth_{z(0), z(1), z(2)} {}
        HWY_INLINE bool suits() const { return !color_.has_flat(); }

        HWY_INLINE void operator()(const raster::TinyPixels& pixels) {
            if (HWY_UNLIKELY(!(state_.has_room &= state_.to.places <= to_.most_places))) return;
            const raster::Weights b = triangles_.weights(pixels);
            const V32 z = depth_.at(pixels, b, triangles_.geometry(), triangles_.triangles());
            const WordVec surface = to_.same_opaque
                                        ? hn::Set(U32{}, to_.opaque[0])
                                        : hn::GatherIndex(U32{}, to_.opaque, hn::BitCast(raster::I32{}, pixels.pixel));
            const Keys<U32> keys = by_shader_z ? keys_of_z(U32{}, z, surface)
                                               : keys_of_code(U32{}, raster::codes(z, state_.to_code), surface);
            const WordMask is_visible = hn::And(hn::RebindMask(U32{}, pixels.covered()), keys.is_visible);
            state_.to.has_denormals |= !hn::AllFalse(U32{}, hn::And(is_visible, keys.is_denormal));
            V32 color[4];
            color_.at(pixels, b, color);
            const std::uint32_t place = state_.to.places;
            for (std::size_t c = 0; c < 4; ++c) hn::StoreU(color[c], F32{}, to_.color[c] + place);
            state_.to.places += pixels.count;
            alignas(64) std::uint32_t pixel[lane_count], key[lane_count];
            hn::Store(pixels.pixel, U32{}, pixel);
            hn::Store(keys.key, U32{}, key);
            const std::uint32_t visible = bits_of(is_visible);
            for (std::uint32_t i = 0; i < pixels.count; ++i)
                if ((visible >> i & 1) != 0)
                    put_one(state_, to_, pixel[i], std::uint64_t{key[i]} << 32 | (place + i));
                else
                    hide_one<by_shader_z>(to_, pixel[i], key[i]);
        }
        HWY_INLINE void finish(std::uint64_t pixels) { state_.fragments += pixels; }

      private:
        HWY_INLINE raster::V64 z(std::size_t i) const { return hn::PromoteTo(F64{}, triangles_.z(i)); }

        AppendState& state_;
        const Arrivals to_;
        const raster::TinyTriangles<unsnapped>& triangles_;
        const pipeline::HWY_NAMESPACE::TinyColors<unsnapped> color_;
        const raster::TinyPlane<unsnapped> depth_;
    };

    template <bool unsnapped>
    class Shade {
      public:
        using Tiny = TinyOf<unsnapped>;

        HWY_INLINE Shade(AppendState& state, const DrawnTriangle& triangle)
            : state_{state},
              to_{state.to},
              to_code_{state.to_code},
              triangle_{triangle},
              color_{triangle},
              depth_{triangle.geometry.depths(triangle.index), 1.0, state.z_units},
              filter_{raster::filter_of(depth_, triangle)},
              places_{to_.places} {}

        // Takes neighbours of a large triangle: they are covered from the first lane on.
        HWY_INLINE void operator()(const raster::Row& row, const raster::Weights& b) {
            const WordMask covered = hn::RebindMask(U32{}, row.covered);
            const WordVec count = hn::IfThenElseZero(covered, hn::LoadU(U32{}, to_.count + row.pixel));
            if (HWY_UNLIKELY(!has_places() || !has_ranks(count))) return;
            const Keys<U32> keys = keys_at(row, b);
            const WordMask is_visible = hn::And(covered, keys.is_visible),
                           is_hidden = hn::AndNot(keys.is_visible, covered);
            if (HWY_UNLIKELY(!hn::AllFalse(U32{}, is_hidden))) hide(row.pixel, keys.key, is_hidden);
            put(row, words_of(keys.key, place_of(row, b)), is_visible, count);
        }
        // Takes pixels of a small triangle, wherever they lie.
        HWY_INLINE void operator()(const raster::Pixels& pixels, const raster::Weights& b) {
            if (HWY_UNLIKELY(!has_places())) return;
            const Keys<U32> keys = keys_at(pixels, b);
            alignas(64) std::uint32_t pixel[lane_count];
            alignas(64) std::uint64_t word[lane_count];
            hn::Store(pixels.pixel, U32{}, pixel);
            hn::Store(words_of(keys.key, place_of(pixels, b)), Wide{}, word);
            const std::uint32_t covered = raster::bits_of(pixels.covered), visible = covered & bits_of(keys.is_visible);
            const auto end = static_cast<std::size_t>(std::popcount(covered));
            if (HWY_LIKELY(visible == covered)) {
                for (std::size_t i = 0; i < end; ++i) put_one(state_, to_, pixel[i], word[i]);
            } else {
                for (std::size_t i = 0; i < end; ++i)
                    if ((visible >> i & 1) != 0)
                        put_one(state_, to_, pixel[i], word[i]);
                    else
                        hide_one<by_shader_z>(to_, pixel[i], static_cast<std::uint32_t>(word[i] >> 32));
            }
        }
        HWY_INLINE void finish(std::uint64_t pixels) {
            state_.fragments += pixels;
            state_.to.places = places_;
            if (by_shader_z) state_.to.has_denormals |= !hn::AllTrue(U32{}, hn::Eq(denormals_, hn::Zero(U32{})));
        }

      private:
        // The key by the filtered plane: lanes whose rounding the filter cannot settle are decided exactly (depth.md
        // 3.3 and 3.4).
        template <class Where>
        HWY_INLINE Keys<U32> keys_at(const Where& where, const raster::Weights& b) {
            const V32 z =
                raster::rounded_plane<unsnapped>(filter_, b, depth_, triangle_.geometry, triangle_.index, where);
            const WordVec surface = to_.same_opaque ? hn::Set(U32{}, to_.opaque[0]) : surface_at(where);
            if constexpr (!by_shader_z) return keys_of_code(U32{}, raster::codes(z, to_code_), surface);
            const Keys<U32> keys = keys_of_z(U32{}, z, surface);
            const WordMask is_visible = hn::And(hn::RebindMask(U32{}, where.covered), keys.is_visible);
            denormals_ = hn::Or(denormals_, hn::VecFromMask(U32{}, hn::And(is_visible, keys.is_denormal)));
            return keys;
        }
        HWY_INLINE WordVec surface_at(const raster::Row& row) const { return hn::LoadU(U32{}, to_.opaque + row.pixel); }
        HWY_INLINE WordVec surface_at(const raster::Pixels& pixels) const {
            return hn::GatherIndex(U32{}, to_.opaque, hn::BitCast(raster::I32{}, pixels.pixel));
        }

        // A row, or eight pixels, takes no more places than it has lanes.
        HWY_INLINE bool has_places() { return state_.has_room &= places_ <= to_.most_places; }
        // A hidden fragment asks for a word, too.
        HWY_INLINE bool has_ranks(WordVec count) {
            return state_.has_room &= hn::AllTrue(U32{}, hn::Lt(count, hn::Set(U32{}, to_.ranks)));
        }

        // The place of the first of some fragments whose colours it puts down; the others' are the next ones.
        template <class Where>
        HWY_INLINE std::uint32_t place_of(const Where& where, const raster::Weights& b) {
            if (color_.is_flat()) return flat_place();
            V32 color[4];
            color_.template at<unsnapped>(where, b, color);
            const std::uint32_t place = places_;
            for (std::size_t c = 0; c < 4; ++c) hn::StoreU(color[c], F32{}, to_.color[c] + place);
            places_ += static_cast<std::uint32_t>(hn::CountTrue(F32{}, where.covered));
            return place;
        }
        // The one place of a triangle of one colour.
        HWY_INLINE std::uint32_t flat_place() {
            if (flat_place_ == none) {
                flat_place_ = places_++;
                for (std::size_t c = 0; c < 4; ++c) to_.color[c][flat_place_] = color_.flat(c);
            }
            return flat_place_;
        }
        // Key above, place below: kernels.md 8.
        HWY_INLINE hn::Vec<Wide> words_of(WordVec key, std::uint32_t first_place) const {
            const U32 d;
            const WordVec place = hn::Add(hn::Set(d, first_place), hn::Load(d, after_first[color_.is_flat() ? 0 : 1]));
            return hn::Or(hn::ShiftLeft<32>(hn::PromoteTo(Wide{}, key)), hn::PromoteTo(Wide{}, place));
        }

        HWY_INLINE void hide(std::size_t pixel, WordVec key, WordMask lost) const {
            const auto add = [&](std::uint32_t* counts, WordMask which) HWY_ATTR {
                const WordVec more = hn::Add(hn::LoadU(U32{}, counts + pixel), hn::Set(U32{}, 1));
                hn::BlendedStore(more, which, U32{}, counts + pixel);
            };
            add(to_.hidden, lost);
            if constexpr (by_shader_z) return;
            const WordVec surface =
                to_.same_opaque ? hn::Set(U32{}, to_.opaque[0]) : hn::LoadU(U32{}, to_.opaque + pixel);
            add(to_.at_surface, hn::And(lost, hn::Eq(key, surface)));
        }

        // Neighbours where all covered pixels have as many arrivals. That branch looks at counts alone, which are there early.
        HWY_INLINE void put(const raster::Row& row, hn::Vec<Wide> words, WordMask is_visible, WordVec count) const {
            const U32 d;
            const Wide wide;
            alignas(8) std::uint8_t bits[8] = {static_cast<std::uint8_t>(bits_of(is_visible))};
            const auto is_put = hn::LoadMaskBits(wide, bits);
            const std::uint32_t rank = to_.count[row.pixel];
            const WordMask differs = hn::And(hn::RebindMask(d, row.covered), hn::Ne(count, hn::Set(d, rank)));
            hn::BlendedStore(hn::Add(count, hn::Set(d, 1)), is_visible, d, to_.count + row.pixel);
            if (hn::AllFalse(d, differs)) {
                hn::BlendedStore(words, is_put, wide, to_.word + rank * to_.stride + row.pixel);
                return;
            }
            const raster::V64 ranks = hn::PromoteTo(F64{}, hn::BitCast(raster::I32{}, count));
            const raster::V64 pixels =
                hn::Add(hn::Set(F64{}, static_cast<double>(row.pixel)), hn::Load(F64{}, raster::counting64));
            const raster::V64 index = hn::Add(hn::Mul(ranks, hn::Set(F64{}, static_cast<double>(to_.stride))), pixels);
            const auto nobodys = hn::Set(F64{}, static_cast<double>(to_.stride - 1));
            const auto is_put_here = hn::RebindMask(F64{}, is_put);
            hn::ScatterIndex(words, wide, to_.word,
                             hn::ConvertTo(hn::RebindToSigned<Wide>{}, hn::IfThenElse(is_put_here, index, nobodys)));
        }
        AppendState& state_;
        const Arrivals to_;  // what stands in the state, where a store could not have changed it
        const rasterizer::DepthConversion<float> to_code_;
        const DrawnTriangle& triangle_;
        const ColorPlanes color_;
        const rasterizer::RationalPlane depth_;
        const rasterizer::FilterPlane filter_;
        static constexpr std::uint32_t none = ~0u;
        std::uint32_t places_, flat_place_ = none;
        WordVec denormals_ = hn::Zero(U32{});
    };
};

struct CountState {
    std::uint32_t *coverage, *places;
    int y0;
};

// Counts coverage and places alone: neither depth nor colour is computed.
template <bool unsnapped>
class CountShade {
  public:
    HWY_INLINE CountShade(CountState& state, const DrawnTriangle& triangle)
        : state_{state}, is_flat_{ColorPlanes{triangle}.is_flat()} {}

    HWY_INLINE void operator()(const raster::Row& row, const raster::Weights&) const {
        std::uint32_t* const coverage = state_.coverage + row.pixel;
        const WordVec more = hn::Add(hn::LoadU(U32{}, coverage), hn::Set(U32{}, 1));
        hn::BlendedStore(more, hn::RebindMask(U32{}, row.covered), U32{}, coverage);
        const auto pixels = static_cast<std::uint32_t>(hn::CountTrue(F32{}, row.covered));
        state_.places[row.y - state_.y0] += is_flat_ ? 1 : pixels;
    }
    HWY_INLINE void finish(std::uint64_t) const {}

  private:
    const CountState state_;
    const bool is_flat_;
};

bool append_all(Arrivals& to, const pipeline::RowSource& source, std::span<const std::uint32_t> triangles,
                const rasterizer::Rect& band, rasterizer::DepthConversion<float> to_code, double z_units,
                std::uint64_t& fragments) {
    AppendState state{to, to_code, z_units};
    if (to.by_shader_z)
        raster::RowWalk<AppendOf<true>::template Shade, AppendState>{state, source.geometry, band}.draw(triangles);
    else
        raster::RowWalk<AppendOf<false>::template Shade, AppendState>{state, source.geometry, band}.draw(triangles);
    fragments += state.fragments;
    return state.has_room;
}

void count_all(const pipeline::RowSource& source, const rasterizer::Rect& region, std::uint32_t* coverage,
               std::uint32_t* places) {
    CountState state{coverage, places, region.y0};
    raster::RowWalk<CountShade, CountState>{state, source.geometry, region}.draw(source.triangles);
}

}  // namespace
}  // namespace strata::peeling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"
#include "rasterizer/set_up/window.h"

namespace strata::peeling {
STRATA_EXPORT(append_all);
STRATA_EXPORT(count_all);

bool append_rows(Arrivals& to, const pipeline::RowSource& source, std::span<const std::uint32_t> triangles,
                 const rasterizer::Rect& band, std::uint64_t& fragments) noexcept {
    const rasterizer::Geometry& geometry = source.geometry;
    const rasterizer::FragmentValues values{geometry, source.depth, {.shader_z = false, .code = true, .color = false}};
    return kernel_of(HWY_DISPATCH_TABLE(append_all))(to, source, triangles, band, values.to_code(),
                                                     rasterizer::z_units(geometry.state, geometry.rules), fragments);
}

void count_rows(const pipeline::RowSource& source, const rasterizer::Rect& region, std::uint32_t* coverage,
                std::uint32_t* places) noexcept {
    kernel_of(HWY_DISPATCH_TABLE(count_all))(source, region, coverage, places);
}

}  // namespace strata::peeling
#endif
