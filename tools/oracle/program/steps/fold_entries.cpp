// tools/oracle/program/steps/fold_entries.cpp - other folds: how layers are put together, and how the background is
// weighted (entries.h).
#include <algorithm>
#include <cmath>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

using Stack = std::span<const PortLayer>;

// Front to back: `step` changes sum and transmittance for a layer, `end` composites what is behind.
struct Front {
    Color sum{};
    double through = 1;
};
void usual(Front& f, const PortLayer& layer, std::size_t, Parameters) {
    for (std::size_t c = 0; c < 3; ++c) f.sum[c] += f.through * layer.alpha * layer.color[c];
    f.through *= 1 - layer.cover;
}
double weight(double through, Parameters) { return through; }
template <auto step, auto behind_weight = weight>
Color from_front(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    Front f;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        step(f, layers[k], k, p);
        for (double& c : f.sum) c = r.kept(c);
        f.through = r.weighed(f.through);
    }
    for (std::size_t c = 0; c < 3; ++c) f.sum[c] = r.kept(f.sum[c] + behind_weight(f.through, p) * r.kept(behind[c]));
    return f.sum;
}

void subtract(Front& f, const PortLayer& layer, std::size_t, Parameters) {
    for (std::size_t c = 0; c < 3; ++c) f.sum[c] += std::min(f.through, layer.alpha) * layer.color[c];
    f.through = std::max(f.through - layer.alpha, 0.0);
}
void clamp_sum(Front& f, const PortLayer& layer, std::size_t k, Parameters p) {
    usual(f, layer, k, p);
    for (double& c : f.sum) c = std::min(c, p[0]);
}
void keep_bits(Front& f, const PortLayer& layer, std::size_t k, Parameters p) {
    usual(f, layer, k, p);
    f.through = in_bits(f.through, p[0]);
}
void keep_some(Front& f, const PortLayer& layer, std::size_t k, Parameters p) {
    usual(f, layer, k, p);
    f.through = std::max(f.through, p[0]);
}
void stop(Front& f, const PortLayer& layer, std::size_t k, Parameters p) {
    usual(f, layer, k, p);
    if (f.through < p[0]) f.through = 0;
}
void wrap(Front& f, const PortLayer& layer, std::size_t, Parameters) {
    for (std::size_t c = 0; c < 3; ++c) {
        f.sum[c] += layer.alpha * layer.color[c];
        f.sum[c] -= std::floor(f.sum[c]);
    }
    f.through *= 1 - layer.cover;
}
// The layer is attenuated rightly; what is behind it by another transmittance.
template <auto next>
void reach(Front& f, const PortLayer& layer, std::size_t k, Parameters p) {
    const double through = next(f.through, layer.cover);
    usual(f, layer, k, p);
    f.through = through;
}
double less_alpha(double t, double a) { return std::max(t - a, 0.0); }
double least(double t, double a) { return std::min(t, 1 - a); }
double of_last(double, double a) { return 1 - a; }
double of_first(double t, double a) { return t < 1 ? t : 1 - a; }
double like_color(double t, double a) { return 1 - (a * a + (1 - a) * (1 - t)); }
double of_square(double t, double a) { return t * (1 - a * a); }
double squared(double through, Parameters) { return through * through; }
double inverted(double through, Parameters) { return 1 - through; }
double unweighted(double, Parameters) { return 1; }
double above(double through, Parameters p) { return through < p[0] ? 0 : through; }

// The transmittance of one layer earlier.
Color one_late(Stack layers, const Color& behind, const PortRounding& r, Parameters) {
    Color sum{};
    double through = 1, old = 1;
    for (const PortLayer& layer : layers) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] = r.kept(sum[c] + old * layer.alpha * layer.color[c]);
        old = through;
        through = r.weighed(through * (1 - layer.cover));
    }
    for (std::size_t c = 0; c < 3; ++c) sum[c] += through * behind[c];
    return sum;
}

// Back to front, each channel by itself.
template <auto blend>
Color from_back(Stack layers, const Color& behind, const PortRounding& r, Parameters) {
    Color below = behind;
    for (double& c : below) c = r.kept(c);
    for (std::size_t k = layers.size(); k-- > 0;)
        for (std::size_t c = 0; c < 3; ++c) below[c] = r.kept(blend(below[c], layers[k].color[c], layers[k].alpha));
    return below;
}
double max(double d, double s, double a) { return std::max(d, s * a); }
double max_straight(double d, double s, double) { return std::max(d, s); }
double min(double d, double s, double a) { return std::min(d, s * a); }
double min_straight(double d, double s, double) { return std::min(d, s); }
double multiply(double d, double s, double a) { return d * (1 - a + a * s); }
double screen(double d, double s, double a) { return 1 - (1 - d) * (1 - a * s); }
double difference(double d, double s, double a) { return std::fabs(s * a - d * (1 - a)); }
double by_color(double d, double s, double a) { return s * a + d * (1 - s); }
double by_color_straight(double d, double s, double) { return s + d * (1 - s); }
double times_color(double d, double s, double a) { return s * a + d * s; }
double multiply_straight(double d, double s, double) { return d * s; }
double in_light(double d, double s, double a) { return encoded(decoded(d) * (1 - a) + decoded(s) * a); }

// Back to front in codes of 8 bits that are not clamped.
Color wrapped(Stack layers, const Color& behind, const PortRounding& r, Parameters) {
    const auto code = [](double v) { return std::floor(v * 255 + 0.5); };
    const auto cut = [](double v) { return std::floor(v * 255 + 1e-9); };
    Color below = behind;
    for (std::size_t k = layers.size(); k-- > 0;)
        for (std::size_t c = 0; c < 3; ++c) {
            const double own = layers[k].color[c] * layers[k].alpha, rest = below[c] * (1 - layers[k].cover);
            const double sum = r.splits                    ? code(own) + code(rest)
                               : !r.truncates              ? code(own + rest)
                               : r.form == BlendForm::once ? cut(own + rest)
                                                           : code(own) + cut(rest);
            below[c] = (sum - 256 * std::floor(sum / 256)) / 255;
        }
    return below;
}

// The transmittance of all layers.
double transmittance(Stack layers) {
    double left = 1;
    for (const PortLayer& layer : layers) left *= 1 - layer.cover;
    return left;
}

Color divided(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    if (layers.empty()) return behind;
    Color sum = from_front<usual>(layers, {}, r, p);
    const double reached = 1 - transmittance(layers);
    for (double& c : sum) c = std::min(c / std::max(reached, 1e-9), 1.0);
    return sum;
}
Color multiplied_again(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    Color sum = from_front<usual>(layers, {}, r, p);
    const double left = transmittance(layers);
    for (std::size_t c = 0; c < 3; ++c) sum[c] = sum[c] * (1 - left) + left * behind[c];
    return sum;
}
Color alpha_as_color(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    Color sum = from_front<usual>(layers, {}, r, p);
    double reached = 0;
    for (std::size_t k = layers.size(); k-- > 0;)
        reached = layers[k].alpha * layers[k].alpha + reached * (1 - layers[k].alpha);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += (1 - reached) * behind[c];
    return sum;
}
Color in_linear_light(Stack layers, const Color& behind, const PortRounding& r, Parameters) {
    PortLayers linear{layers.begin(), layers.end()};
    for (PortLayer& layer : linear)
        for (double& c : layer.color) c = decoded(c);
    Color color = blended(linear, {decoded(behind[0]), decoded(behind[1]), decoded(behind[2])}, r);
    for (double& c : color) c = encoded(c);
    return color;
}

// The near half in front, the far half over what is behind, joined with another weight.
template <auto join>
Color of_halves(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    const std::size_t half = (layers.size() + 1) / 2;
    const Color back = blended(layers.subspan(half), behind, r);
    return from_front<usual, join>(layers.first(half), back, r, p);
}

// Blends of 8-bit codes whose products are shifted instead of divided.
enum class Shifted : std::uint8_t { sum, each, by_256 };
template <Shifted how>
Color shifted(Stack layers, const Color& behind, const PortRounding&, Parameters) {
    const auto code = [](double v) { return std::floor(std::clamp(v, 0.0, 1.0) * 255 + 0.5); };
    Color below{code(behind[0]), code(behind[1]), code(behind[2])};
    for (std::size_t k = layers.size(); k-- > 0;) {
        const double a = code(layers[k].alpha), whole = how == Shifted::by_256 ? 256 : 255;
        for (std::size_t c = 0; c < 3; ++c) {
            const double own = code(layers[k].color[c]) * a, rest = below[c] * (whole - a);
            below[c] =
                how == Shifted::each ? std::floor(own / 256) + std::floor(rest / 256) : std::floor((own + rest) / 256);
        }
    }
    return {below[0] / 255, below[1] / 255, below[2] / 255};
}
// Back to front, kept in fewer bits after every blend.
template <bool cuts>
Color in_few_bits(Stack layers, const Color& behind, const PortRounding&, Parameters p) {
    const double codes = std::exp2(p[0]) - 1;
    const auto kept = [&](double v) {
        return std::floor(std::clamp(v, 0.0, 1.0) * codes + (cuts ? 1e-9 : 0.5)) / codes;
    };
    Color below{kept(behind[0]), kept(behind[1]), kept(behind[2])};
    for (std::size_t k = layers.size(); k-- > 0;)
        for (std::size_t c = 0; c < 3; ++c)
            below[c] = kept(layers[k].color[c] * layers[k].alpha + below[c] * (1 - layers[k].cover));
    return below;
}
constexpr double few_bits[] = {1, 2, 3, 4, 5, 6, 7}, shares[] = {0.05, 0.1, 0.2, 0.5, 0.75};

constexpr StepEntry threshold_entry(std::string_view words, FoldFunction fold) {
    StepEntry entry = fold_entry(words, 5, fold, shares, true);
    entry.is_threshold = true;
    return entry;
}

const StepEntry table[] = {
    fold_entry("layers are combined by MAX of premultiplied colours", 4, from_back<max>),
    fold_entry("layers are combined by MAX", 4, from_back<max_straight>),
    fold_entry("layers are combined by MIN of premultiplied colours", 4, from_back<min>),
    fold_entry("layers are combined by MIN", 4, from_back<min_straight>),
    fold_entry("layers multiply what is behind", 4, from_back<multiply>),
    fold_entry("layers are screened", 4, from_back<screen>),
    fold_entry("layers multiply what is behind, whatever their alpha", 4, from_back<multiply_straight>),
    fold_entry("what is behind is multiplied by 1 - colour (ONE_MINUS_SRC_COLOR)", 4, from_back<by_color>),
    fold_entry("what is behind is multiplied by 1 - colour (ONE_MINUS_SRC_COLOR), colours not by alpha", 5,
               from_back<by_color_straight>),
    fold_entry("what is behind is multiplied by the colour (SRC_COLOR)", 4, from_back<times_color>),
    fold_entry("the blend subtracts", 5, from_back<difference>),
    fold_entry("every blend decodes and encodes sRGB", 5, from_back<in_light>),
    fold_entry("colours and background are decoded, blended in linear light and encoded", 5, in_linear_light),
    fold_entry("blends of 8 bits shift by 8 instead of dividing by 255", 5, shifted<Shifted::sum>),
    fold_entry("blends of 8 bits shift each product by 8 instead of dividing by 255", 5, shifted<Shifted::each>),
    fold_entry("blends of 8 bits weigh what is behind by 256 - alpha and shift by 8", 5, shifted<Shifted::by_256>),
    fold_entry("every blend is rounded to {} bits", 5, in_few_bits<false>, few_bits),
    fold_entry("every blend is truncated to {} bits", 5, in_few_bits<true>, few_bits),
    fold_entry("the transmittance is reduced by subtraction of alpha", 5, from_front<subtract>),
    fold_entry("the alphas of the layers before are added up, where their transmittances are multiplied", 4,
               from_front<reach<less_alpha>>),
    fold_entry("the alpha reached is the largest one", 5, from_front<reach<least>>),
    fold_entry("the alpha reached is that of the last layer", 5, from_front<reach<of_last>>),
    fold_entry("the alpha reached is that of the first layer", 5, from_front<reach<of_first>>),
    fold_entry("the alpha reached is blended by alpha", 5, from_front<reach<like_color>>),
    fold_entry("layers attenuate by the square of alpha", 5, from_front<reach<of_square>>),
    fold_entry("blends of 8 bits wrap around at 256 where they are to be clamped", 5, wrapped),
    fold_entry("the transmittance is that of one layer earlier", 5, one_late),
    fold_entry("the transmittance is kept in {} bits", 5, from_front<keep_bits>, few_bits),
    fold_entry("the transmittance never falls below {}", 5, from_front<keep_some>, shares, true),
    threshold_entry("once the transmittance is below {}, all that is behind is missing", from_front<stop>),
    fold_entry("the accumulated colour is clamped to {}", 5, from_front<clamp_sum>, shares, true),
    fold_entry("the sum of the layers wraps around at 1", 6, from_front<wrap>),
    fold_entry("the background is weighted by the square of the transmittance", 5, from_front<usual, squared>),
    fold_entry("the background is weighted by 1 - transmittance", 5, from_front<usual, inverted>),
    fold_entry("the background is added without its weight", 5, from_front<usual, unweighted>),
    threshold_entry("the background is missing where the transmittance is below {}", from_front<usual, above>),
    fold_entry("the colour is divided by the alpha reached, without background", 5, divided),
    fold_entry("the accumulated colour is multiplied by the alpha reached", 5, multiplied_again),
    fold_entry("alpha is blended like a colour, and weights the background", 5, alpha_as_color),
    fold_entry("the back half is added without the front's transmittance", 5, of_halves<unweighted>),
    fold_entry("the back half is weighted by the square of the front's transmittance", 5, of_halves<squared>),
    fold_entry("the back half is weighted by 1 - the front's transmittance", 5, of_halves<inverted>),
};

}  // namespace

std::span<const StepEntry> fold_entries() { return table; }

}  // namespace strata::oracle::program
