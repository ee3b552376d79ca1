// pipeline/region/region_selection.cpp - geometry passes that visit only what decides: the fragments that a selection keeps go through
// the stages, and the others are counted as if they had (execution.md 7.1). Literal execution never takes this way: it is
// what this one is tested against.
#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "pipeline/frame/effects.h"
#include "pipeline/frame/pass_counters.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

using rasterizer::FragmentNeeds;

namespace {

using Finger = SortedFragments::Finger;

constexpr std::size_t pixels_ahead = 12;  // whose words are asked for: about as many as memory answers at once

// The codes of a depth target in the form of sorted keys.
class KeyBound {
  public:
    KeyBound(const std::uint32_t* codes, DepthKey key) : codes_{codes}, is_float_key_{key == DepthKey::shader_z} {}
    [[nodiscard]] bool exists() const noexcept { return codes_ != nullptr; }
    [[nodiscard]] std::uint64_t of(std::size_t pixel) const noexcept {
        return is_float_key_ ? rasterizer::ordered_code(std::bit_cast<float>(codes_[pixel])) : codes_[pixel];
    }

  private:
    const std::uint32_t* codes_;
    bool is_float_key_;
};

// A depth test that leaves the nearest fragment of a window, and blends nothing.
bool leaves_the_nearest(const PassState& state) {
    return state.depth == DepthTest{.enabled = true, .func = CompareFunc::less, .write = true} &&
           std::ranges::none_of(state.blend, &Blend::enabled);
}

// A stencil test that every fragment counts down, and that lets one code through, at every sample.
bool routes_arrivals(const PassState& state) {
    constexpr auto decr = StencilOp::decr;
    const StencilFace& face = state.stencil.front;
    const bool counts_down = face.func == CompareFunc::equal && face.func_mask == 0xff && face.write_mask == 0xff &&
                             face.fail == decr && face.depth_fail == decr && face.pass == decr;
    return state.stencil.enabled && !state.stencil.two_sided && counts_down && face.ref > 0 &&
           state.saturates_by_design && state.sample_mask == 0xff && state.selection.outside == Outside::discarded &&
           state.depth == DepthTest{.enabled = true, .func = CompareFunc::always, .write = true};
}

// Whether the pass's tests are those of what it keeps.
bool has_tests_of_its_kind(const PassState& state, int samples) {
    if (state.selection.keeps == Keeps::arrivals) return routes_arrivals(state);
    if (samples != 1 || state.stencil.enabled) return false;
    return state.selection.keeps == Keeps::nearest ? leaves_the_nearest(state) : !state.depth.enabled;
}

// Stages that the counts below do not know.
bool has_foreign_stages(const PassState& state) {
    const bool is_killed_by_alpha = state.selection.outside == Outside::alpha_test;
    const bool is_killed_by_unit = state.selection.outside == Outside::depth_unit;
    return state.replaces_depth || state.ordered_rmw || !state.primitives.empty() || (state.sample_mask & 1u) == 0 ||
           state.alpha.enabled != is_killed_by_alpha || state.depth_unit_count != (is_killed_by_unit ? 1 : 0);
}

// The words of a window by place; in `own` if they stand in another order.
std::span<const std::uint64_t> in_order_of_arrival(std::span<const std::uint64_t> words,
                                                   std::vector<std::uint64_t>& own) {
    const auto place = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    if (std::ranges::is_sorted(words, {}, place)) return words;
    own.assign(words.begin(), words.end());
    std::ranges::sort(own, {}, place);
    return own;
}

std::uint64_t pixel_bytes_of(const TargetStorage& s) {
    return static_cast<std::uint64_t>(info(s.format()).bytes_per_pixel);
}

}  // namespace

// A tile under replay whose fragments fit into memory, and are sortable. They are captured here without a stage behind
// MASK, if no pass has captured them yet.
bool Region::may_select(const PassState& state, const PreparedDraw& list) {
    const FragmentSelection& selection = state.selection;
    const bool is_plain_run = extent_ == Extent::tile && frame_.effects == Effects::needed &&
                              instruments_.once_more == Effect::none && !instruments_.log_passes &&
                              frame_.replay.bytes > 0 && &list == frame_.transparent;
    const bool by_arrival = selection.keeps == Keeps::arrivals;
    if (!is_plain_run || has_foreign_stages(state) || !has_tests_of_its_kind(state, pass_samples_) ||
        (by_arrival && frame_.key != DepthKey::stored_code))
        return false;
    rasterizer::FragmentNeeds kept = pass_needs(state, needs_of_tile(list), frame_.effects);
    kept.texcoord = state.needs.texcoord;
    kept.units = state.needs.units;
    if (!store().serves(kept)) {
        if (!store().may_start()) return false;
        capture_unseen(list, kept | frame_.replay.needs);
        if (!store().serves(kept)) return false;
    }
    SortRequest request{
        .key = frame_.key, .is_float = frame_.key_request().format == DepthFormat::d32f, .by_arrival = by_arrival};
    if (state.alpha.enabled) {
        request.alpha = state.alpha;
        const ChannelType type = state.color[0].exists() ? info(at(state.color[0]).format()).type : ChannelType::unorm8;
        request.eight_bit_alpha = is_eight_bit_alpha(profile().alpha_test, type);
    }
    SortedFragments& sorted = scratch_->sorted;
    if (!sorted.serves(request)) {
        if (!sorted.may_sort(request)) return false;
        store().recall_only(store().needs());
        if (!sorted.sort(store(), request, rect_.area(), frame_.replay.bytes, codes_of(selection.before))) return false;
    }
    const bool has_order =
        selection.keeps == Keeps::ends && std::ranges::any_of(state.color, [&](Target t) {
            return t.exists() && info(at(t).format()).type != ChannelType::unorm8 && t != state.color[0];
        });
    if ((has_order && !sorted.has_plain_colors()) || (selection.by_reference && !sorted.stores_reference()))
        return false;
    // Where a window holds most of the fragments, it is cheaper to visit all of them in a row.
    scratch_->selected.is_ready = selection.keeps == Keeps::window;
    if (!scratch_->selected.is_ready) return true;
    select_window(state);
    return instruments_.check_selections || 2 * scratch_->selected.inside <= sorted.size();
}

// As the first draw of a list does, but for the pass: that follows. What MASK kills is counted then, too.
void Region::capture_unseen(const PreparedDraw& list, const FragmentNeeds& kept) {
    const Counters before = record().counters;
    FragmentNeeds needs = kept;
    const MaterialNeeds& materials = needs_of_tile(list);
    needs.color |= materials.color;
    needs.texcoord |= materials.texcoord && needs.color;
    if (needs.color) needs.units |= materials.shadow;
    store().start(kept, frame_.replay.bytes);
    scratch_->sorted.forget();
    auto sink = [&](FragmentBatch& batch) {
        Outputs& out = start_batch(batch);
        shade(list, batch, out);
        store().append(batch, out.alive);
    };
    rasterize(list, needs, {}, rasterizer::BatchSink{sink});
    store().finish();
    record().counters = before;
}

void Region::select(const PassState& state) {
    if (std::exchange(scratch_->selected.is_ready, false)) return;
    switch (state.selection.keeps) {
        case Keeps::nearest: return select_nearest(state);
        case Keeps::window: return select_window(state);
        case Keeps::arrivals: return select_arrivals(state);
        case Keeps::ends: return select_ends(state);
        case Keeps::everything: return;
    }
}

void Region::select_nearest(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted;
    SelectedFragments& selected = scratch_->selected;
    selected.start();
    const KeyBound behind{codes_of(state.selection.behind), frame_.key};
    const std::uint32_t* const stored = codes_of(state.depth_target);
    const bool is_float = at(state.depth_target).format() == Format::d32f;
    for (std::size_t p = 0; p < sorted.pixels(); ++p) {
        sorted.prefetch(p + pixels_ahead, Finger::low);
        const auto words = sorted.of(p);
        if (words.empty()) continue;
        const std::uint32_t first = behind.exists() ? sorted.below(p, behind.of(p) + 1, Finger::low) : 0;
        // A binary32 that is negative or NaN lies before every stored code, or before none.
        const std::uint32_t last =
            is_float && stored[p] > 0x7f800000u ? 0 : sorted.below(p, stored[p], Finger::surface);
        selected.inside += words.size() - first;
        if (first >= last) continue;
        selected.passed += sorted.passing(p, first, last);
        selected.add(p, words[first], 0);
    }
}

// A window of one key is followed to its end; another one has both bounds.
void Region::select_window(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted;
    SelectedFragments& selected = scratch_->selected;
    const FragmentSelection& selection = state.selection;
    selected.start();
    const bool is_one_key = selection.at.exists();
    const KeyBound low{codes_of(is_one_key ? selection.at : selection.from), frame_.key};
    const KeyBound high{codes_of(selection.before), frame_.key};
    std::vector<std::uint64_t> window;
    for (std::size_t p = 0; p < sorted.pixels(); ++p) {
        sorted.prefetch(p + pixels_ahead, Finger::low);
        const auto words = sorted.of(p);
        if (words.empty()) continue;
        const std::uint32_t first = sorted.below(p, low.of(p), Finger::low);
        std::uint32_t last = first;
        if (is_one_key)
            while (last < words.size() && words[last] >> 32 == low.of(p)) ++last;
        else
            last = std::max(first, sorted.below(p, high.of(p), Finger::high));
        selected.inside += last - first;
        const auto kept = in_order_of_arrival(words.subspan(first, last - first), window);
        for (std::size_t rank = 0; rank < kept.size(); ++rank) selected.add(p, kept[rank], rank);
    }
}

// Those before have counted the stencil down by the time that the kept ones come, and met no sample's test.
void Region::select_arrivals(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted;
    SelectedFragments& selected = scratch_->selected;
    selected.start();
    const std::size_t past = state.selection.first_arrival;
    for (std::size_t p = 0; p < sorted.pixels(); ++p) {
        const auto words = sorted.of(p);
        const std::size_t last = std::min(words.size(), past + samples_of_pass());
        for (std::size_t k = past; k < last; ++k) selected.add(p, words[k], k - past);
        selected.inside += last > past ? last - past : 0;
    }
    count_down(state, [&](std::size_t p) { return std::min(sorted.of(p).size(), past); });
}

// Decrements every sample's stencil by a number of fragments of its pixel, down to 0.
template <class FragmentsAt>
void Region::count_down(const PassState& state, const FragmentsAt& fragments_at) {
    TargetStorage& stencil = at(state.stencil_target);
    for (std::size_t p = 0; p < scratch_->sorted.pixels(); ++p) {
        const auto fragments = static_cast<std::uint32_t>(fragments_at(p));
        for (int sample = 0; fragments > 0 && sample < pass_samples_; ++sample) {
            std::uint32_t& stored = stencil.stencil_plane(sample).words[p];
            stored -= std::min(stored, fragments);
        }
    }
}

// Ends are taken by the columns' own keys: where a bound was flushed as a denormal, they are still the ones that decide.
void Region::select_ends(const PassState& state) {
    SortedFragments& sorted = scratch_->sorted;
    SelectedFragments& selected = scratch_->selected;
    const FragmentSelection& selection = state.selection;
    selected.start();
    const KeyBound before{codes_of(selection.before), frame_.key};
    const auto range = selection.range.exists() ? at(selection.range).texels(0) : Texels{};
    for (std::size_t p = 0; p < sorted.pixels(); ++p) {
        sorted.prefetch(p + pixels_ahead, Finger::low);
        sorted.prefetch(p + pixels_ahead, Finger::high);
        const auto words = sorted.of(p);
        if (words.empty()) continue;
        const auto size = static_cast<std::uint32_t>(words.size());
        std::uint32_t first = 0, last = sorted.below(p, before.of(p), Finger::surface);
        if (selection.range.exists()) {
            const float near = -std::bit_cast<float>(range.plane(0).words[p]);
            const float far = std::bit_cast<float>(range.plane(1).words[p]);
            first = near <= far ? sorted.below(p, rasterizer::ordered_code(near), Finger::low) : last;
            if (near <= far)
                last = std::min(last, sorted.below(p, std::uint64_t{rasterizer::ordered_code(far)} + 1, Finger::high));
        }
        last = std::max(first, last);
        selected.inside += last - first;
        std::size_t rank = 0;
        const auto add = [&](std::uint32_t k) { selected.add(p, words[k], rank++); };
        const auto key = [&](std::uint32_t k) { return words[k] >> 32; };
        std::uint32_t near_end = first, far_begin = last;
        while (near_end < last && key(near_end) == key(first)) add(near_end++);
        while (far_begin > near_end && key(far_begin - 1) == key(last - 1)) --far_begin;
        if (near_end < far_begin) add(near_end);
        if (near_end + 1 < far_begin) add(far_begin - 1);
        for (std::uint32_t k = far_begin; k < last; ++k) add(k);
        // Only where the window writes nothing but its first key does the value of those outside come from outside.
        if (selection.outside == Outside::one_value && near_end == last && last - first < size)
            add(first > 0 ? 0 : last);
    }
}

// Keys that are stored codes need no fetching. Pixels rise within a rank, so their rows do.
FragmentBatch* Region::next_selected(const PassState& state) {
    SelectedFragments& selected = scratch_->selected;
    while (selected.rank < selected.ranks && selected.next == selected.of_rank[selected.rank].size())
        ++selected.rank, selected.next = 0;
    if (selected.rank == selected.ranks) return nullptr;
    const auto& all = selected.of_rank[selected.rank];
    const std::size_t count = std::min<std::size_t>(all.size() - selected.next, batch_capacity);
    FragmentBatch& batch = scratch_->recalled;
    Lanes<std::uint32_t>& places = scratch_->depth_stored;
    const auto width = static_cast<std::uint32_t>(rect_.width());
    std::uint32_t row = all[selected.next].pixel / width;
    for (std::size_t i = 0; i < count; ++i) {
        const SelectedFragments::One& one = all[selected.next + i];
        while (one.pixel >= (row + 1) * width) ++row;
        batch.pixel[i] = one.pixel;
        batch.x[i] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(rect_.x0) + one.pixel - row * width);
        batch.y[i] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(rect_.y0) + row);
        batch.code[i] = one.key;
        places[i] = one.place;
    }
    if (state.selection.by_reference) std::copy_n(batch.code.begin(), count, batch.reference_code.begin());
    selected.next += count;
    batch.count = static_cast<int>(count);
    batch.material = 0;
    FragmentNeeds fetched = state.needs;
    fetched.code = frame_.key == DepthKey::shader_z;  // else the key is the code
    store().fetch({places.data(), count}, fetched, batch);
    return &batch;
}

// The counts of all fragments, in place of those that were visited. Of a window's fragments without a depth test the
// visited are all, or all of them are alike.
Drawn Region::book_selected(const PassState& state, const Counters& before, const Drawn& visited) {
    const SortedFragments& sorted = scratch_->sorted;
    const SelectedFragments& selected = scratch_->selected;
    const FragmentSelection& selection = state.selection;
    const std::uint64_t living = sorted.size(), rasterized = sorted.rasterized();
    if (selection.keeps == Keeps::arrivals) return book_arrivals(state, visited);
    Counters& counters = record().counters;
    counters = before;
    counters.fragments_rasterized += rasterized;
    counters.alpha_killed += sorted.masked() + sorted.alpha_killed();
    for (const auto& targets : {std::span<const Target>{state.textures}, std::span<const Target>{state.reads}})
        for (const Target t : targets)
            if (t.exists()) counters += of_loads(pixel_bytes_of(at(t)), rasterized);
    std::uint64_t arriving = selection.keeps == Keeps::window ? visited.passed.own_ : selected.inside;
    switch (selection.outside) {
        case Outside::discarded: counters.discarded += living - arriving; break;
        case Outside::alpha_test: counters.alpha_killed += living - arriving; break;
        case Outside::depth_unit:
            counters += of_depth_test(pixel_bytes_of(at(state.depth_units[0].depth)), living, arriving, false);
            break;
        case Outside::nothing_new:
        case Outside::one_value: arriving = living; break;
    }
    Drawn drawn;
    drawn.passed.own_ = arriving;
    if (selection.keeps == Keeps::nearest) {
        drawn.passed.own_ = selected.passed;
        counters += of_depth_test(pixel_bytes_of(at(state.depth_target)), arriving, selected.passed, true);
    }
    counters.blended += drawn.passed.own_;
    for (std::size_t k = 0; k < state.color.size(); ++k)
        if (state.color[k].exists() && state.blend[k].write_mask != 0)
            count_color_bytes(state.blend[k], at(state.color[k]), drawn.passed.own_);
    drawn.tallied = visited.tallied;
    return drawn;
}

// What was visited has been counted by its stages, which the other fragments reach up to the stencil.
Drawn Region::book_arrivals(const PassState& state, const Drawn& visited) {
    const SortedFragments& sorted = scratch_->sorted;
    const std::uint64_t kept = scratch_->selected.inside;
    Counters& counters = record().counters;
    counters.fragments_rasterized += sorted.rasterized();
    counters.alpha_killed += sorted.masked();
    counters.discarded += sorted.hidden();
    for (const auto& targets : {std::span<const Target>{state.textures}, std::span<const Target>{state.reads}})
        for (const Target t : targets)
            if (t.exists()) counters += of_loads(pixel_bytes_of(at(t)), sorted.rasterized() - kept);
    const std::uint64_t tests = (sorted.size() - kept) * samples_of_pass();
    counters += {.stencil_killed = tests, .bytes_read = tests, .bytes_written = tests};
    count_down(state, [&](std::size_t p) {
        const std::size_t done = state.selection.first_arrival + samples_of_pass();
        return sorted.of(p).size() - std::min(sorted.of(p).size(), done);
    });
    return visited;
}

Region::Snapshot Region::snapshot() { return {storages_, record().counters, scratch_->trace.size()}; }

void Region::restore(Snapshot& from) {
    std::swap(storages_, from.targets);
    std::swap(record().counters, from.counters);
    scratch_->trace.shorten(from.traced);
}

void Region::require_equal(const Snapshot& selected, Count selected_passed, Count passed) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw std::logic_error(std::string{"pass state: a selection differs from its program in "} + what);
    };
    require(selected.counters == record().counters, "what it counts");
    require(selected_passed.own_ == passed.own_, "what it answers a query");
    for (std::size_t t = 0; t < storages_.size(); ++t)
        for (int channel = 0; channel < std::max(1, info(storages_[t].format()).channels); ++channel)
            for (int sample = 0; sample < storages_[t].samples(); ++sample)
                for (std::size_t p = 0; p < storages_[t].pixels(); ++p)
                    require(storages_[t].code(p, channel, sample) == selected.targets[t].code(p, channel, sample),
                            "what it leaves in a target");
}

}  // namespace strata::pipeline
