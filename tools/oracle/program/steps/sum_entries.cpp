// tools/oracle/program/steps/sum_entries.cpp - folds that are sums over all layers, independent of their order:
// averages and weights by depth (entries.h).
//
// Source   Bavoil, Myers 2008 (weighted average); McGuire, Bavoil 2013, equations 7 to 10 (weights by depth).
#include <algorithm>
#include <cmath>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

using Stack = std::span<const PortLayer>;

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
// The tail's average is weighted by `join` of the transmittance of the layers before it.
template <auto join>
Color tail_joined(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    const auto first = std::min(static_cast<std::size_t>(p[0]), layers.size());
    double core = 1;
    for (const PortLayer& layer : layers.first(first)) core *= 1 - layer.cover;
    const LayerSums tail = sums_of<one>(layers.subspan(first), p);
    const Color back = over(tail, tail.through, {});
    Color color = blended(layers.first(first), {}, r);
    for (std::size_t c = 0; c < 3; ++c) color[c] += join(core) * back[c] + core * tail.through * behind[c];
    return color;
}
double unweighted(double) { return 1; }
double squared(double core) { return core * core; }
double inverted(double core) { return 1 - core; }
// The tail's colour is the average of all layers.
Color tail_of_all(Stack layers, const Color& behind, const PortRounding& r, Parameters p) {
    const auto first = std::min(static_cast<std::size_t>(p[0]), layers.size());
    const double through = sums_of<one>(layers.subspan(first), p).through;
    return blended(layers.first(first), over(sums_of<one>(layers, p), through, behind), r);
}
// The sums are kept in [0, p[0]].
template <auto weight_of>
Color clamped(Stack layers, const Color& behind, const PortRounding&, Parameters p) {
    LayerSums s = sums_of<weight_of>(layers, p);
    for (double& c : s.color) c = std::min(c, p[0]);
    s.weight = std::min(s.weight, p[0]);
    return over(s, s.through, behind);
}
template <auto weight_of>
Color undivided(Stack layers, const Color& behind, const PortRounding&, Parameters p) {
    LayerSums s = sums_of<weight_of>(layers, p);
    for (std::size_t c = 0; c < 3; ++c) s.color[c] = std::min(s.color[c], 1.0) + s.through * behind[c];
    return s.color;
}
template <auto weight_of>
Color divided_by_alphas(Stack layers, const Color& behind, const PortRounding&, Parameters p) {
    LayerSums s = sums_of<weight_of>(layers, p);
    s.weight = s.alpha;
    return over(s, s.through, behind);
}
// Black where there are no layers.
template <auto weight_of>
Color without_background(Stack layers, const Color&, const PortRounding&, Parameters p) {
    return over(sums_of<weight_of>(layers, p), 0, {});
}
template <auto weight_of>
Color by_sum_of_alphas(Stack layers, const Color& behind, const PortRounding&, Parameters p) {
    const LayerSums s = sums_of<weight_of>(layers, p);
    return over(s, std::max(1 - s.alpha, 0.0), behind);
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

constexpr double scales[] = {0.05, 0.1, 0.3, 1}, distances[] = {0.1, 0.2, 0.5, 1, 10, 200};
constexpr double exponents[] = {1, 2, 3, 4}, counts[] = {1, 2, 3, 4, 6, 8}, sum_limits[] = {1, 4, 16};

const StepEntry table[] = {
    fold_entry("layers are averaged, with the mean alpha (weighted average)", 4, weighted_average),
    fold_entry("layers are averaged by alpha, with the right transmittance", 5, weighted<one>),
    fold_entry("layers are averaged by the square of alpha, with the right transmittance", 6, weighted<alpha>),
    fold_entry("weighted sums: alpha max(0.01, 3000 (1 - depth)^3)", 5, weighted<by_depth_10>),
    fold_entry("weighted sums: clamp(0.03 / (1e-5 + (depth / {})^4), 0.01, 3000)", 5, weighted<by_distance>, distances,
               true),
    fold_entry("weighted sums: alpha clamp(0.03 / (1e-5 + (depth / {})^4), 0.01, 3000)", 5,
               weighted<by_distance_and_alpha>, distances, true),
    fold_entry("weighted sums: (1 - depth)^{}", 6, weighted<by_power>, exponents, true),
    fold_entry("layers are averaged by weights that depend on depth (weighted sums): e^-(depth / {})^2", 5,
               weighted<by_gauss<false>>, scales, true),
    fold_entry("layers are averaged by weights that depend on depth (weighted sums): alpha e^-(depth / {})^2", 5,
               weighted<by_gauss<true>>, scales, true),
    fold_entry("layers are averaged by weights that depend on depth (weighted sums): e^-(depth / {})", 5,
               weighted<by_decay<false>>, scales, true),
    fold_entry("layers are averaged by weights that depend on depth (weighted sums): alpha e^-(depth / {})", 5,
               weighted<by_decay<true>>, scales, true),
    {.step = PortStep::fold,
     .words = "layers are averaged by weights that depend on depth (weighted sums): depths from {} to {} act with "
              "weights of e^{}, {}, {}, {}, {}, {}, {}, {}, times alpha^{}",
     .price = 10,
     .start = equal_weights,
     .is_plausible = fall_with_depth,
     .fold = weighted<by_curve>},
    fold_entry("behind the first {} layers the others are averaged", 6, tail_averaged, counts),
    fold_entry("the average of the layers behind the first {} is that of all layers", 6, tail_of_all, counts),
    fold_entry("the average of the layers behind the first {} is not attenuated by these", 6, tail_joined<unweighted>,
               counts),
    fold_entry("the average of the layers behind the first {} is attenuated by these twice", 7, tail_joined<squared>,
               counts),
    fold_entry("the average of the layers behind the first {} is weighted by their alpha", 7, tail_joined<inverted>,
               counts),
    fold_entry("weighted sums: alpha max(0.01, 3000 (1 - depth)^3), and sums are clamped to {}", 6,
               clamped<by_depth_10>, sum_limits, true),
    fold_entry("layers are averaged by alpha, and sums are clamped to {}", 6, clamped<one>, sum_limits),
    fold_entry("weighted sums: alpha max(0.01, 3000 (1 - depth)^3), not divided by the sum of weights", 6,
               undivided<by_depth_10>),
    fold_entry("weighted sums: alpha max(0.01, 3000 (1 - depth)^3), the background by 1 - the sum of alphas", 6,
               by_sum_of_alphas<by_depth_10>),
    fold_entry("weighted sums: alpha max(0.01, 3000 (1 - depth)^3), divided by the sum of alphas without weights", 6,
               divided_by_alphas<by_depth_10>),
    fold_entry("weighted sums: alpha max(0.01, 3000 (1 - depth)^3), as if the transmittance were 0: no background", 6,
               without_background<by_depth_10>),
    fold_entry("layers are averaged by alpha, as if the transmittance were 0: no background", 5,
               without_background<one>),
    fold_entry("layers are averaged by alpha, the background is weighted by 1 - the sum of alphas", 6,
               by_sum_of_alphas<one>),
};

}  // namespace

std::span<const StepEntry> sum_entries() { return table; }

}  // namespace strata::oracle::program
