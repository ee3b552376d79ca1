// tools/oracle/compare/layers.cpp - decides whether layers of a pixel are missing, doubled, merged or reordered, from
// colours and depths (layers.h).
#include "tools/oracle/compare/layers.h"

#include <algorithm>

namespace strata::oracle {

namespace {

struct ComparedLayer {
    LayerTarget target;
    std::size_t pixel = 0;

    [[nodiscard]] int channels() const { return target.color->channels; }
    [[nodiscard]] StoredCode color(int c) const { return target.color->at(pixel, c); }
};

bool has_equal_color(const ComparedLayer& a, const ComparedLayer& b) {
    for (int c = 0; c < std::min(a.channels(), b.channels()); ++c)
        if (!is_equal(a.color(c), b.color(c))) return false;
    return true;
}

bool has_equal_depth(const ComparedLayer& a, const ComparedLayer& b) {
    if (a.target.depth == nullptr || b.target.depth == nullptr) return true;
    return is_equal(a.target.depth->at(a.pixel, 0), b.target.depth->at(b.pixel, 0));
}

bool is_same(const ComparedLayer& a, const ComparedLayer& b) { return has_equal_color(a, b) && has_equal_depth(a, b); }

using Stack = std::vector<ComparedLayer>;

Stack stack_at(std::span<const LayerTarget> layers, std::size_t pixel) {
    Stack stack;
    for (const LayerTarget& layer : layers) {
        const TargetImage& color = *layer.color;
        bool is_there = false;
        for (int c = color.channels == 4 ? 3 : 0; c < color.channels; ++c) is_there |= color.value_at(pixel, c) != 0.0;
        if (is_there) stack.push_back({layer, pixel});
    }
    return stack;
}

// True if `part` is `whole` with layers left out; `rest` receives those.
bool is_part_of(const Stack& part, const Stack& whole, Stack& rest) {
    std::size_t next = 0;
    rest.clear();
    for (const ComparedLayer& layer : whole) {
        if (next < part.size() && is_same(part[next], layer))
            ++next;
        else
            rest.push_back(layer);
    }
    return next == part.size();
}

bool has(const Stack& stack, const ComparedLayer& layer) {
    return std::ranges::any_of(stack, [&](const ComparedLayer& other) { return is_same(layer, other); });
}

// MAX of each channel, as blending with MAX merges two fragments; only layers stored in the same form have one.
bool is_greatest_of(const ComparedLayer& merged, const ComparedLayer& a, const ComparedLayer& b) {
    for (int c = 0; c < std::min({merged.channels(), a.channels(), b.channels()}); ++c) {
        const StoredCode one = a.color(c), other = b.color(c);
        if (!is_equal(value(one.code, one.word) < value(other.code, other.word) ? other : one, merged.color(c)))
            return false;
    }
    return true;
}

// True if the candidate has one layer fewer and is equal except for one that replaces two and equals neither of them.
bool is_merged(const Stack& reference, const Stack& candidate) {
    if (candidate.size() + 1 != reference.size()) return false;
    std::size_t at = 0;
    while (at < candidate.size() && is_same(reference[at], candidate[at])) ++at;
    if (at == candidate.size() || is_same(reference[at + 1], candidate[at])) return false;
    for (std::size_t i = at + 1; i < candidate.size(); ++i)
        if (!is_same(reference[i + 1], candidate[i])) return false;
    const bool tied = reference[at].target.depth != nullptr && has_equal_depth(reference[at], reference[at + 1]);
    return tied || is_greatest_of(candidate[at], reference[at], reference[at + 1]);
}

bool is_doubled(const Stack& reference, const Stack& candidate) {
    for (std::size_t i = 0; i < candidate.size(); ++i) {
        const auto times = [&](const Stack& stack) {
            return std::ranges::count_if(stack,
                                         [&](const ComparedLayer& other) { return is_same(candidate[i], other); });
        };
        if (times(candidate) > std::max<std::ptrdiff_t>(times(reference), 1) && has(reference, candidate[i]))
            return true;
    }
    return false;
}

bool is_reordered(const Stack& reference, const Stack& candidate) {
    return reference.size() == candidate.size() &&
           std::is_permutation(reference.begin(), reference.end(), candidate.begin(), is_same);
}

}  // namespace

std::vector<LayerTarget> layers_of(const Picture& picture) {
    std::vector<LayerTarget> layers;
    for (const TargetImage& target : picture.targets) {
        if (target.part.empty() || target.meaning != Meaning::color) continue;
        LayerTarget layer{&target, nullptr};
        for (const TargetImage& other : picture.targets)
            if (other.part == target.part && other.meaning == Meaning::depth) layer.depth = &other;
        layers.push_back(layer);
    }
    return layers;
}

Kind compare_layers(std::span<const LayerTarget> reference, std::span<const LayerTarget> candidate, std::size_t pixel) {
    const Stack mine = stack_at(reference, pixel), theirs = stack_at(candidate, pixel);
    if (std::ranges::equal(mine, theirs, is_same)) return Kind::none;
    Stack rest;
    if (is_doubled(mine, theirs)) return Kind::layer_doubled;
    if (is_merged(mine, theirs)) return Kind::layer_merged;
    if (is_part_of(theirs, mine, rest)) return Kind::layer_missing;
    if (is_reordered(mine, theirs)) return Kind::layer_swapped;
    if (mine.size() != theirs.size()) return Kind::layer_other;
    return std::ranges::equal(mine, theirs, has_equal_depth) ? Kind::color : Kind::depth;
}

}  // namespace strata::oracle
