// tests/specification/blend_cases.cpp - random blend states on special values: infinities, NaN, denormals, signed
// zeros, ties of rounding.
#include <array>
#include <bit>
#include <ostream>
#include <string_view>

#include "pipeline/stages/blend.h"
#include "tests/specification/cases.h"
#include "tests/specification/line.h"
#include "tests/support/random_numbers.h"

namespace strata::specification {
namespace {

using namespace pipeline;
using testing::random_int;

constexpr std::array<std::string_view, 5> equations{"add", "subtract", "reverse_subtract", "min", "max"};
constexpr std::array<std::string_view, 15> factors{"zero",
                                                   "one",
                                                   "src_color",
                                                   "one_minus_src_color",
                                                   "dst_color",
                                                   "one_minus_dst_color",
                                                   "src_alpha",
                                                   "one_minus_src_alpha",
                                                   "dst_alpha",
                                                   "one_minus_dst_alpha",
                                                   "constant_color",
                                                   "one_minus_constant_color",
                                                   "constant_alpha",
                                                   "one_minus_constant_alpha",
                                                   "src_alpha_saturate"};

float random_value(testing::Random& random) {
    constexpr std::array<std::uint32_t, 12> hard{0,          0x80000000, 0x3f800000, 0xbf800000,
                                                 0x7f800000, 0xff800000, 0x7fc12345, 0x00000001,
                                                 0x807fffff, 0x477fe000, 0x477ff000, 0x33800000};
    switch (random_int(random, 0, 5)) {
        case 0: return std::bit_cast<float>(hard[random() % hard.size()]);
        case 1: return std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        case 2: return static_cast<float>(random_int(random, 0, 255)) / 255.0f;
        default: return testing::random_float(random, -2.0f, 2.0f);
    }
}

std::uint32_t random_half(testing::Random& random) {
    const auto any = static_cast<std::uint32_t>(random() & 0xffff);
    const auto exponent = static_cast<std::uint32_t>(random_int(random, 8, 16));
    return random_int(random, 0, 2) == 0 ? any : (any & 0x83ffu) | (exponent << 10);
}

}  // namespace

void write_blend(std::ostream& out, std::uint64_t cases, std::uint64_t seed) {
    testing::Random random{seed};
    const DeviceProfile& profile = *find_profile("geforce8");
    static rasterizer::Lanes<float> empty{};
    std::array<rasterizer::Lanes<float>, 4> source{empty, empty, empty, empty};
    std::array<rasterizer::Lanes<std::uint32_t>, 4> codes{};
    for (; cases > 0; --cases) {
        Blend state;
        state.enabled = true;
        Line line{out};
        for (BlendTerm* term : {&state.color, &state.alpha}) {
            term->equation = static_cast<BlendEquation>(random() % equations.size());
            term->src = static_cast<BlendFactor>(random() % factors.size());
            term->dst = static_cast<BlendFactor>(random() % factors.size());
            line.word(equations[static_cast<std::size_t>(term->equation)]);
            line.word(factors[static_cast<std::size_t>(term->src)]);
            line.word(factors[static_cast<std::size_t>(term->dst)]);
        }
        for (float& c : components(state.constant)) line.bits(c = random_value(random));
        for (auto& channel : source) line.bits(channel[0] = random_value(random));
        for (auto& channel : codes) line.half(channel[0] = random_half(random));
        blend(state, ChannelType::half, profile, 4, source, codes, 1);
        line.answer();
        for (const auto& channel : codes) line.half(channel[0]);
    }
}

}  // namespace strata::specification
