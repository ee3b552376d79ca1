#include "tools/oracle/verdict/exchanged_depths.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "tools/oracle/fragments/near_depths.h"
#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

namespace {

using Triangles = std::pair<std::uint32_t, std::uint32_t>;

// Pairs of two surfaces at one distance, the first the nearer one.
struct PairKind {
    PairedSurface nearer{}, farther{};
    std::uint32_t codes = 0;
    friend auto operator<=>(const PairKind&, const PairKind&) = default;
};

PairKind kind_of(const Fragment& a, const Fragment& b) {
    PairKind kind{{a.instance, a.is_front_facing}, {b.instance, b.is_front_facing}, b.code - a.code};
    if (kind.nearer == kind.farther) (a.primitive > b.primitive ? kind.nearer : kind.farther).is_later = true;
    return kind;
}

struct Votes {
    std::uint64_t exchanged = 0, kept = 0;
    std::set<Triangles> triangles{};  // of exchanged pairs
};

using AllVotes = std::map<PairKind, Votes>;

bool are_close(const Fragment& a, const Fragment& b) noexcept {
    return a.code != b.code && b.code - a.code <= close_codes;
}

// The visible fragments with those from `first` to `last` in the reverse order; depths stay in order.
std::vector<Fragment> reversed(std::span<const Fragment> visible, std::size_t first, std::size_t last) {
    std::vector<Fragment> made{visible.begin(), visible.end()};
    for (std::size_t i = first; i <= last; ++i) {
        made[i] = visible[first + last - i];
        made[i].code = visible[i].code;
        made[i].shader_z = visible[i].shader_z;
    }
    return made;
}

class Voter {
  public:
    Voter(const SceneFragments& scene, const CheckedAccount& right)
        : compositor_{right.account.hypothesis}, maker_{scene.setting()} {}

    // Adds what the pixel shows: that some neighbours alone are exchanged, or that close ones are not.
    void add(const PixelList& list, const std::array<double, 4>& value, AllVotes& votes) {
        const std::span<const Fragment> all = list.visible;
        std::vector<std::size_t> pairs;  // index of the nearer fragment
        for (std::size_t i = 0; i + 1 < all.size(); ++i)
            if (are_close(all[i], all[i + 1])) pairs.push_back(i);
        if (pairs.empty()) return;
        const bool is_as_given = holds(list, all, value);
        std::vector<std::pair<std::size_t, std::size_t>> exchanges;  // first and last fragment that explain the value
        for (std::size_t p = 0; p < pairs.size(); ++p)
            for (std::size_t q = p; q < pairs.size() && pairs[q] == pairs[p] + q - p; ++q)
                if (holds(list, reversed(all, pairs[p], pairs[q] + 1), value))
                    exchanges.emplace_back(pairs[p], pairs[q] + 1);
        if (is_as_given)
            for (const std::size_t i : pairs) {
                if (std::ranges::find(exchanges, std::pair{i, i + 1}) == exchanges.end())
                    ++votes[kind_of(all[i], all[i + 1])].kept;  // or else both orders have the value
            }
        else if (exchanges.size() == 1)
            for (std::size_t i = exchanges[0].first; i < exchanges[0].second; ++i) {
                Votes& own = votes[kind_of(all[i], all[i + 1])];
                ++own.exchanged;
                own.triangles.emplace(all[i].primitive, all[i + 1].primitive);
            }
    }

  private:
    [[nodiscard]] bool holds(PixelList list, std::span<const Fragment> visible, const std::array<double, 4>& value) {
        list.visible = visible;
        list.edge = nullptr;
        return matching_ties(compositor_, {}, list, value, maker_).mask != 0;
    }

    Compositor compositor_;
    StackMaker maker_;
};

void merge(AllVotes&& part, AllVotes& all) {
    for (auto& [kind, votes] : part) {
        Votes& own = all[kind];
        own.exchanged += votes.exchanged;
        own.kept += votes.kept;
        own.triangles.merge(votes.triangles);
    }
}

bool is_few(std::uint64_t part, std::uint64_t of) noexcept { return 20 * part <= of; }

// Pairs of the two surfaces that are exchanged although the other one is nearer.
std::uint64_t exchanged_back(const AllVotes& votes, const PairKind& kind) {
    std::uint64_t sum = 0;
    for (const auto& [other, own] : votes)
        if (other.nearer == kind.farther && other.farther == kind.nearer) sum += own.exchanged;
    return sum;
}

}  // namespace

std::optional<ExchangedDepths> exchanged_depths(const SceneFragments& scene, const Colors& candidate,
                                                const CheckedAccount& right) {
    constexpr std::uint64_t fewest = 10;
    constexpr std::size_t fewest_triangles = 2;
    AllVotes votes;
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        Voter voter{scene, right};
        AllVotes part;
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            voter.add(list, candidate.at(list.x, list.y), part);
        }
        const std::scoped_lock lock{mutex};
        merge(std::move(part), votes);
    });
    std::uint64_t all = 0, directed = 0, most = 0;
    std::optional<ExchangedDepths> found;
    for (const auto& [kind, own] : votes) {
        all += own.exchanged;
        const bool is_directed = own.exchanged >= fewest && own.triangles.size() >= fewest_triangles &&
                                 is_few(own.kept, own.exchanged) && is_few(exchanged_back(votes, kind), own.exchanged);
        if (!is_directed) continue;
        directed += own.exchanged;
        if (own.exchanged <= most) continue;
        most = own.exchanged;
        found = {.nearer = kind.nearer, .farther = kind.farther};
    }
    if (!found || !is_few(all - directed, all)) return std::nullopt;
    found->pairs = directed;
    return found;
}

}  // namespace strata::oracle::verdict
