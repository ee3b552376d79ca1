// pipeline/stages/layer_blend_simd.cpp - the loop of layer_blend.h for every instruction set: a vector of neighbouring pixels at a time, from
// stored words to stored words. Vectors go beyond the last pixel, into the spare words of every plane.
// How kernels are written: kernels.md. Tests: tests/pipeline/stages/layer_blend_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/stages/layer_blend_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/stages/layer_blend.h"
#include "pipeline/stages/stored_color-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {

// How many channels lie in a word.
template <class Rules>
constexpr std::size_t per_word = 4;
template <ChannelType type, HalfRounding half>
constexpr std::size_t per_word<FloatRules<type, half>> = type == ChannelType::half ? 2 : 1;

template <class Rules>
class Pixels {
  public:
    using Colors = StoredColors<Rules>;
    using Held = typename Colors::Held;

    HWY_INLINE explicit Pixels(const LayerBlend& job) : job_{job}, color_{job.rules} {}

    template <LayerOrder order>
    HWY_INLINE void blend() const {
        const Words d;
        for (std::size_t i = 0; i < job_.pixels; i += hn::Lanes(d)) {
            if (!Colors::is_float &&
                hn::AllTrue(d, hn::Eq(hn::LoadU(d, job_.depth + i), hn::LoadU(d, job_.surface + i))))
                continue;
            Held source[4], stored[4];
            load(job_.layer, i, source);
            load(job_.to, i, stored);
            blend<order>(source, stored);
            store(i, stored);
        }
    }

  private:
    static constexpr std::size_t in_a_word = per_word<Rules>;
    static constexpr int bits = 32 / static_cast<int>(in_a_word);

    HWY_INLINE static WordVec channel(WordVec word, std::size_t k) {
        const WordVec code = hn::ShiftRightSame(word, static_cast<int>(k) * bits);
        return k + 1 == in_a_word ? code : hn::And(code, hn::Set(Words{}, ~0u >> (32 - bits)));
    }
    HWY_INLINE void load(const Texels& from, std::size_t i, Held (&to)[4]) const {
        for (std::size_t word = 0; word < 4 / in_a_word; ++word) {
            const WordVec codes = hn::LoadU(Words{}, from.plane(word).words + i);
            for (std::size_t k = 0; k < in_a_word; ++k) to[word * in_a_word + k] = color_.held(channel(codes, k));
        }
    }

    // As the twin's.
    template <LayerOrder order>
    HWY_INLINE void blend(const Held (&source)[4], Held (&stored)[4]) const {
        const FloatVec alpha = color_.operand(source[3]), rest = color_.rest(alpha), let = color_.operand(stored[3]);
        for (std::size_t c = 0; c < 4; ++c) {
            const FloatVec s = color_.operand(source[c]), d = color_.operand(stored[c]);
            if constexpr (order == LayerOrder::over)
                stored[c] = color_.add(s, alpha, d, rest);
            else
                stored[c] = c == 3 ? color_.add(s, hn::Zero(Floats{}), d, rest) : color_.add(s, let, d, color_.one());
        }
    }

    // An alpha that is kept keeps its bits, of a NaN, too.
    HWY_INLINE void store(std::size_t i, const Held (&from)[4]) const {
        const Words d;
        for (std::size_t word = 0; word < 4 / in_a_word; ++word) {
            Word* const words = job_.to.plane(word).words + i;
            WordVec codes = color_.codes(from[word * in_a_word]);
            for (std::size_t k = 1; k < in_a_word; ++k)
                codes = hn::Or(codes,
                               hn::ShiftLeftSame(color_.codes(from[word * in_a_word + k]), static_cast<int>(k) * bits));
            const bool has_alpha = (word + 1) * in_a_word == 4;
            if (has_alpha && job_.keeps_alpha) {
                const WordVec kept = hn::Set(d, ~0u << (32 - bits));
                codes = hn::Or(hn::AndNot(kept, codes), hn::And(kept, hn::LoadU(d, words)));
            }
            hn::StoreU(codes, d, words);
        }
    }

    const LayerBlend& job_;
    Colors color_;
};

void blend_pixels(const LayerBlend& job) {
    with_rules(job.rules, [&]<class Rules>(Rules) HWY_ATTR {
        const Pixels<Rules> pixels{job};
        if (job.order == LayerOrder::over)
            pixels.template blend<LayerOrder::over>();
        else
            pixels.template blend<LayerOrder::under>();
    });
}

}  // namespace
}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {

STRATA_EXPORT(blend_pixels);

void blend_layer(const LayerBlend& job) noexcept {
    if (simd_is_scalar()) return scalar::blend_layer(job);
    kernel_of(HWY_DISPATCH_TABLE(blend_pixels))(job);
}

}  // namespace strata::pipeline
#endif
