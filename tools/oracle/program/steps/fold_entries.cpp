// tools/oracle/program/steps/fold_entries.cpp - other folds: how layers are put together, and how the background is
// weighted (entries.h).
//
// Source   Bavoil, Myers 2008 (weighted average); McGuire, Bavoil 2013, equations 7 to 10 (weights by depth).
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
void wrap(Front& f, const PortLayer& layer, std::size_t, Parameters) {
    for (std::size_t c = 0; c < 3; ++c) {
        f.sum[c] += layer.alpha * layer.color[c];
        f.sum[c] -= std::floor(f.sum[c]);
    }
    f.through *= 1 - layer.cover;
}
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
double in_light(double d, double s, double a) { return encoded(decoded(d) * (1 - a) + decoded(s) * a); }

// Sums over all layers, independent of their order.
struct LayerSums {
    Color color{};  // of weight * alpha * colour
    double weight = 0, alpha = 0, through = 1;
};
template <auto weight_of>
LayerSums sums_of(Stack layers, Parameters p) {
    LayerSums s;
    for (const PortLayer& layer : layers) {
        const double w = weight_of(layer, p) * layer.alpha;
        for (std::size_t c = 0; c < 3; ++c) s.color[c] += w * layer.color[c];
        s.weight += w;
        s.alpha += layer.alpha;
        s.through *= 1 - layer.cover;
    }
    return s;
}
Color over(const LayerSums& s, double through, const Color& behind) {
    Color color = behind;
    if (s.weight > 0)
        for (std::size_t c = 0; c < 3; ++c) color[c] = s.color[c] / s.weight * (1 - through) + through * behind[c];
    return color;
}
double one(const PortLayer&, Parameters) { return 1; }
double alpha(const PortLayer& layer, Parameters) { return layer.alpha; }
// McGuire and Bavoil's equations, with the window depth as distance.
double by_depth_10(const PortLayer& layer, Parameters) {
    return layer.alpha * std::max(1e-2, 3e3 * std::pow(1 - layer.depth, 3));
}
double by_distance(const PortLayer& layer, Parameters p) {
    return std::clamp(0.03 / (1e-5 + std::pow(layer.depth / p[0], 4)), 1e-2, 3e3);
}
double by_distance_and_alpha(const PortLayer& layer, Parameters p) { return layer.alpha * by_distance(layer, p); }
double by_power(const PortLayer& layer, Parameters p) { return std::pow(std::max(1 - layer.depth, 0.0), p[0]); }
template <bool by_alpha>
double by_gauss(const PortLayer& layer, Parameters p) {
    const double z = layer.depth / p[0];
    return std::exp(-std::min(z * z, 700.0)) * (by_alpha ? layer.alpha : 1);
}
template <bool by_alpha>
double by_decay(const PortLayer& layer, Parameters p) {
    return std::exp(-std::min(layer.depth / p[0], 700.0)) * (by_alpha ? layer.alpha : 1);
}
template <auto weight_of>
Color weighted(Stack layers, const Color& behind, const PortRounding&, Parameters p) {
    const LayerSums s = sums_of<weight_of>(layers, p);
    return over(s, s.through, behind);
}
Color weighted_average(Stack layers, const Color& behind, const PortRounding&, Parameters p) {
    const LayerSums s = sums_of<one>(layers, p);
    const double n = static_cast<double>(std::max<std::size_t>(layers.size(), 1));
    return over(s, std::pow(std::max(1 - s.alpha / n, 0.0), n), behind);
}
Color tail_averaged(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    const auto first = std::min(static_cast<std::size_t>(p[0]), layers.size());
    return blended(layers.first(first), weighted<one>(layers.subspan(first), behind, r, p), r);
}

Color divided(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    if (layers.empty()) return behind;
    Color sum = from_front<usual>(layers, {}, r, p);
    const double reached = 1 - sums_of<one>(layers, p).through;
    for (double& c : sum) c = std::min(c / std::max(reached, 1e-9), 1.0);
    return sum;
}
Color multiplied_again(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    Color sum = from_front<usual>(layers, {}, r, p);
    const double through = sums_of<one>(layers, p).through;
    for (std::size_t c = 0; c < 3; ++c) sum[c] = sum[c] * (1 - through) + through * behind[c];
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

// Weights by depth: their logarithms at eight depths from p[0] to p[1], and a power of alpha.
double by_curve(const PortLayer& layer, Parameters p) {
    const double at = std::clamp((layer.depth - p[0]) / std::max(p[1] - p[0], 1e-9), 0.0, 1.0) * 7;
    const double i = std::min(std::floor(at), 6.0);
    const auto k = static_cast<std::size_t>(i) + 2;
    return std::exp(p[k] + (at - i) * (p[k + 1] - p[k])) * std::pow(std::max(layer.alpha, 1e-9), p[10]);
}
std::vector<double> equal_weights(double nearest, double farthest) {
    return {nearest, farthest, 0, 0, 0, 0, 0, 0, 0, 0, 0};
}
// Weights that do not grow with depth: those of an average that prefers near layers.
bool fall_with_depth(Parameters p) { return std::is_sorted(p.rbegin() + 1, p.rend() - 2); }

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
constexpr double scales[] = {0.05, 0.1, 0.3, 1};
constexpr double distances[] = {0.1, 0.2, 0.5, 1, 10, 200}, exponents[] = {1, 2, 3, 4};
constexpr double few_bits[] = {1, 2, 3, 4, 5, 6, 7}, shares[] = {0.05, 0.1, 0.2, 0.5, 0.75}, counts[] = {1, 2, 3, 4};

const StepEntry table[] = {
    {.step = PortStep::fold, .words = "layers are combined by MAX of premultiplied colours", .fold = from_back<max>},
    {.step = PortStep::fold, .words = "layers are combined by MAX", .fold = from_back<max_straight>},
    {.step = PortStep::fold, .words = "layers are combined by MIN of premultiplied colours", .fold = from_back<min>},
    {.step = PortStep::fold, .words = "layers are combined by MIN", .fold = from_back<min_straight>},
    {.step = PortStep::fold, .words = "layers multiply what is behind", .fold = from_back<multiply>},
    {.step = PortStep::fold, .words = "layers are screened", .fold = from_back<screen>},
    {.step = PortStep::fold, .words = "the blend subtracts", .price = 5, .fold = from_back<difference>},
    {.step = PortStep::fold, .words = "every blend decodes and encodes sRGB", .price = 5, .fold = from_back<in_light>},
    {.step = PortStep::fold,
     .words = "colours and background are decoded, blended in linear light and encoded",
     .price = 5,
     .fold = in_linear_light},
    {.step = PortStep::fold,
     .words = "layers are averaged, with the mean alpha (weighted average)",
     .fold = weighted_average},
    {.step = PortStep::fold,
     .words = "layers are averaged by alpha, with the right transmittance",
     .price = 5,
     .fold = weighted<one>},
    {.step = PortStep::fold,
     .words = "layers are averaged by the square of alpha, with the right transmittance",
     .price = 6,
     .fold = weighted<alpha>},
    {.step = PortStep::fold,
     .words = "weighted sums: alpha max(0.01, 3000 (1 - depth)^3)",
     .price = 5,
     .fold = weighted<by_depth_10>},
    {.step = PortStep::fold,
     .words = "weighted sums: clamp(0.03 / (1e-5 + (depth / {})^4), 0.01, 3000)",
     .price = 5,
     .parameters = distances,
     .is_continuous = true,
     .fold = weighted<by_distance>},
    {.step = PortStep::fold,
     .words = "weighted sums: alpha clamp(0.03 / (1e-5 + (depth / {})^4), 0.01, 3000)",
     .price = 5,
     .parameters = distances,
     .is_continuous = true,
     .fold = weighted<by_distance_and_alpha>},
    {.step = PortStep::fold,
     .words = "weighted sums: (1 - depth)^{}",
     .price = 6,
     .parameters = exponents,
     .is_continuous = true,
     .fold = weighted<by_power>},
    {.step = PortStep::fold,
     .words = "layers are averaged by weights that depend on depth (weighted sums): e^-(depth / {})^2",
     .price = 5,
     .parameters = scales,
     .is_continuous = true,
     .fold = weighted<by_gauss<false>>},
    {.step = PortStep::fold,
     .words = "layers are averaged by weights that depend on depth (weighted sums): alpha e^-(depth / {})^2",
     .price = 5,
     .parameters = scales,
     .is_continuous = true,
     .fold = weighted<by_gauss<true>>},
    {.step = PortStep::fold,
     .words = "layers are averaged by weights that depend on depth (weighted sums): e^-(depth / {})",
     .price = 5,
     .parameters = scales,
     .is_continuous = true,
     .fold = weighted<by_decay<false>>},
    {.step = PortStep::fold,
     .words = "layers are averaged by weights that depend on depth (weighted sums): alpha e^-(depth / {})",
     .price = 5,
     .parameters = scales,
     .is_continuous = true,
     .fold = weighted<by_decay<true>>},
    {.step = PortStep::fold,
     .words = "blends of 8 bits shift by 8 instead of dividing by 255",
     .price = 5,
     .fold = shifted<Shifted::sum>},
    {.step = PortStep::fold,
     .words = "blends of 8 bits shift each product by 8 instead of dividing by 255",
     .price = 5,
     .fold = shifted<Shifted::each>},
    {.step = PortStep::fold,
     .words = "blends of 8 bits weigh what is behind by 256 - alpha and shift by 8",
     .price = 5,
     .fold = shifted<Shifted::by_256>},
    {.step = PortStep::fold,
     .words = "every blend is rounded to {} bits",
     .price = 5,
     .parameters = few_bits,
     .fold = in_few_bits<false>},
    {.step = PortStep::fold,
     .words = "every blend is truncated to {} bits",
     .price = 5,
     .parameters = few_bits,
     .fold = in_few_bits<true>},
    {.step = PortStep::fold,
     .words = "layers are averaged by weights that depend on depth (weighted sums): depths from {} to {} act with "
              "weights of e^{}, {}, {}, {}, {}, {}, {}, {}, times alpha^{}",
     .price = 10,
     .start = equal_weights,
     .is_plausible = fall_with_depth,
     .fold = weighted<by_curve>},
    {.step = PortStep::fold,
     .words = "behind the first {} layers the others are averaged",
     .price = 6,
     .parameters = counts,
     .fold = tail_averaged},
    {.step = PortStep::fold,
     .words = "the transmittance is reduced by subtraction of alpha",
     .price = 5,
     .fold = from_front<subtract>},
    {.step = PortStep::fold, .words = "the transmittance is that of one layer earlier", .price = 5, .fold = one_late},
    {.step = PortStep::fold,
     .words = "the transmittance is kept in {} bits",
     .price = 5,
     .parameters = few_bits,
     .fold = from_front<keep_bits>},
    {.step = PortStep::fold,
     .words = "the transmittance never falls below {}",
     .price = 5,
     .parameters = shares,
     .is_continuous = true,
     .fold = from_front<keep_some>},
    {.step = PortStep::fold,
     .words = "the accumulated colour is clamped to {}",
     .price = 5,
     .parameters = shares,
     .is_continuous = true,
     .fold = from_front<clamp_sum>},
    {.step = PortStep::fold, .words = "the sum of the layers wraps around at 1", .price = 6, .fold = from_front<wrap>},
    {.step = PortStep::fold,
     .words = "the background is weighted by the square of the transmittance",
     .price = 5,
     .fold = from_front<usual, squared>},
    {.step = PortStep::fold,
     .words = "the background is weighted by 1 - transmittance",
     .price = 5,
     .fold = from_front<usual, inverted>},
    {.step = PortStep::fold,
     .words = "the background is added without its weight",
     .price = 5,
     .fold = from_front<usual, unweighted>},
    {.step = PortStep::fold,
     .words = "the background is missing where the transmittance is below {}",
     .price = 5,
     .parameters = shares,
     .is_continuous = true,
     .fold = from_front<usual, above>},
    {.step = PortStep::fold,
     .words = "the colour is divided by the alpha reached, without background",
     .price = 5,
     .fold = divided},
    {.step = PortStep::fold,
     .words = "the accumulated colour is multiplied by the alpha reached",
     .price = 5,
     .fold = multiplied_again},
    {.step = PortStep::fold,
     .words = "alpha is blended like a colour, and weights the background",
     .price = 5,
     .fold = alpha_as_color},
    {.step = PortStep::fold,
     .words = "the back half is added without the front's transmittance",
     .price = 5,
     .fold = of_halves<unweighted>},
    {.step = PortStep::fold,
     .words = "the back half is weighted by the square of the front's transmittance",
     .price = 5,
     .fold = of_halves<squared>},
    {.step = PortStep::fold,
     .words = "the back half is weighted by 1 - the front's transmittance",
     .price = 5,
     .fold = of_halves<inverted>},
};

}  // namespace

std::span<const StepEntry> fold_entries() { return table; }

}  // namespace strata::oracle::program
