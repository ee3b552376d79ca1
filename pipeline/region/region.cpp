// pipeline/region/region.cpp - assembles a region from its parts, and draws the opaque scene before the body starts
// (pipeline/reference/execution.md 1.1).
#include "pipeline/region/region.h"

#include <algorithm>

#include "pipeline/region/region_scratch.h"

namespace strata::pipeline {

namespace {

// Outputs the terms of a weighted sum: (c a, a), and 1 for every further target.
void leave_terms(const PassState& state, const FragmentBatch& in, Outputs& out) noexcept {
    const auto lanes = static_cast<std::size_t>(in.count);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < lanes; ++i) out.color[0][c][i] = in.color[c][i] * in.color[3][i];
    std::copy_n(in.color[3].begin(), lanes, out.color[0][3].begin());
    for (std::size_t k = 1; k < state.color.size(); ++k)
        if (state.color[k].exists())
            for (Lanes<float>& ones : out.color[k]) std::fill_n(ones.begin(), lanes, 1.0f);
}

}  // namespace

void RegionShared::trace(const TraceEntry& entry) const {
    scratch.trace.push_back(entry);
    if (const Observer* o = instruments.observer; o != nullptr && o->traced) o->traced(region, entry);
}

void RegionShared::report(Fault fault, std::uint64_t elements, std::uint32_t first_pixel, std::string detail) const {
    if (elements == 0) return;
    const auto width = static_cast<std::uint32_t>(rect().width());
    merge(statistics.diagnostics, {fault, elements, rect().x0 + static_cast<int>(first_pixel % width),
                                   rect().y0 + static_cast<int>(first_pixel / width), std::move(detail)});
}

// The trace is empty after the opaque scene.
Region::Region(const Frame& frame, const RegionArea& area, RegionStatistics& statistics, const Instruments& instruments,
               RegionScratchPool* pool)
    : pool_{pool},
      scratch_{pool == nullptr ? std::make_unique<RegionScratch>() : pool->take()},
      shared_{frame, area, statistics, instruments, *scratch_, *this},
      targets_{shared_},
      stages_{shared_, targets_},
      source_{shared_, targets_, stages_},
      loop_{shared_, targets_} {
    scratch_->trace.start(frame.trace_bytes);
    const bool is_empty =
        frame.opaque == nullptr || (!shared_.is_frame() && frame.opaque->triangles_in(area.tile) == 0);
    if (!is_empty) draw_opaque();
}

// Returns the scratch to the pool, so that the next region reuses its memory.
Region::~Region() {
    if (pool_ == nullptr) return;
    scratch_->keep_words(targets_.all());
    pool_->give(std::move(scratch_));
}

void report(Region& region, Fault fault, std::string detail) {
    merge(region.shared_.statistics.diagnostics, {fault, 0, -1, -1, std::move(detail)});
}

void copy_color(Region& region, Target from, Target to) {
    if (region.storage(from).format() == region.storage(to).format()) return region.copy(from, to);
    PassState state;
    state.color[0] = to;
    state.reads[0] = from;
    static_cast<void>(region.full_screen(
        state, [](const FragmentBatch&, const Loads& loads, Outputs& out) { out.color[0] = loads.color(0); }));
}

void Region::publish(Target color) {
    const auto format = frame().published_format;
    if (format && storage(color).format() != *format) {
        const Target picture = make(*format);
        set_name(picture, "picture");
        copy_color(*this, color, picture);
        color = picture;
    }
    shared_.statistics.published = color;
    shared_.show({.step = Step::publish, .to = color});
}

PassState Region::altered(const PassState& state, PassKind kind) {
    PassState changed = state;
    if (const Alteration* a = shared_.alteration(); a != nullptr && a->pass) a->pass(*this, changed, kind);
    return changed;
}

void Region::end_pass(const PassState& state, PassKind kind, const DrawCounts& drawn) {
    stages_.close_cache();
    if (const Alteration* a = shared_.alteration(); a != nullptr && a->drawn) a->drawn(kind, drawn.passed.own_);
    shared_.show({.step = kind == PassKind::geometry ? Step::geometry : Step::full_screen,
                  .state = &state,
                  .passed = drawn.passed.own_,
                  .tallied = drawn.tallied.own_});
}

void Region::draw_opaque() {
    const UncountedWork priming{shared_.statistics};
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = opaque_depth();
    state.color[0] = opaque_color();
    draw(state, *frame().opaque, [](const FragmentBatch& in, const Loads&, Outputs& out) {
        out.color[0] = in.color;
        out.color[0][3].fill(1.0f);  // alphaMode OPAQUE ignores alpha, and fragments that MASK keeps are opaque
    });
}

DrawCounts Region::draw_depth(const PassState& state) {
    if (!source_.depth_suits_rows(state)) return draw(state, [](const FragmentBatch&, const Loads&, Outputs&) {});
    DrawCounts drawn;
    drawn.passed.own_ = source_.draw_depth_rows(state).passed;
    return drawn;
}

DrawCounts Region::draw_sums(const PassState& state) {
    if (!source_.sums_suit_rows(state))
        return draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) { leave_terms(state, in, out); });
    DrawCounts drawn;
    drawn.passed.own_ = source_.draw_sum_rows(state).passed;
    return drawn;
}

// Runs both versions from the same targets and compares. The result is that of visiting every fragment, the definition.
// A program that writes elsewhere than to its outputs does so twice.
DrawCounts Region::checked(const std::function<DrawCounts()>& quick, const std::function<DrawCounts()>& definition) {
    std::vector<TargetStorage> targets = targets_.all();
    const std::size_t traced = scratch_->trace.size();
    const Count quick_passed = quick().passed;
    std::swap(targets_.all(), targets);  // `targets` then has the result of the optimized version
    scratch_->trace.shorten(traced);
    const DrawCounts drawn = definition();
    if ((quick_passed.own_ > 0) != (drawn.passed.own_ > 0))
        throw std::logic_error("pass state: what a pass promises differs from its program in what it answers a query");
    targets_.require_equal(targets);
    return drawn;
}

}  // namespace strata::pipeline
