// tools/oracle/program/steps/value_entries.cpp - mistakes with values: other colours, alphas or attenuations of the
// selected layers (entries.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

constexpr double factors[] = {0.25, 0.5, 0.75, 0.9, 1.25, 1.5, 2};
constexpr double powers[] = {0.5, 1.5, 2, 3};
constexpr double limits[] = {0.1, 0.25, 0.5, 0.75};
constexpr double constants[] = {0.25, 0.5, 0.75, 1};
constexpr double bits[] = {1, 2, 3, 4, 5, 6, 7};

// Sets alpha and the attenuation together.
void set_alpha(PortLayer& layer, double alpha) { layer.alpha = layer.cover = alpha; }

template <auto f>
void alpha_by(PortLayer& layer, Parameters p) {
    set_alpha(layer, f(layer.alpha, p));
}
template <auto f>
void color_by(PortLayer& layer, Parameters p) {
    for (double& c : layer.color) c = f(c, p);
}
template <auto f>
void cover_by(PortLayer& layer, Parameters p) {
    layer.cover = f(layer.cover, p);
}

double times(double v, Parameters p) { return v * p[0]; }
double times_up_to_one(double v, Parameters p) { return std::min(v * p[0], 1.0); }
double power(double v, Parameters p) { return std::pow(std::max(v, 0.0), p[0]); }
double constant(double, Parameters p) { return p[0]; }
double at_most(double v, Parameters p) { return std::min(v, p[0]); }
double at_least(double v, Parameters p) { return std::max(v, p[0]); }
double quantised(double v, Parameters p) { return in_bits(v, p[0]); }
double floored(double v, Parameters p) {
    const double codes = std::exp2(p[0]) - 1;
    return std::floor(v * codes) / (codes + 1);
}
double cut(double v, Parameters p) {
    const double codes = std::exp2(p[0]) - 1;
    return std::floor(std::clamp(v, 0.0, 1.0) * codes + 1e-9) / codes;
}
// Of a code of 8 bits the low ones are dropped.
double masked(double v, Parameters p) {
    const double step = std::exp2(8 - p[0]);
    return std::floor(std::floor(std::clamp(v, 0.0, 1.0) * 255 + 0.5) / step) * step / 255;
}
double inverted(double v, Parameters) { return 1 - v; }
double encode(double v, Parameters) { return encoded(v); }
double decode(double v, Parameters) { return decoded(v); }
double zero(double, Parameters) { return 0; }
double one(double, Parameters) { return 1; }
double absorbed(double v, Parameters) { return 1 - std::exp(-v); }

void premultiply(PortLayer& layer, Parameters) {
    for (double& c : layer.color) c *= layer.alpha;
}
// A layer is blended over its cleared target by its alpha when it is stored.
void store_blended(PortLayer& layer, Parameters) {
    premultiply(layer, {});
    set_alpha(layer, layer.alpha * layer.alpha);
}
template <std::size_t c>
void read_alpha(PortLayer& layer, Parameters) {
    set_alpha(layer, std::clamp(layer.color[c], 0.0, 1.0));
}
void unmultiply(PortLayer& layer, Parameters) { layer.alpha = 1; }
void weigh_by_rest(PortLayer& layer, Parameters) { layer.alpha *= 1 - layer.alpha; }
void exchange_factors(PortLayer& layer, Parameters) {
    layer.alpha = 1 - layer.alpha;
    layer.cover = layer.alpha;
}
void attenuate_inversely(PortLayer& layer, Parameters) { layer.cover = 1 - layer.cover; }
template <std::size_t a, std::size_t b>
void exchange_channels(PortLayer& layer, Parameters) {
    std::swap(layer.color[a], layer.color[b]);
}
// Packed in 16 bits.
void pack_565(PortLayer& layer, Parameters) {
    layer.color = {in_bits(layer.color[0], 5), in_bits(layer.color[1], 6), in_bits(layer.color[2], 5)};
}
void make_grey(PortLayer& layer, Parameters) {
    const double grey = 0.2126 * layer.color[0] + 0.7152 * layer.color[1] + 0.0722 * layer.color[2];
    layer.color = {grey, grey, grey};
}

// Each pass multiplies the colour again.
void darken_by_rank(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    for (PortLayer& layer : layers)
        if (s.has(layer))
            for (double& c : layer.color) c *= std::pow(p[0], static_cast<double>(layer.fragment));
}
template <bool is_alpha>
void fade_by_depth(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    for (PortLayer& layer : layers) {
        if (!s.has(layer)) continue;
        const double f = 1 + p[0] * s.of(layer).depth;
        if (is_alpha)
            set_alpha(layer, layer.alpha * f);
        else
            for (double& c : layer.color) c *= f;
    }
}
// A curve through five values at 0, 0.25, 0.5, 0.75 and 1.
double on_curve(double v, Parameters p) {
    const double at = std::clamp(v, 0.0, 1.0) * 4, i = std::min(std::floor(at), 3.0);
    const auto k = static_cast<std::size_t>(i);
    return p[k] + (at - i) * (p[k + 1] - p[k]);
}
std::vector<double> straight(double, double) { return {0, 0.25, 0.5, 0.75, 1}; }
void mix(PortLayer& layer, Parameters p) {
    const Color c = layer.color;
    for (std::size_t i = 0; i < 3; ++i)
        layer.color[i] = p[4 * i] * c[0] + p[4 * i + 1] * c[1] + p[4 * i + 2] * c[2] + p[4 * i + 3];
}
std::vector<double> identity(double, double) { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; }
// A fog's colour, and its shares at the depths p[3] and p[4], which grow between them.
void fog(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    for (PortLayer& layer : layers) {
        if (!s.has(layer)) continue;
        const double at = (s.of(layer).depth - p[3]) / std::max(p[4] - p[3], 1e-9);
        const double share = std::clamp(p[5] + at * (p[6] - p[5]), 0.0, 1.0);
        for (std::size_t c = 0; c < 3; ++c) layer.color[c] += share * (p[c] - layer.color[c]);
    }
}
std::vector<double> light_fog(double nearest, double farthest) { return {0.5, 0.5, 0.5, nearest, farthest, 0.1, 0.4}; }
bool is_fog(Parameters p) {
    const auto is_share = [](double v) { return v > -0.02 && v < 1.02; };
    return std::all_of(p.begin(), p.begin() + 3, is_share) && is_share(p[5]) && is_share(p[6]) && p[5] < p[6];
}
constexpr double slopes[] = {-0.5, 0.5};

const StepEntry table[] = {
    {.words = "have alpha times {}",
     .parameters = factors,
     .is_continuous = true,
     .edit = each<alpha_by<times_up_to_one>>},
    {.words = "have alpha to the power of {}",
     .price = 5,
     .parameters = powers,
     .is_continuous = true,
     .edit = each<alpha_by<power>>},
    {.words = "have an alpha of {}", .parameters = constants, .is_continuous = true, .edit = each<alpha_by<constant>>},
    {.words = "have an alpha of at most {}",
     .price = 5,
     .parameters = limits,
     .is_continuous = true,
     .edit = each<alpha_by<at_most>>},
    {.words = "have an alpha of at least {}",
     .price = 5,
     .parameters = limits,
     .is_continuous = true,
     .edit = each<alpha_by<at_least>>},
    {.words = "have alpha rounded to {} bits", .price = 6, .parameters = bits, .edit = each<alpha_by<quantised>>},
    {.words = "have alpha truncated to {} bits and divided by their power of 2",
     .price = 7,
     .parameters = bits,
     .edit = each<alpha_by<floored>>},
    {.words = "have alpha truncated to {} bits", .price = 6, .parameters = bits, .edit = each<alpha_by<cut>>},
    {.words = "have alpha without the low ones of 8 bits: {} are kept",
     .price = 6,
     .parameters = bits,
     .edit = each<alpha_by<masked>>},
    {.words = "have colours truncated to {} bits", .parameters = bits, .edit = each<color_by<cut>>},
    {.words = "have colours without the low ones of 8 bits: {} are kept",
     .parameters = bits,
     .edit = each<color_by<masked>>},
    {.words = "are in a fog of colour ({}, {}, {}) that grows from depth {} to {}, from a share of {} to {}",
     .price = 10,
     .start = light_fog,
     .is_plausible = is_fog,
     .edit = fog},
    {.words = "have 1 - alpha as alpha", .price = 3, .edit = each<alpha_by<inverted>>},
    {.words = "have alpha read from red", .price = 5, .edit = each<read_alpha<0>>},
    {.words = "have alpha read from green", .price = 5, .edit = each<read_alpha<1>>},
    {.words = "have alpha read from blue", .price = 5, .edit = each<read_alpha<2>>},
    {.words = "have alpha encoded as sRGB", .price = 5, .edit = each<alpha_by<encode>>},
    {.words = "have alpha decoded from sRGB", .price = 5, .edit = each<alpha_by<decode>>},
    {.words = "have alpha times 1 + ({}) depth",
     .price = 6,
     .parameters = slopes,
     .is_continuous = true,
     .edit = fade_by_depth<true>},
    {.words = "are not blended: they replace what is behind", .price = 3, .edit = each<alpha_by<one>>},
    {.words = "have colours times {}", .parameters = factors, .is_continuous = true, .edit = each<color_by<times>>},
    {.words = "have colours to the power of {}",
     .price = 5,
     .parameters = powers,
     .is_continuous = true,
     .edit = each<color_by<power>>},
    {.words = "have colours rounded to {} bits", .parameters = bits, .edit = each<color_by<quantised>>},
    {.words = "have colours packed in 5, 6 and 5 bits", .price = 5, .edit = each<pack_565>},
    {.words = "have inverted colours", .edit = each<color_by<inverted>>},
    {.words = "have colours encoded as sRGB", .edit = each<color_by<encode>>},
    {.words = "have colours decoded from sRGB", .edit = each<color_by<decode>>},
    {.words = "have an alpha that acts as {}, {}, {}, {}, {} where it is 0, 0.25, 0.5, 0.75, 1",
     .price = 10,
     .start = straight,
     .edit = each<alpha_by<on_curve>>},
    {.words = "have colours that act as {}, {}, {}, {}, {} where they are 0, 0.25, 0.5, 0.75, 1",
     .price = 10,
     .start = straight,
     .edit = each<color_by<on_curve>>},
    {.words =
         "have red that acts as {} red + {} green + {} blue + {}, green as {}, {}, {} + {}, blue as {}, {}, {} + {}",
     .price = 10,
     .start = identity,
     .edit = each<mix>},
    {.words = "are black", .price = 3, .edit = each<color_by<zero>>},
    {.words = "are white", .price = 3, .edit = each<color_by<one>>},
    {.words = "are grey", .edit = each<make_grey>},
    {.words = "have red and blue exchanged", .edit = each<exchange_channels<0, 2>>},
    {.words = "have red and green exchanged", .edit = each<exchange_channels<0, 1>>},
    {.words = "have green and blue exchanged", .edit = each<exchange_channels<1, 2>>},
    {.words = "have colours times 1 + ({}) depth",
     .price = 6,
     .parameters = slopes,
     .is_continuous = true,
     .edit = fade_by_depth<false>},
    {.words = "have colours times {} for each layer before",
     .price = 6,
     .parameters = factors,
     .is_continuous = true,
     .edit = darken_by_rank},
    {.words = "have colours multiplied by alpha twice", .edit = each<premultiply>},
    {.words =
         "are blended over a cleared target when they are stored: colours are multiplied by alpha, alpha by itself",
     .price = 5,
     .edit = each<store_blended>},
    {.words = "have colours that are not multiplied by alpha", .edit = each<unmultiply>},
    {.words = "have colours multiplied by alpha and by 1 - alpha", .price = 5, .edit = each<weigh_by_rest>},
    {.words = "do not attenuate what is behind", .edit = each<cover_by<zero>>},
    {.words = "hide all that is behind", .price = 5, .edit = each<cover_by<one>>},
    {.words = "attenuate by {} times alpha",
     .price = 5,
     .parameters = factors,
     .is_continuous = true,
     .edit = each<cover_by<times>>},
    {.words = "attenuate by exp(-alpha)", .price = 5, .edit = each<cover_by<absorbed>>},
    {.words = "attenuate by alpha instead of 1 - alpha", .price = 5, .edit = each<attenuate_inversely>},
    {.words = "have the blend factors exchanged", .price = 5, .edit = each<exchange_factors>},
};

}  // namespace

std::span<const StepEntry> value_entries() { return table; }

}  // namespace strata::oracle::program
