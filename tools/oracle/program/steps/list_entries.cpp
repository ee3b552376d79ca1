// tools/oracle/program/steps/list_entries.cpp - mistakes with a pixel's list: layers left out, doubled, exchanged,
// moved, merged, or with another layer's colour or alpha (entries.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

void leave_out(PortLayers& layers, const SelectedFragments& s, Parameters) {
    std::erase_if(layers, [&](const PortLayer& layer) { return s.has(layer); });
}

void blend_twice(PortLayers& layers, const SelectedFragments& s, Parameters) {
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (s.has(layers[i])) {
            const PortLayer copy = layers[i];
            layers.insert(layers.begin() + static_cast<std::ptrdiff_t>(i++), copy);
        }
}

// Each of several copies is blended.
void blend_again(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    const PortLayers given = layers;
    layers.clear();
    for (const PortLayer& layer : given)
        layers.insert(layers.end(), s.has(layer) ? static_cast<std::size_t>(p[0]) : 1, layer);
}

// A peel whose next layer must be farther than the one kept before by more than an epsilon.
void peel_with_epsilon(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    double kept = -1e9;
    std::erase_if(layers, [&](const PortLayer& layer) {
        const bool is_lost = s.has(layer) && layer.depth - kept <= p[0];
        if (!is_lost) kept = layer.depth;
        return is_lost;
    });
}

// The same from the back.
void peel_back_with_epsilon(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    std::ranges::reverse(layers);
    double kept = 1e9;
    std::erase_if(layers, [&](const PortLayer& layer) {
        const bool is_lost = s.has(layer) && kept - layer.depth <= p[0];
        if (!is_lost) kept = layer.depth;
        return is_lost;
    });
    std::ranges::reverse(layers);
}

// A peel that stores depths of fewer bits: a layer that is farther than its stored depth is found again in
// every pass of as many as there are layers; what lies before the stored depth of another one is lost.
void peel_with_bits(PortLayers& layers, const SelectedFragments&, Parameters p) {
    const double codes = std::exp2(p[0]) - 1;
    const PortLayers given = layers;
    layers.clear();
    double stored = -1;
    for (std::size_t pass = 0; pass < given.size(); ++pass) {
        const auto next = std::ranges::find_if(given, [&](const PortLayer& layer) { return layer.depth > stored; });
        if (next == given.end()) return;
        layers.push_back(*next);
        stored = std::nearbyint(next->depth * codes) / codes;
    }
}
constexpr double copies[] = {3, 4, 5, 6, 7, 8, 16}, epsilons[] = {1e-5, 1e-4, 1e-3, 1e-2, 0.05},
                 stored_bits[] = {8, 10, 12, 14, 15, 16, 20};

void exchange_with_next(PortLayers& layers, const SelectedFragments& s, Parameters) {
    for (std::size_t i = 0; i + 1 < layers.size(); ++i)
        if (s.has(layers[i])) {
            std::swap(layers[i], layers[i + 1]);
            ++i;
        }
}

template <bool are_selected_first>
void divide(PortLayers& layers, const SelectedFragments& s, Parameters) {
    thread_local PortLayers others;
    others.clear();
    std::erase_if(layers, [&](const PortLayer& layer) {
        if (s.has(layer) == are_selected_first) return false;
        others.push_back(layer);
        return true;
    });
    layers.insert(layers.end(), others.begin(), others.end());
}

// Where another layer is: the one before, the one behind, or the nearest.
enum class From { before, behind, nearest };
enum class What { all, color, alpha };

template <From from, What what>
void take(PortLayers& layers, const SelectedFragments& s, Parameters) {
    const PortLayers given = layers;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!s.has(layers[i])) continue;
        const std::size_t j = from == From::before ? i - 1 : from == From::behind ? i + 1 : 0;
        if (j >= given.size()) continue;
        if (what != What::alpha) layers[i].color = given[j].color;
        if (what != What::color) {
            layers[i].alpha = given[j].alpha;
            layers[i].cover = given[j].cover;
        }
    }
}

// Colours of the layers as far from the other end; alphas stay.
void take_mirrored_color(PortLayers& layers, const SelectedFragments& s, Parameters) {
    const PortLayers given = layers;
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (s.has(layers[i])) layers[i].color = given[given.size() - 1 - i].color;
}

// Layers are stored one after another in an array of p[0], whose places are composited in their order.
void wrap_around(PortLayers& layers, const SelectedFragments&, Parameters p) {
    const auto places = static_cast<std::size_t>(p[0]);
    for (std::size_t k = places; k < layers.size(); ++k) layers[k % places] = layers[k];
    layers.resize(std::min(layers.size(), places));
}
constexpr double array_places[] = {2, 3, 4, 6, 8, 16};

// The layer and the one before it become one with the MAX of each channel of their premultiplied colours.
void merge_with_before(PortLayers& layers, const SelectedFragments& s, Parameters) {
    for (std::size_t i = layers.size(); i-- > 1;) {
        if (!s.has(layers[i])) continue;
        PortLayer& before = layers[i - 1];
        const double alpha = std::max(before.alpha, layers[i].alpha);
        for (std::size_t c = 0; c < 3; ++c) {
            const double sum = std::max(before.color[c] * before.alpha, layers[i].color[c] * layers[i].alpha);
            before.color[c] = alpha > 0 ? sum / alpha : 0;
        }
        before.alpha = alpha;
        before.cover = std::max(before.cover, layers[i].cover);
        layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

const StepEntry table[] = {
    {.words = "are left out", .price = 2, .edit = leave_out},
    {.words = "are blended twice", .price = 3, .edit = blend_twice},
    {.words = "are blended {} times", .price = 4, .parameters = copies, .edit = blend_again},
    {.words = "are lost if they are within {} in depth behind the last layer that was kept",
     .price = 3,
     .parameters = epsilons,
     .is_continuous = true,
     .is_order = true,
     .edit = peel_with_epsilon},
    {.words = "are lost if they are within {} in depth before the last layer that was kept from the back",
     .price = 4,
     .parameters = epsilons,
     .is_continuous = true,
     .is_order = true,
     .edit = peel_back_with_epsilon},
    {.words = "are peeled by depths that are stored in {} bits: layers are lost, or found again in the next pass",
     .price = 4,
     .parameters = stored_bits,
     .is_order = true,
     .edit = peel_with_bits},
    {.words = "are exchanged with the next ones behind", .price = 4, .edit = exchange_with_next},
    {.words = "are composited in front of all others", .price = 4, .edit = divide<true>},
    {.words = "are composited behind all others", .price = 4, .edit = divide<false>},
    {.words = "are replaced by the ones before", .price = 5, .edit = take<From::before, What::all>},
    {.words = "are replaced by the ones behind", .price = 5, .edit = take<From::behind, What::all>},
    {.words = "are replaced by the nearest", .price = 5, .edit = take<From::nearest, What::all>},
    {.words = "have the colour of the ones before", .price = 5, .edit = take<From::before, What::color>},
    {.words = "have the colour of the ones behind", .price = 5, .edit = take<From::behind, What::color>},
    {.words = "have the colour of the nearest", .price = 5, .edit = take<From::nearest, What::color>},
    {.words = "have the alpha of the ones before", .price = 5, .edit = take<From::before, What::alpha>},
    {.words = "have the alpha of the ones behind", .price = 5, .edit = take<From::behind, What::alpha>},
    {.words = "have the alpha of the nearest", .price = 5, .edit = take<From::nearest, What::alpha>},
    {.words = "have the colour of the ones at the same rank from the other end",
     .price = 5,
     .edit = take_mirrored_color},
    {.words = "are kept in an array of {} layers, where later ones replace the first",
     .price = 4,
     .parameters = array_places,
     .is_order = true,
     .edit = wrap_around},
    {.words = "are merged with the ones before by MAX", .price = 6, .edit = merge_with_before},
};

}  // namespace

std::span<const StepEntry> list_entries() { return table; }

}  // namespace strata::oracle::program
