// tools/oracle/search/edits.cpp - finds the mistake that gives the value of each wrong pixel: explanations first, then
// leads; for a single pixel every rule (edits.h).
#include "tools/oracle/search/edits.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

using Rules = std::vector<Rule>;

const Hypothesis& hypothesis_of(const Verdict& verdict) {
    const CheckedAccount& account = verdict.explanations.empty() ? verdict.right : verdict.explanations[0];
    return account.account.hypothesis;
}

// Explanations of one picture are equivalent, so only the first is used; without explanations, all leads.
std::vector<Rules> told(const Verdict& verdict) {
    if (!verdict.explanations.empty()) return {verdict.explanations[0].account.rules};
    std::vector<Rules> all;
    for (const Lead& lead : verdict.leads) all.push_back(lead.rules);
    return all;
}

bool is_right_at(const Compositor& compositor, const PixelList& list, const std::array<double, 4>& value,
                 StackMaker& maker) {
    return matching_ties(compositor, {}, list, value, maker).mask != 0;
}

bool explains(const Compositor& compositor, const Rules& rules, const PixelList& list,
              const std::array<double, 4>& value, StackMaker& maker) {
    return matching_ties(compositor, rules, list, value, maker).mask != 0;
}

}  // namespace

EditMap edit_map(const SceneFragments& scene, const Colors& candidate, const Verdict& verdict) {
    EditMap map{.width = scene.width(), .height = scene.height()};
    map.of_pixel.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), EditMap::right);
    for (Rules& rules : told(verdict)) map.edits.push_back({std::move(rules), 0});
    const Compositor compositor{hypothesis_of(verdict)};
    scene.for_each_tile([&](const TileLists& tile) {
        StackMaker maker{scene.setting()};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            const auto value = candidate.at(list.x, list.y);
            if (is_right_at(compositor, list, value, maker)) continue;
            const auto edit = std::ranges::find_if(
                map.edits, [&](const EditCount& e) { return explains(compositor, e.rules, list, value, maker); });
            const std::size_t at = static_cast<std::size_t>(list.y) * static_cast<std::size_t>(map.width) +
                                   static_cast<std::size_t>(list.x);
            map.of_pixel[at] = edit == map.edits.end() ? EditMap::unexplained
                                                       : static_cast<std::uint8_t>(edit - map.edits.begin() + 1);
        }
    });
    for (const std::uint32_t pixel : verdict.alpha.wrong_pixels) map.of_pixel[pixel] = EditMap::wrong_alpha;
    for (const std::uint8_t number : map.of_pixel) {
        if (number == EditMap::wrong_alpha) continue;
        if (number == EditMap::unexplained)
            ++map.not_explained;
        else if (number != EditMap::right)
            ++map.edits[number - std::size_t{1}].pixels;
    }
    return map;
}

namespace {

// The pixel of the scene with its fragments.
SampledPixel pixel_at(const SceneFragments& scene, const Colors& candidate, int x, int y) {
    Sample found{scene.setting()};
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        const rasterizer::Rect& r = tile.rect;
        if (x < r.x0 || x >= r.x1 || y < r.y0 || y >= r.y1) return;
        const auto p = static_cast<std::size_t>(y - r.y0) * static_cast<std::size_t>(r.width()) +
                       static_cast<std::size_t>(x - r.x0);
        const std::scoped_lock lock{mutex};
        found.add(scene.at(tile, p), candidate.at(x, y));
    });
    SampledPixel pixel = found.pixels().at(0);
    const std::span<const Fragment> all{pixel.fragments};
    const std::size_t visible = pixel.list.visible.size();
    pixel.list.visible = all.first(visible);
    pixel.list.hidden = all.subspan(visible);
    return pixel;
}

// Finds a subset and order of the layers that gives the value, with the fewest layers left out.
class Chooser {
  public:
    Chooser(const Compositor& compositor, const PixelEdits& pixel, const Stack& right)
        : compositor_{compositor}, value_{pixel.pixel.value}, right_{right} {}

    [[nodiscard]] std::optional<PixelEdit> find() {
        constexpr std::size_t most_layers = 12, most_permuted = 6;
        const std::size_t n = right_.layers.size();
        if (n > most_layers) return std::nullopt;
        for (std::size_t lost = 0; lost <= n; ++lost)
            for (std::uint32_t set = 0; set < 1u << n; ++set) {
                if (static_cast<std::size_t>(std::popcount(set)) != lost) continue;
                std::vector<std::size_t> chosen;
                for (std::size_t i = 0; i < n; ++i)
                    if ((set >> i & 1) == 0) chosen.push_back(i);
                do
                    if (auto found = tried(chosen)) return found;
                while (chosen.size() <= most_permuted && std::ranges::next_permutation(chosen).found);
            }
        return std::nullopt;
    }

  private:
    [[nodiscard]] std::optional<PixelEdit> tried(const std::vector<std::size_t>& chosen) const {
        Stack stack{.background = right_.background};
        for (const std::size_t i : chosen) stack.layers.push_back(right_.layers[i]);
        stack.near = (chosen.size() + 1) / 2;
        stack.near_without_middle = chosen.size() / 2;
        const ReachableColor reach = compositor_.reach(stack);
        if (!holds(reach, value_)) return std::nullopt;
        return PixelEdit{.chosen = chosen, .reach = reach};
    }

    const Compositor& compositor_;
    std::array<double, 4> value_;
    Stack right_;
};

// The rules of explanations and leads first, then every rule.
std::vector<Rules> all_rules(const Verdict& verdict) {
    std::vector<Rules> all;
    for (const CheckedAccount& c : verdict.explanations) all.push_back(c.account.rules);
    for (const Lead& lead : verdict.leads) all.push_back(lead.rules);
    for (const Rule& rule : rules_for(verdict.facts)) all.push_back({rule});
    return all;
}

}  // namespace

PixelEdits edits_at(const SceneFragments& scene, const Colors& candidate, const Verdict& verdict, int x, int y) {
    constexpr std::size_t most_edits = 6;
    PixelEdits found{.pixel = pixel_at(scene, candidate, x, y), .hypothesis = hypothesis_of(verdict)};
    const PixelList& list = found.pixel.list;
    const Compositor compositor{found.hypothesis};
    StackMaker maker{scene.setting()};
    const Stack right = maker.right(list, {});
    found.right = compositor.reach(right);
    if (verdict.alpha.is_told && candidate.has_alpha()) found.alpha = candidate.alpha_at(x, y);
    found.has_wrong_alpha =
        std::ranges::binary_search(verdict.alpha.wrong_pixels, static_cast<std::uint32_t>(y * scene.width() + x));
    const bool has_right_colors = is_right_at(compositor, list, found.pixel.value, maker);
    found.is_right = has_right_colors && !found.has_wrong_alpha;
    if (has_right_colors) return found;
    std::vector<Stack> seen;
    // Rules that hold for the given coverage are preferred to those that need another rasterizer's.
    for (const bool at_edge : {false, true})
        for (const Rules& rules : all_rules(verdict)) {
            if (found.edits.size() == most_edits || (at_edge && !found.edits.empty())) break;
            const MatchingTies way = matching_ties(compositor, rules, list, found.pixel.value, maker);
            if (way.mask == 0 || way.at_edge != at_edge) continue;
            const Stack& stack = maker.with(rules, way.list, way.ties, way.is_moved);
            if (std::ranges::find(seen, stack) != seen.end()) continue;
            seen.push_back(stack);
            found.edits.push_back({.rules = rules, .reach = compositor.reach(stack)});
            if (at_edge) break;
        }
    if (found.edits.empty())
        if (auto chosen = Chooser{compositor, found, right}.find()) found.edits.push_back(*std::move(chosen));
    return found;
}

}  // namespace strata::oracle::verdict
