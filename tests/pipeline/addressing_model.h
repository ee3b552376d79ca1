// tests/pipeline/addressing_model.h - expected texels of a texture coordinate in rational arithmetic, from GL 2.1
// 3.8.8.
#pragma once
#include <boost/multiprecision/cpp_int.hpp>

#include "pipeline/formats/texture.h"
#include "tests/pipeline/stage_values.h"

namespace strata::pipeline::model {

using Rational = boost::multiprecision::cpp_rational;
using Integer = boost::multiprecision::cpp_int;

struct Texels {
    int first, second, weight;  // weight of the second texel in units of 1/256
};

[[nodiscard]] inline Integer floor(const Rational& x) {
    const Integer n = numerator(x), d = denominator(x);
    Integer quotient = n / d;  // rounded toward zero
    if (quotient * d > n) --quotient;
    return quotient;
}

[[nodiscard]] inline int wrap_texel(TextureWrap wrap, int size, Integer i) {
    if (wrap == TextureWrap::clamp_to_edge)
        return static_cast<int>(i < 0 ? 0 : i >= size ? size - 1 : static_cast<int>(i));
    const int period = wrap == TextureWrap::repeat ? size : 2 * size;
    const auto place = static_cast<int>(((i % period) + period) % period);
    return place < size ? place : period - 1 - place;
}

// `snaps`: nearest lookups round u to a multiple of 1/256 first, ties to even.
[[nodiscard]] inline Texels texels(TextureTarget target, TextureWrap wrap, int size, TextureFilter filter, bool snaps,
                                   float coordinate) {
    const float limit = 2147483648.0f;
    const float number = is_nan(coordinate)    ? 0.0f
                         : coordinate > limit  ? limit
                         : coordinate < -limit ? -limit
                                               : coordinate;
    if (target == TextureTarget::rectangle) wrap = TextureWrap::clamp_to_edge;
    const Rational u = Rational{number} * (target == TextureTarget::rectangle ? 1 : size);
    if (filter == TextureFilter::nearest) {
        Rational place = u;
        if (snaps) {
            Integer k = floor(u * 256 + Rational{1, 2});
            if (u * 256 + Rational{1, 2} == Rational{k} && k % 2 != 0) --k;  // a tie was rounded up to an odd number
            place = Rational{k, 256};
        }
        return {wrap_texel(wrap, size, floor(place)), wrap_texel(wrap, size, floor(place)), 0};
    }
    Rational centred = u;
    if (wrap == TextureWrap::clamp_to_edge) {  // clamped to [1/2, size - 1/2]
        const Rational low{1, 2}, high{2 * size - 1, 2};
        centred = u < low ? low : u > high ? high : u;
    }
    const Integer position = floor((centred - Rational{1, 2}) * 256);
    const Integer first = floor(Rational{position, 256});
    return {wrap_texel(wrap, size, first), wrap_texel(wrap, size, first + 1),
            static_cast<int>(Integer{position - first * 256})};
}

// A random coordinate: inside, outside, on texel borders and centres, next to them, or a special value.
[[nodiscard]] inline float any_coordinate(Random& random, int size) {
    const auto border = [&] { return static_cast<float>(static_cast<int>(below(random, 100)) - 50); };
    switch (below(random, 6)) {
        case 0: return any_float(random);
        case 1: return border() / static_cast<float>(2 * size);
        case 2: return float_of(bits_of(border() / static_cast<float>(2 * size)) + below(random, 5) - 2);
        case 3: return border() + static_cast<float>(below(random, 512)) / 512.0f;
        case 4: return static_cast<float>(below(random, 1u << 24)) * 0x1p-20f - 8.0f;
        default: return static_cast<float>(below(random, 1u << 24)) * 0x1p-24f;
    }
}

}  // namespace strata::pipeline::model
