// tools/oracle/verdict/shifted_edges.cpp - lets triangles that enter or leave a wrong pixel vote for a direction, and
// decides whether one has nearly all votes (shifted_edges.h).
#include "tools/oracle/verdict/shifted_edges.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>

#include "tools/oracle/fragments/coverages.h"
#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

constexpr unsigned all_directions = (1u << shift_words.size()) - 1;

// The first triangle that only one of the two lists contains.
std::optional<std::uint32_t> changed_triangle(const PixelList& a, const OtherList& b) {
    const auto lacks = [](std::span<const Fragment> list, const Fragment& f) {
        return std::ranges::find(list, f.primitive, &Fragment::primitive) == list.end();
    };
    for (const Fragment& f : a.visible)
        if (lacks(b.visible, f)) return f.primitive;
    for (const Fragment& f : b.visible)
        if (lacks(a.visible, f)) return f.primitive;
    return std::nullopt;
}

// The directions that give the value of a pixel which the given coverage does not explain.
struct Vote {
    std::uint32_t triangle = 0;
    unsigned directions = 0;
};

std::optional<Vote> vote_of(const Compositor& compositor, const PixelList& list, const std::array<double, 4>& value,
                            StackMaker& maker) {
    const auto holds = [&](PixelList alone) {
        alone.edge = nullptr;
        alone.has_spreads = list.has_spreads;
        return matching_ties(compositor, {}, alone, value, maker).mask != 0;
    };
    if (list.edge == nullptr || holds(list)) return std::nullopt;
    Vote vote;
    std::optional<std::uint32_t> triangle;
    for (const OtherList& other : list.edge->others) {
        if (other.directions == 0 || !holds(other.at(list.x, list.y))) continue;
        vote.directions |= other.directions;
        if (!triangle) triangle = changed_triangle(list, other);
    }
    if (!triangle || vote.directions == all_directions) return std::nullopt;
    vote.triangle = *triangle;
    return vote;
}

}  // namespace

std::string_view direction_of_edges(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& right) {
    constexpr std::size_t fewest = 10;
    const Compositor compositor{right.account.hypothesis};
    std::map<std::uint32_t, unsigned> votes;  // per triangle: the directions that all of its pixels have
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        StackMaker maker{scene.setting()};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            const auto vote = vote_of(compositor, list, candidate.at(list.x, list.y), maker);
            if (!vote) continue;
            const std::scoped_lock lock{mutex};
            const auto [known, is_new] = votes.emplace(vote->triangle, vote->directions);
            if (!is_new) known->second &= vote->directions;
        }
    });
    if (votes.size() < fewest) return "";
    for (std::size_t d = 0; d < shift_words.size(); ++d) {
        const auto in_favour = static_cast<std::size_t>(
            std::ranges::count_if(votes, [d](const auto& vote) { return (vote.second >> d & 1u) != 0; }));
        if (100 * in_favour >= 95 * votes.size()) return shift_words[d];
    }
    return "";
}

}  // namespace strata::oracle::verdict
