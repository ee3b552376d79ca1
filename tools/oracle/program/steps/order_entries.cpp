// tools/oracle/program/steps/order_entries.cpp - other orders: the selected layers, in the places that they have, are
// sorted by another key (entries.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/oracle/program/steps/entries.h"

namespace strata::oracle::program {

namespace {

// Less is nearer to the front. Equal keys stay in the order of depth, or are drawn one over the other.
enum class SortTies { by_depth, last_in_front, first_in_front };

template <auto key, SortTies ties = SortTies::by_depth>
void sort(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    thread_local PortLayers chosen;
    chosen.clear();
    const auto is_before = [&](const PortLayer& a, const PortLayer& b) {
        const double of_a = key(s.of(a), p), of_b = key(s.of(b), p);
        if (of_a != of_b || ties == SortTies::by_depth) return of_a < of_b;
        const bool is_earlier = s.of(a).submission < s.of(b).submission;
        return ties == SortTies::first_in_front ? is_earlier : s.of(a).submission > s.of(b).submission;
    };
    // Lists are short: one by one, without memory of a sort's own.
    for (const PortLayer& layer : layers)
        if (s.has(layer)) chosen.insert(std::ranges::upper_bound(chosen, layer, is_before), layer);
    auto next = chosen.begin();
    for (PortLayer& layer : layers)
        if (s.has(layer)) layer = *next++;
}

void reverse(PortLayers& layers, const SelectedFragments& s, Parameters) {
    thread_local PortLayers chosen;
    chosen.clear();
    for (const PortLayer& layer : layers)
        if (s.has(layer)) chosen.push_back(layer);
    auto next = chosen.rbegin();
    for (PortLayer& layer : layers)
        if (s.has(layer)) layer = *next++;
}

template <int by>
void rotate(PortLayers& layers, const SelectedFragments&, Parameters) {
    if (layers.empty()) return;
    const auto middle = by > 0 ? layers.begin() + 1 : layers.end() - 1;
    std::rotate(layers.begin(), middle, layers.end());
}

void exchange_halves(PortLayers& layers, const SelectedFragments& s, Parameters) {
    const auto half = static_cast<std::ptrdiff_t>((layers.size() + 1) / 2);
    if (std::ranges::all_of(s.mask, [](char m) { return m != 0; }))
        std::rotate(layers.begin(), layers.begin() + half, layers.end());
}

template <int sign>
double submission(const ListFragment& f, Parameters) {
    return sign * static_cast<double>(f.submission);
}
template <int c, int sign>
double channel(const ListFragment& f, Parameters) {
    return sign * f.color[c];
}
template <int sign>
double alpha(const ListFragment& f, Parameters) {
    return sign * f.alpha;
}
template <int sign>
double instance(const ListFragment& f, Parameters) {
    return sign * static_cast<double>(f.instance);
}
template <int sign>
double material(const ListFragment& f, Parameters) {
    return sign * static_cast<double>(f.material);
}
double coarse(const ListFragment& f, Parameters p) { return std::floor(f.depth * std::exp2(p[0])); }
double half(const ListFragment& f, Parameters) { return stored(PortFormat::half, f.depth); }
template <int sign>
double batch(const ListFragment& f, Parameters p) {
    return sign * std::floor(f.submission / p[0]);
}
double triangle(const ListFragment& f, Parameters) { return f.triangle_depth; }

// Bubble sort of the drawing order with some passes only.
void bubble(PortLayers& layers, const SelectedFragments& s, Parameters p) {
    sort<submission<1>>(layers, s, p);
    for (int pass = 0; pass < static_cast<int>(p[0]); ++pass)
        for (std::size_t i = 0; i + 1 < layers.size(); ++i)
            if (s.has(layers[i]) && s.has(layers[i + 1]) && s.of(layers[i]).depth > s.of(layers[i + 1]).depth)
                std::swap(layers[i], layers[i + 1]);
}
constexpr double passes[] = {1, 2};
constexpr double batches[] = {2, 4, 8, 16};
constexpr double bits[] = {2, 3, 4, 5, 6, 7, 8, 10, 12, 16};

const StepEntry table[] = {
    {.words = "are composited in reverse order", .price = 3, .is_order = true, .edit = reverse},
    {.words = "are not sorted: the last drawn is in front", .price = 3, .is_order = true, .edit = sort<submission<-1>>},
    {.words = "are not sorted: the first drawn is in front", .price = 3, .is_order = true, .edit = sort<submission<1>>},
    {.words = "are sorted by red", .price = 6, .is_order = true, .edit = sort<channel<0, 1>>},
    {.words = "are sorted by red, largest first", .price = 6, .is_order = true, .edit = sort<channel<0, -1>>},
    {.words = "are sorted by alpha", .price = 6, .is_order = true, .edit = sort<alpha<1>>},
    {.words = "are sorted by alpha, largest first", .price = 6, .is_order = true, .edit = sort<alpha<-1>>},
    {.words = "are sorted by instance, the last in front", .price = 5, .is_order = true, .edit = sort<instance<-1>>},
    {.words = "are sorted by instance, the first in front", .price = 5, .is_order = true, .edit = sort<instance<1>>},
    {.words = "are sorted by material, the last in front", .price = 5, .is_order = true, .edit = sort<material<-1>>},
    {.words = "are sorted by material, the first in front", .price = 5, .is_order = true, .edit = sort<material<1>>},
    {.words = "are sorted by depth in {} bits, of equal ones the last drawn is in front",
     .price = 5,
     .parameters = bits,
     .is_order = true,
     .edit = sort<coarse, SortTies::last_in_front>},
    {.words = "are sorted by depth in {} bits, of equal ones the first drawn is in front",
     .price = 5,
     .parameters = bits,
     .is_order = true,
     .edit = sort<coarse, SortTies::first_in_front>},
    {.words = "are sorted by depth as halves, of equal ones the last drawn is in front",
     .price = 5,
     .is_order = true,
     .edit = sort<half, SortTies::last_in_front>},
    {.words = "are sorted by depth as halves, of equal ones the first drawn is in front",
     .price = 5,
     .is_order = true,
     .edit = sort<half, SortTies::first_in_front>},
    {.words = "are sorted by the mean depths of their triangles",
     .price = 5,
     .is_order = true,
     .edit = sort<triangle, SortTies::last_in_front>},
    {.words = "are sorted by {} passes of a bubble sort, nearest first",
     .price = 5,
     .parameters = passes,
     .is_order = true,
     .edit = bubble},
    {.words = "are sorted in batches of {} in drawing order only, the first batch in front",
     .price = 5,
     .parameters = batches,
     .is_order = true,
     .edit = sort<batch<1>>},
    {.words = "are sorted in batches of {} in drawing order only, the last batch in front",
     .price = 5,
     .parameters = batches,
     .is_order = true,
     .edit = sort<batch<-1>>},
    {.words = "are rotated: the nearest becomes the farthest", .price = 6, .is_order = true, .edit = rotate<1>},
    {.words = "are rotated: the farthest becomes the nearest", .price = 6, .is_order = true, .edit = rotate<-1>},
    {.words = "have the far half in front of the near half", .price = 6, .is_order = true, .edit = exchange_halves},
};

}  // namespace

std::span<const StepEntry> order_entries() { return table; }

}  // namespace strata::oracle::program
