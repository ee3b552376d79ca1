// pipeline/stages/layer_blend.h - a saved layer blended into a target, all pixels of a region in one walk: what a quad over them does whose
// program hands on the layer's colour.
//
// Rule     At every pixel the colour that `layer` stores is blended UNDER or OVER the one that `to` stores, by stored_color.h.
// Numbers  Where `depth` holds the code of `surface` the layer has no fragment, and stores (0, 0, 0, 0). Codes of 8 bits stay what they are
//          there, and vectors of such pixels are left out. Of floats both blends make 0 of -0, and change NaN, infinities and
//          denormals that are flushed: they are blended everywhere.
// Source   execution.md 6.
// Tests    tests/pipeline/stages/layer_blend_test.cpp, tests/pipeline/region/left_out_test.cpp
#pragma once
#include <array>

#include "pipeline/stages/lane_words.h"
#include "pipeline/stages/stored_color.h"

namespace strata::pipeline {

enum class LayerOrder : std::uint8_t { under, over };

struct LayerBlend {
    Texels layer, to;  // a sample each, of one format with four channels
    const Word *depth = nullptr, *surface = nullptr;
    std::size_t pixels = 0;
    LayerOrder order = LayerOrder::under;
    bool keeps_alpha = false;  // that of `to`: the write mask names the colours alone
    ColorRules rules;
};

void blend_layer(const LayerBlend& job) noexcept;

inline namespace strict {
namespace scalar {

[[nodiscard]] inline std::array<Word, 4> codes_at(const Texels& texels, std::size_t pixel) noexcept {
    std::array<Word, 4> codes;
    for (int c = 0; c < 4; ++c) {
        const Field f = texels.field(c);
        codes[static_cast<std::size_t>(c)] = texels.plane(f.word).words[pixel] >> f.shift & f.bits;
    }
    return codes;
}

inline void put_code(Word code, int channel, std::size_t pixel, const Texels& texels) noexcept {
    const Field f = texels.field(channel);
    Word& word = texels.plane(f.word).words[pixel];
    word = (word & ~(f.bits << f.shift)) | code << f.shift;
}

inline void blend_layer(const LayerBlend& job) noexcept {
    with_rules(job.rules, [&]<class Rules>(Rules) {
        const StoredColor<Rules> color{job.rules};
        for (std::size_t pixel = 0; pixel < job.pixels; ++pixel) {
            const std::array<Word, 4> source = codes_at(job.layer, pixel), stored = codes_at(job.to, pixel);
            const float alpha = color.operand(source[3]), rest = color.rest(alpha), let = color.operand(stored[3]);
            for (int channel = 0; channel < (job.keeps_alpha ? 3 : 4); ++channel) {
                const auto c = static_cast<std::size_t>(channel);
                const float s = color.operand(source[c]), d = color.operand(stored[c]);
                const Word blended = job.order == LayerOrder::over ? color.add(s, alpha, d, rest)
                                     : channel == 3                ? color.add(s, 0.0f, d, rest)
                                                                   : color.add(s, let, d, color.one);
                put_code(blended, channel, pixel, job.to);
            }
        }
    });
}

}  // namespace scalar
}  // namespace strict
}  // namespace strata::pipeline
