// Model: the colour target of color_machine.h, pixel by pixel; where a layer has no fragment, its source is (0, 0, 0, 0).
#include "pipeline/stages/layer_blend.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/simd.h"
#include "tests/support/color_machine.h"

// A namespace of its own: names of the model are short.
namespace strata::pipeline::layer_blend_model {
namespace {

using strata::testing::Random;
using strata::testing::random_int;
using namespace strata::testing::color_model;

// The words of a target of four channels, with the spare ones of every plane.
struct Words {
    Texels texels;
    std::vector<Word> words;

    Words(ChannelType type, std::size_t pixels)
        : texels{{nullptr, pixels},
                 4,
                 type == ChannelType::unorm8 ? 8
                 : type == ChannelType::half ? 16
                                             : 32},
          words(texels.words() * (pixels + spare_words), 0xabcdef01u) {}
    [[nodiscard]] Texels at() {
        Texels result = texels;
        result.first.words = words.data();
        return result;
    }
    // Another way to a code than Texels::field: a word holds 4, 2 or 1 channels, the first in its lowest bits.
    void put(std::size_t pixel, std::size_t channel, Word code) {
        const auto bits = static_cast<std::size_t>(texels.bits_per_channel), in_a_word = 32 / bits;
        Word& word = words[channel / in_a_word * (texels.first.pixels + spare_words) + pixel];
        const std::size_t shift = channel % in_a_word * bits;
        const Word field = bits == 32 ? ~0u : (1u << bits) - 1;
        word = (word & ~(field << shift)) | code << shift;
    }
    [[nodiscard]] bool equals(const Words& other) const {
        bool equal = true;
        for (std::size_t k = 0; k < words.size(); ++k)
            equal &= k % (texels.first.pixels + spare_words) >= texels.first.pixels || words[k] == other.words[k];
        return equal;
    }
};

using Codes = std::array<Word, 4>;

Codes blended(const ColorMachine& machine, LayerOrder order, bool keeps_alpha, const Codes& s, const Codes& d) {
    Codes result;
    for (std::size_t c = 0; c < 3; ++c)
        result[c] = order == LayerOrder::over ? machine.over(s[c], s[3], d[c]) : machine.under(s[c], d[c], d[3]);
    result[3] = keeps_alpha                 ? d[3]
                : order == LayerOrder::over ? machine.over(s[3], s[3], d[3])
                                            : machine.through(s[3], d[3]);
    return result;
}

// A layer with a fragment in some of its pixels: in all, in one of so many, or in none.
struct LayerScene {
    Words layer, to, expected;
    std::vector<Word> depth, surface;
    LayerBlend job;

    LayerScene(Random& random, const ColorRules& rules, std::size_t pixels, LayerOrder order, bool keeps_alpha)
        : layer{rules.type, pixels}, to{rules.type, pixels}, expected{rules.type, pixels} {
        const ColorMachine machine{rules};
        const int seldom = 1 << random_int(random, 0, 6);
        for (std::size_t p = 0; p < pixels + spare_words; ++p) {
            surface.push_back(random());
            depth.push_back(surface.back() ^
                            (random_int(random, 1, seldom) == 1 ? 1u << random_int(random, 0, 31) : 0u));
            if (p >= pixels) continue;
            Codes s{}, d;
            for (std::size_t c = 0; c < 4; ++c) {
                if (depth[p] != surface[p]) s[c] = any_stored_code(random, rules);
                d[c] = any_stored_code(random, rules);
                layer.put(p, c, s[c]);
                to.put(p, c, d[c]);
            }
            const Codes result = blended(machine, order, keeps_alpha, s, d);
            for (std::size_t c = 0; c < 4; ++c) expected.put(p, c, result[c]);
        }
        job = {{}, {}, depth.data(), surface.data(), pixels, order, keeps_alpha, rules};
    }
    [[nodiscard]] bool is_right() {
        Words result = to;
        job.layer = layer.at();
        job.to = result.at();
        blend_layer(job);
        return result.equals(expected);
    }
};

}  // namespace

TEST_CASE(
    "a layer is blended into every kind of target, UNDER and OVER, as its pixels would be, on every instruction set") {
    Random random{2071};
    for (const ColorRules& rules : all_color_rules())
        for (const LayerOrder order : {LayerOrder::under, LayerOrder::over})
            for (const bool keeps_alpha : {false, true}) {
                std::uint64_t wrong = 0;
                for (const std::size_t pixels : {1u, 7u, 16u, 31u, 257u, 1024u})
                    for (int round = 0; round < 8; ++round) {
                        LayerScene scene{random, rules, pixels, order, keeps_alpha};
                        for (const Simd simd : available_simd()) {
                            const SimdScope kernels{simd};
                            wrong += scene.is_right() ? 0 : 1;
                        }
                    }
                INFO("type " << static_cast<int>(rules.type) << ", half " << static_cast<int>(rules.rounding.half)
                             << ", unorm " << static_cast<int>(rules.rounding.unorm) << ", blend "
                             << static_cast<int>(rules.blend) << ", storage " << static_cast<int>(rules.storage)
                             << ", flushes " << rules.flushes << ", over " << (order == LayerOrder::over)
                             << ", keeps alpha " << keeps_alpha);
                CHECK(wrong == 0);
            }
}

}  // namespace strata::pipeline::layer_blend_model
