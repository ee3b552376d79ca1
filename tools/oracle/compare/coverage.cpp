// tools/oracle/compare/coverage.cpp - decides which pixels were drawn, from alpha or a background colour, and the kind
// of difference between two such masks (coverage.h).
#include "tools/oracle/compare/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "rasterizer/base/enum_values.h"

namespace strata::oracle {

namespace {

using Color = std::vector<std::uint32_t>;

std::span<const std::uint32_t> codes_at(const TargetImage& target, std::size_t pixel) {
    const auto channels = static_cast<std::size_t>(target.channels);
    return {target.codes.data() + pixel * channels, channels};
}

// The commonest colour of these pixels, if at least half of them have it.
template <class Pixels>
std::optional<Color> commonest(const TargetImage& target, const Pixels& pixels) {
    std::map<Color, std::size_t> counts;
    auto last = counts.end();  // neighbours are often equal
    for (const std::size_t pixel : pixels) {
        const auto codes = codes_at(target, pixel);
        if (last == counts.end() || !std::ranges::equal(last->first, codes))
            last = counts.try_emplace(Color(codes.begin(), codes.end())).first;
        ++last->second;
    }
    const auto most = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
    if (most == counts.end() || 2 * most->second < pixels.size()) return std::nullopt;
    return most->first;
}

std::vector<std::size_t> edge_of(const TargetImage& target) {
    std::vector<std::size_t> edge;
    const int w = target.width, h = target.height;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            if (x == 0 || y == 0 || x == w - 1 || y == h - 1)
                edge.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x));
    return edge;
}

Mask other_than(const TargetImage& target, const Color& background) {
    Mask mask(target.pixels());
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = !std::ranges::equal(codes_at(target, i), background);
    return mask;
}

Mask where(const TargetImage& target, auto&& holds) {
    Mask mask(target.pixels());
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = holds(i);
    return mask;
}

// The codes of a given background in a target; missing channels are 0, and alpha is 1.
Color codes_of(const Background& known, const TargetImage& target) {
    Color codes;
    for (std::size_t c = 0; c < static_cast<std::size_t>(target.channels); ++c)
        codes.push_back(nearest(target.code, c < known.size() ? known[c] : c == 3 ? 1.0 : 0.0));
    return codes;
}

std::optional<Masks> by_color(const TargetPair& pair, const Background& known) {
    const auto background = known.empty() ? commonest(*pair.reference, edge_of(*pair.reference))
                                          : std::optional{codes_of(known, *pair.reference)};
    if (!background) return std::nullopt;
    Masks masks{other_than(*pair.reference, *background), {}};
    std::vector<std::size_t> empty;
    for (std::size_t i = 0; i < masks.reference.size(); ++i)
        if (!masks.reference[i]) empty.push_back(i);
    auto own = commonest(*pair.candidate, empty);
    if (!own && known.empty()) return std::nullopt;
    if (!own) own = codes_of(known, *pair.candidate);
    masks.candidate = other_than(*pair.candidate, *own);
    return masks;
}

bool alpha_varies(const TargetImage& target) {
    bool has_zero = false, has_more = false;
    for (std::size_t i = 0; i < target.pixels(); ++i) (target.value_at(i, 3) > 0 ? has_more : has_zero) = true;
    return has_zero && has_more;
}

}  // namespace

std::optional<Masks> drawn(std::span<const TargetPair> pairs, const Background& known) {
    for (const TargetPair& pair : pairs)
        if (!known.empty() && pair.reference->meaning == Meaning::color && pair.reference->part.empty())
            return by_color(pair, known);
    for (const TargetPair& pair : pairs)
        if (pair.reference->meaning == Meaning::depth && pair.reference->part.empty() &&
            pair.reference->code != Code::integer && pair.candidate->code != Code::integer) {
            const auto is_drawn = [](const TargetImage& t) {
                return where(t, [&](std::size_t i) { return t.value_at(i, 0) != 1.0; });
            };
            return Masks{is_drawn(*pair.reference), is_drawn(*pair.candidate)};
        }
    for (const TargetPair& pair : pairs) {
        if (pair.reference->meaning != Meaning::color || !pair.reference->part.empty()) continue;
        if (pair.channels() == 4 && alpha_varies(*pair.reference)) {
            const auto is_drawn = [](const TargetImage& t) {
                return where(t, [&](std::size_t i) { return t.value_at(i, 3) > 0; });
            };
            return Masks{is_drawn(*pair.reference), is_drawn(*pair.candidate)};
        }
        return by_color(pair, {});
    }
    return std::nullopt;
}

std::string_view name(CoverageMistake mistake) noexcept { return enum_name(mistake); }

namespace {

// Changes of the runs in one direction, at their begins and at their ends.
struct Ends {
    std::uint64_t runs = 0;
    std::uint64_t begins_gained = 0, begins_lost = 0, ends_gained = 0, ends_lost = 0;  // numbers of runs
    std::int64_t moved = 0;  // pixels, summed over begins and ends

    // A gain at a run's end and a loss at its begin are a movement forward; the opposites are a movement backward.
    [[nodiscard]] std::uint64_t forward() const { return ends_gained + begins_lost; }
    [[nodiscard]] std::uint64_t backward() const { return begins_gained + ends_lost; }
    [[nodiscard]] double mean() const {
        return runs == 0 ? 0.0 : static_cast<double>(moved) / (2.0 * static_cast<double>(runs));
    }
};

using Run = std::pair<int, int>;  // [begin, end)

std::vector<Run> runs_of(const Mask& mask, std::size_t first, std::size_t step, int count) {
    std::vector<Run> runs;
    for (int i = 0; i < count; ++i) {
        if (!mask[first + static_cast<std::size_t>(i) * step]) continue;
        if (runs.empty() || runs.back().second != i) runs.push_back({i, i});
        runs.back().second = i + 1;
    }
    return runs;
}

// Lines whose masks have different numbers of runs, and runs that touch the image's edge, give no information about a
// border's movement.
void follow(const Masks& masks, std::size_t first, std::size_t step, int count, Ends& ends) {
    const auto here = runs_of(masks.reference, first, step, count),
               there = runs_of(masks.candidate, first, step, count);
    if (here.size() != there.size()) return;
    for (std::size_t i = 0; i < here.size(); ++i) {
        if (here[i].first == 0 || here[i].second == count) continue;
        const int begin = there[i].first - here[i].first, end = there[i].second - here[i].second;
        ++ends.runs;
        ends.moved += begin + end;
        ends.begins_gained += begin < 0 ? 1 : 0;
        ends.begins_lost += begin > 0 ? 1 : 0;
        ends.ends_gained += end > 0 ? 1 : 0;
        ends.ends_lost += end < 0 ? 1 : 0;
    }
}

// True if one direction has at most a fiftieth of the other.
bool keeps_to_one_way(const Ends& ends) {
    return 50 * std::min(ends.forward(), ends.backward()) <= std::max(ends.forward(), ends.backward());
}

// True if all nine pixels around are equal in the reference.
bool is_inner(const Mask& mask, std::size_t x, std::size_t y, std::size_t width, std::size_t height) {
    const bool own = mask[y * width + x];
    for (std::size_t j = y > 0 ? y - 1 : 0; j <= std::min(y + 1, height - 1); ++j)
        for (std::size_t i = x > 0 ? x - 1 : 0; i <= std::min(x + 1, width - 1); ++i)
            if (mask[j * width + i] != own) return false;
    return true;
}

CoverageMistake mistake_of(const CoverageReport& report, const Ends& rows, const Ends& columns) {
    if (report.gained + report.lost == 0) return CoverageMistake::none;
    const auto is_far = [](double moved) { return moved >= 0.25 || moved <= -0.25; };
    // A fill rule that includes both edges moves only one end of the runs.
    const auto moves = [&](const Ends& ends) {
        const std::uint64_t begins = std::max(ends.begins_gained, ends.begins_lost);
        const std::uint64_t stops = std::max(ends.ends_gained, ends.ends_lost);
        return is_far(ends.mean()) && keeps_to_one_way(ends) && 8 * std::min(begins, stops) >= ends.runs;
    };
    if (moves(rows) || moves(columns)) return CoverageMistake::moved;
    if (2 * report.inner > report.gained + report.lost) return CoverageMistake::surface;
    if (report.gained == 0 || report.lost == 0) return CoverageMistake::edge_rule;
    return keeps_to_one_way(rows) && keeps_to_one_way(columns) ? CoverageMistake::edge_rule : CoverageMistake::snapping;
}

}  // namespace

CoverageReport compare_coverage(const Masks& masks, int width, int height) {
    CoverageReport report;
    const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x) {
            const std::size_t i = y * w + x;
            if (masks.reference[i] == masks.candidate[i]) continue;
            ++(masks.candidate[i] ? report.gained : report.lost);
            report.inner += is_inner(masks.reference, x, y, w, h) ? 1 : 0;
        }
    Ends rows, columns;
    for (std::size_t y = 0; y < h; ++y) follow(masks, y * w, 1, width, rows);
    for (std::size_t x = 0; x < w; ++x) follow(masks, x, w, height, columns);
    report.moved_x = rows.mean();
    report.moved_y = columns.mean();
    report.mistake = mistake_of(report, rows, columns);
    return report;
}

std::string CoverageReport::description() const {
    const std::string counts = fmt::format("{} gained, {} lost", gained, lost);
    switch (mistake) {
        case CoverageMistake::none: return "the same pixels are drawn";
        case CoverageMistake::moved:
            return fmt::format("{}: moved by about ({:.2f}, {:.2f}) pixels, as by a half-pixel or viewport mistake",
                               counts, moved_x, moved_y);
        case CoverageMistake::edge_rule:
            return gained == 0 || lost == 0
                       ? fmt::format("{}, at the borders: a fill rule that counts edges on all sides, or none", counts)
                       : fmt::format(
                             "{}, all on the same side of an edge: the fill rule assigns pixel centres on an edge to "
                             "the opposite triangle",
                             counts);
        case CoverageMistake::snapping:
            return fmt::format("{}, mixed along the borders: positions snapped or rounded otherwise", counts);
        case CoverageMistake::surface: break;
    }
    return fmt::format("{}, {} of them away from the borders: surfaces lost, culled or added", counts, inner);
}

}  // namespace strata::oracle
