// tools/oracle/verdict/verdict.cpp - decides in this order: the closest account of the right structure; if it is whole,
// what remains to be asked of a right picture (right_picture.h); wider rounding, if it costs about as little; reversed
// rows or columns; one mistake in the whole picture, then in the part with the wrong pixels, then under wider rounding;
// leads.
#include "tools/oracle/verdict/verdict.h"

#include <algorithm>
#include <mutex>

#include "tools/oracle/rounding/doubt.h"
#include "tools/oracle/rounding/pricing.h"
#include "tools/oracle/search/search.h"
#include "tools/oracle/verdict/right_picture.h"

namespace strata::oracle::verdict {

namespace {

double bits_of(const CheckedAccount& c, Storage storage) {
    return c.bits + static_cast<double>(c.wrong_pixels.size()) * Pricing{storage}.of_wrong();
}

// The candidate's colour where nothing is drawn, if it is a single colour and not the background's.
std::optional<Rgba> other_background(const SceneFragments& scene, const Colors& candidate) {
    constexpr double seen = 1.5 / 255;
    std::mutex mutex;
    std::optional<std::array<double, 4>> color;
    bool is_one = true, is_other = false;
    scene.for_each_tile([&](const TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            if (!list.visible.empty() || list.has_opaque || list.edge != nullptr) continue;
            const auto value = candidate.at(list.x, list.y);
            const std::scoped_lock lock{mutex};
            if (!color) color = value;
            for (std::size_t c = 0; c < 3; ++c) {
                is_one = is_one && value[c] == (*color)[c];
                is_other = is_other || std::fabs(value[c] - double{list.behind[c]}) > seen;
            }
        }
    });
    if (!color || !is_one || !is_other) return std::nullopt;
    return Rgba{static_cast<float>((*color)[0]), static_cast<float>((*color)[1]), static_cast<float>((*color)[2]), 1};
}

// The candidate with its rows or columns reversed, or both.
TargetImage rearranged(const Colors& candidate, RuleKind kind) {
    TargetImage target = candidate.target();
    const auto channels = static_cast<std::size_t>(target.channels);
    const auto width = static_cast<std::size_t>(target.width), height = static_cast<std::size_t>(target.height);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t from_x = kind == RuleKind::rows_reversed ? x : width - 1 - x;
            const std::size_t from_y = kind == RuleKind::columns_reversed ? y : height - 1 - y;
            for (std::size_t c = 0; c < channels; ++c)
                target.codes[(y * width + x) * channels + c] =
                    candidate.target().codes[(from_y * width + from_x) * channels + c];
        }
    return target;
}

// Tests whether the picture is right except that its rows or columns are reversed.
std::optional<CheckedAccount> right_but_rearranged(const SceneFragments& scene, const Colors& candidate,
                                                   const Families& definite, std::size_t most_sampled) {
    for (const RuleKind kind : {RuleKind::rows_reversed, RuleKind::columns_reversed, RuleKind::turned}) {
        const TargetImage target = rearranged(candidate, kind);
        const Colors colors{target, candidate.use()};
        Sample sample = sampled(scene, colors, most_sampled);
        auto found = account_for(definite, {}, scene, colors, sample);
        if (!found) continue;
        found->account.rules = {{.kind = kind}};
        found->changed = found->pixels;
        return found;
    }
    return std::nullopt;
}

// True if all values are codes, or sums of accumulator codes (composite.h: Sums): so few are possible that a picture
// far from right does not have them.
bool is_of_codes(const Hypothesis& h) {
    const End& nearer = has_front(h.order) ? h.front : h.back;
    const bool ends_in_codes = nearer.rounding != Rounding::held && nearer.rounding != Rounding::any;
    return has_codes(h.result.storage) || (has_codes(nearer.storage) && ends_in_codes);
}

// The account of the right structure that describes the picture, including its wrong pixels, in the fewest bits. The
// hypothesis is chosen on a sample, then again with some of the wrong pixels added.
CheckedAccount closest_account(const SceneFragments& scene, const Colors& candidate, const Families& definite,
                               const Sample& even, Sample& examples) {
    constexpr std::size_t few_sampled = 300, few_added = 75,
                          few_structures = 1024;  // each is tried with every hypothesis
    constexpr int most_tries = 4;
    const Storage storage = storage_of(candidate.code());
    Sample sample = even.thinned(few_sampled).with_few_structures(few_structures);
    std::optional<CheckedAccount> best;
    for (int i = 0; i < most_tries; ++i) {
        const Hypothesis next = *best_of(definite, {}, sample, WrongPixels::some);
        if (best && next == best->account.hypothesis) break;
        Sample wrong{scene.setting()};
        CheckedAccount found = check_all(scene, candidate, {{}, next}, WrongPixels::some, wrong);
        const bool is_better = !best || bits_of(found, storage) < bits_of(*best, storage);
        const Sample some = wrong.thinned(few_added).with_few_structures(few_structures);
        for (const SampledPixel& pixel : some.pixels()) sample.add(pixel.list, pixel.value);
        if (is_better) examples = std::move(wrong);
        if (is_better) best = std::move(found);
        if (best->is_whole()) break;
    }
    return *std::move(best);
}

// The rectangle of all wrong pixels, if it is a small part of the picture: extended to the tile of 8 to 64 pixels that
// contains it, if there is one.
std::optional<RuleRegion> region_of(const std::vector<std::uint32_t>& wrong, int width, int height) {
    constexpr std::size_t least = 16;  // with fewer pixels, mistakes cannot be distinguished
    if (wrong.size() < least) return std::nullopt;
    RuleRegion box{width, height, 0, 0};
    for (const std::uint32_t pixel : wrong) {
        const int x = static_cast<int>(pixel % static_cast<std::uint32_t>(width));
        const int y = static_cast<int>(pixel / static_cast<std::uint32_t>(width));
        box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
    }
    if (2 * (box.x1 - box.x0) * (box.y1 - box.y0) > width * height) return std::nullopt;
    for (const int size : {8, 16, 32, 64}) {
        const RuleRegion tile{box.x0 / size * size, box.y0 / size * size, (box.x0 / size + 1) * size,
                              (box.y0 / size + 1) * size};
        if (box.x1 <= tile.x1 && box.y1 <= tile.y1) return tile;
    }
    return box;
}

constexpr std::size_t most_sampled = 2048, most_wrong_sampled = 512;

// Prepares a scene for a verdict.
void restart(SceneFragments& scene) {
    scene.setting().work->restart();
    scene.set_seen_background(std::nullopt);
    scene.show_at_far_plane(false);
}

}  // namespace

std::optional<Verdict> judge_quickly(SceneFragments& scene, const Colors& candidate, const SearchLimits& limits) {
    restart(scene);
    const Choices all = choices(candidate);
    const RightPicture picture{scene, candidate, all, limits};
    scene.setting().work->begin_stage(0.1, 0.2);
    for (const bool is_shown : {false, true}) {
        if (is_shown && scene.count_at_far_plane() == 0) break;
        scene.show_at_far_plane(is_shown);
        const Sample even = sampled(scene, candidate, most_sampled);
        Verdict verdict{.width = scene.width(), .facts = facts_of(scene, even)};
        Sample sample = even;
        auto right = account_for(all.definite, {}, scene, candidate, sample);
        if (!right || !leaves_little_open(*right)) continue;
        if (is_shown) verdict.shown_at_far_plane = scene.count_at_far_plane();
        return picture.decide(std::move(verdict), *std::move(right), even);
    }
    scene.show_at_far_plane(false);
    return std::nullopt;
}

namespace {

// The usual mistakes first.
void sort_explanations(Verdict& verdict) {
    std::ranges::stable_sort(verdict.explanations, {}, [](const CheckedAccount& c) {
        int most = 0;
        for (const Rule& rule : c.account.rules) most = std::max(most, commonness_of(rule.kind));
        return most;
    });
}

Verdict found_at_length(SceneFragments& scene, const Colors& candidate, const SearchLimits& limits) {
    constexpr std::size_t most_structures = 32768;
    restart(scene);
    WorkCounter& work = *scene.setting().work;
    const std::uint64_t of_fragments = limits.of_fragment * scene.count();
    const Storage storage = storage_of(candidate.code());
    const Choices all = choices(candidate);
    const RightPicture picture{scene, candidate, all, limits};
    Verdict verdict{.width = scene.width()};
    work.begin_stage(0.2, 0.4);
    scene.find_coverages();
    work.begin_stage(0.4, 0.5);
    const Sample even = sampled(scene, candidate, most_sampled);
    scene.set_seen_background(other_background(scene, candidate));
    verdict.facts = facts_of(scene, even);
    Sample sample = even, examples{scene.setting()};
    verdict.right = closest_account(scene, candidate, all.definite, even, examples);
    if (verdict.right.is_whole()) {
        CheckedAccount right = std::move(verdict.right);
        return picture.decide(std::move(verdict), std::move(right), even);
    }
    // An account with wider intervals than the closest one must cost about as little, or no pixel may be far off.
    constexpr double few_codes = 2;
    const double most_bits = 1.1 * bits_of(verdict.right, storage) + 64;
    std::optional<Verdict> doubtful;
    for (const Families* some : {&all.definite, &all.coarse, &all.loose}) {
        auto right = account_for(*some, {}, scene, candidate, sample);
        if (!right ||
            (right->bits > most_bits && !(is_of_codes(right->account.hypothesis) && right->observed <= few_codes)))
            continue;
        doubtful = picture.decide(verdict, *std::move(right), even);
        if (doubtful->doubt.empty()) return *std::move(doubtful);
        break;
    }
    const Sample wrong = examples.thinned(most_wrong_sampled);
    for (const SampledPixel& pixel : wrong.pixels())
        if (!sample.has(pixel.list.x, pixel.list.y)) sample.add(pixel.list, pixel.value);
    if (auto found = right_but_rearranged(scene, candidate, all.definite, most_sampled)) {
        verdict.explanations = {*std::move(found)};
        return verdict;
    }
    sample = sample.with_few_structures(most_structures);
    work.begin_stage(0.6, 0.8);
    work.allow(limits.mistakes + of_fragments);
    MistakeSearch search{scene, candidate, verdict.right, sample};
    const auto is_found = [&](const Families& some, const RuleRegion& region) {
        verdict.explanations = search.found(some, region);
        verdict.is_stopped = work.is_cut_short();
        return !verdict.explanations.empty();
    };
    if (is_found(all.definite, {})) return verdict;
    if (const auto region = region_of(verdict.right.wrong_pixels, scene.width(), scene.height()))
        if (is_found(all.definite, *region)) return verdict;
    if (is_found(all.coarse, {})) return verdict;
    if (doubtful) return *std::move(doubtful);
    work.begin_stage(0.8, 0.9);
    work.allow(limits.leads);
    verdict.leads = search.leads();
    // The search may have stopped before it tried a mistake that explains all pixels that were looked at.
    for (const Lead& lead : verdict.leads) {
        if (lead.explained < lead.of || lead.contradicted > 0) continue;
        work.restart();
        auto found = explained_by(lead.rules, scene, candidate, all.definite, even);
        if (!found) continue;
        verdict.explanations = {*std::move(found)};
        verdict.is_stopped = false;
        break;
    }
    return verdict;
}

// True if the right structure reaches most of the changed pixels, too, under rounding of more than two codes: such a
// mistake moves values by less than its rounding does, and another mistake can have the same picture.
bool fits_by_rounding(const CheckedAccount& c) {
    constexpr double few_codes = 2;
    return has_codes(c.account.hypothesis.result.storage) && c.possible > few_codes && 4 * c.undecided > 3 * c.changed;
}

}  // namespace

Verdict judge_at_length(SceneFragments& scene, const Colors& candidate, const SearchLimits& limits) {
    Verdict verdict = found_at_length(scene, candidate, limits);
    const bool was_explained = !verdict.explanations.empty();
    // Under rounding as wide as this a mistake explains a picture that has another one.
    const std::size_t wide = std::erase_if(verdict.explanations, [](const CheckedAccount& c) {
        return has_codes(c.account.hypothesis.result.storage) && c.observed > most_codes_of_right;
    });
    // One that excuses more pixels at edges than it explains, and more than snapping moves, fits by chance.
    if (!verdict.right.is_whole())
        std::erase_if(verdict.explanations, [](const CheckedAccount& c) {
            return c.excuses_many_edges() && c.at_edges > c.changed - c.undecided;
        });
    std::erase_if(verdict.explanations, fits_by_rounding);
    const Choices all = choices(candidate);
    std::erase_if(verdict.explanations, [&](const CheckedAccount& c) {
        return c.undecided > 0 && !doubt_of(scene, candidate, c, all.definite).empty();
    });
    if (was_explained && verdict.explanations.empty() && verdict.right.is_whole())
        verdict.doubt = wide > 0 ? "a mistake explains the picture better, but needs rounding of more than 5 codes"
                                 : "a mistake explains the picture better, but moves values by less than rounding does";
    sort_explanations(verdict);
    return verdict;
}

Verdict judge(SceneFragments& scene, const Colors& candidate, const SearchLimits& limits) {
    if (auto quick = judge_quickly(scene, candidate, limits)) return *std::move(quick);
    return judge_at_length(scene, candidate, limits);
}

}  // namespace strata::oracle::verdict
