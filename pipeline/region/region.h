// pipeline/region/region.h - a rectangle of the frame with its own render targets: the interface for peeling
// algorithms.
//
// Rule     An algorithm is one function over a region. Literal execution passes it the frame, replay one tile after the
//          other; bits, pass counts and query results are the same. Only `any` turns a query into a branch. A region
//          consists of targets, stages, source and loop (region_shared.h describes their dependencies). The
//          executor reads its results from RegionStatistics (region_statistics.h); optimized paths use RegionShortcuts
//          (region_shortcuts.h).
// Source   pipeline/reference/execution.md 1 and 4.
// Tests    tests/pipeline/region/region_test.cpp, tests/peeling/execution/execution_test.cpp
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "pipeline/fragments/join_samples.h"
#include "pipeline/frame/pass.h"
#include "pipeline/region/region_loop.h"
#include "pipeline/region/region_shared.h"
#include "pipeline/region/region_source.h"
#include "pipeline/region/region_stages.h"
#include "pipeline/region/region_targets.h"

namespace strata::pipeline {

class RegionScratchPool;

class Region {
  public:
    // `pool`: lends the region its arrays; null: the region allocates its own.
    Region(const Frame& frame, const RegionArea& area, RegionStatistics& statistics,
           const Instruments& instruments = {}, RegionScratchPool* pool = nullptr);
    Region(const Region&) = delete;
    Region& operator=(const Region&) = delete;
    ~Region();

    [[nodiscard]] const Frame& frame() const noexcept { return shared_.frame; }
    [[nodiscard]] const DeviceProfile& profile() const noexcept { return shared_.profile(); }
    [[nodiscard]] rasterizer::Rect rect() const noexcept { return shared_.rect(); }
    // Targets have an element for every sample of every pixel: sample * rect().area() + pixel.
    [[nodiscard]] std::size_t elements() const noexcept { return shared_.elements(); }

    // Contents are 0; targets are created in the same order in every region. Throws Refused for more samples than the
    // profile has.
    [[nodiscard]] Target make(Format format, int samples = 1) { return targets_.make(format, samples); }
    [[nodiscard]] Target make_color() { return make(frame().color_format); }
    [[nodiscard]] Target make_depth() { return targets_.make_depth(); }
    // The opaque scene, drawn before the algorithm starts: depth in the form of the algorithm's key, and colour over
    // the background (without opaque geometry: depth 1, the background).
    [[nodiscard]] Target opaque_depth() const noexcept { return targets_.opaque_depth(); }
    [[nodiscard]] Target opaque_color() const noexcept { return targets_.opaque_color(); }
    // Names a target for observers and alterations.
    void set_name(Target target, std::string_view name) const { targets_.set_name(target, name); }
    // Clears fill the region: scissor and write masks belong to passes.
    void clear(Target target, const ClearValue& value, std::uint8_t sample_mask = 0xff) {
        targets_.clear(target, value, sample_mask);
    }
    void copy(Target from, Target to) { targets_.copy(from, to); }  // same format and samples: a bit copy
    [[nodiscard]] const TargetStorage& storage(Target target) const { return targets_.at(target); }
    [[nodiscard]] Targets& targets() noexcept { return targets_; }  // for all other operations on targets
    [[nodiscard]] const Targets& targets() const noexcept { return targets_; }

    // One geometry pass over the transparent list, or over the part of it in `state.primitives`.
    template <FragmentProgram P>
    DrawCounts draw(const PassState& state, P&& program) {
        return draw(state, *frame().transparent, program);
    }
    // One geometry pass over a list of the frame, or over another list; the latter only if the frame is a single region
    // (surface.h).
    template <FragmentProgram P>
    DrawCounts draw(const PassState& state, const PreparedDraw& list, P&& program);
    // One geometry pass that tests and writes depth, without a program or colours; written directly to the target if
    // possible.
    DrawCounts draw_depth(const PassState& state);
    // One geometry pass whose program outputs (c a, a) of every fragment to color[0], and 1 to each further target;
    // added directly to the targets if `state` adds them and does nothing else with them.
    DrawCounts draw_sums(const PassState& state);
    // A screen-aligned quad: one fragment at every pixel of the region.
    template <FragmentProgram P>
    DrawCounts full_screen(const PassState& state, P&& program);

    // The frame's answer to "is the count above the limit of --termination?". Idle::yes is for the query that ends the
    // loop, the last call of an iteration: the region may stop there. A query that only selects a branch within the
    // iteration uses Idle::no.
    [[nodiscard]] bool any(Count count, Idle idle) { return loop_.any(count, idle); }
    void begin_iteration() { loop_.begin_iteration(); }
    // Begins a further loop: promises made so far apply to the loops before it, and later ones only to the new loop. If
    // a limit counts passes across the loops, a tile that left a loop early gets the number that the frame has made.
    void begin_loop() { loop_.begin_loop(); }
    // True once --max-passes or fixed:N leave fewer than `passes` geometry passes; the same in every region.
    [[nodiscard]] bool limit_reached(int passes = 1) { return loop_.limit_reached(passes); }
    void keep_layer(Target color, Target depth, Side side = Side::front) { loop_.keep_layer(color, depth, side); }
    // Called after the last layer: sets the contents that this region has in layers that only other regions have found.
    void keep_no_layer(Target color, Target depth) { loop_.keep_no_layer(color, depth); }
    // Sets the final colour, the algorithm's result. If the image has another format, a quad converts it.
    void publish(Target color);

    // Adds to the trace the pixels that `program` marks, with `read` as its only load. For the audit; not a pass.
    template <FragmentProgram P>
    void trace_pixels(Target read, P&& program);
    void trace(const TraceEntry& entry) { shared_.trace(entry); }  // one step that is not part of a pass
    // `elements` of this region are affected; `first_pixel` is the first of their pixels.
    void report(Fault fault, std::uint64_t elements, std::uint32_t first_pixel, std::string detail) {
        shared_.report(fault, elements, first_pixel, std::move(detail));
    }

  private:
    friend class RegionShortcuts;
    friend void report(Region& region, Fault fault, std::string detail);

    void draw_opaque();
    [[nodiscard]] PassState altered(const PassState& state, PassKind kind);
    void end_pass(const PassState& state, PassKind kind, const DrawCounts& drawn);
    template <FragmentProgram P>
    DrawCounts draw_everything(const PassState& state, const PreparedDraw& list, P& program);
    template <FragmentProgram P>
    DrawCounts draw_once_a_pixel(const PassState& state, const PreparedDraw& list, P& program);
    template <FragmentProgram P>
    DrawCounts draw_together(const PassState& state, const PreparedDraw& list, P& program);
    template <FragmentProgram P>
    DrawCounts draw_visits(const PassState& state, P& program);
    template <class P>
    void run_batch(const PassState& state, P& program, FragmentBatch& batch, Outputs& out, DrawCounts& drawn);
    DrawCounts checked(const std::function<DrawCounts()>& quick, const std::function<DrawCounts()>& definition);

    RegionScratchPool* pool_;
    std::unique_ptr<RegionScratch> scratch_;
    RegionShared shared_;
    Targets targets_;
    Stages stages_;
    FragmentSource source_;
    Loop loop_;
};

void report(Region& region, Fault fault, std::string detail);  // without a pixel

// Copies the colours of a target to another: a bit copy, or a quad if the formats differ.
void copy_color(Region& region, Target from, Target to);

template <FragmentProgram P>
DrawCounts Region::draw(const PassState& given, const PreparedDraw& list, P&& program) {
    const PassState state = altered(given, PassKind::geometry);
    stages_.begin_pass(state, PassKind::geometry);
    if (state.once_a_pixel) return draw_once_a_pixel(state, list, program);
    if (stages_.moves_centroids(state, list)) return draw_together(state, list, program);
    if (state.selection.keeps == KeptFragments::everything || !source_.find_fragments(state, list))
        return draw_everything(state, list, program);
    return shared_.instruments.check_selections ? checked([&] { return draw_visits(state, program); },
                                                          [&] { return draw_everything(state, list, program); })
                                                : draw_visits(state, program);
}

template <FragmentProgram P>
DrawCounts Region::draw_everything(const PassState& state, const PreparedDraw& list, P& program) {
    DrawCounts drawn;
    auto sink = [&](FragmentBatch& batch) {
        Outputs& out = stages_.start_batch(batch);
        if (!source_.reads_record()) stages_.shade(list, batch, out);
        stages_.show(Stage::shaded, state, batch, out, out.alive);
        run_batch(state, program, batch, out, drawn);
    };
    stages_.open_cache(state);
    source_.for_each_batch(list, state, rasterizer::BatchSink{sink});
    end_pass(state, PassKind::geometry, drawn);
    return drawn;
}

template <FragmentProgram P>
DrawCounts Region::draw_once_a_pixel(const PassState& state, const PreparedDraw& list, P& program) {
    DrawCounts drawn;
    source_.for_each_pixel_batch(list, state, rect(), JoinedColors::once, [&](PixelBatch& pixels) {
        Outputs& out = stages_.test_pixels(state, pixels, drawn);
        stages_.load(state, pixels.batch);
        const auto run = [&] { program(static_cast<const FragmentBatch&>(pixels.batch), stages_.loads(), out); };
        stages_.run_program(state, pixels.batch, out, std::ref(run));
        stages_.write_pixels(state, pixels, out, drawn);
    });
    end_pass(state, PassKind::geometry, drawn);
    return drawn;
}

// All samples of a triangle before the next one, because colours depend on the tests of all of them.
template <FragmentProgram P>
DrawCounts Region::draw_together(const PassState& state, const PreparedDraw& list, P& program) {
    DrawCounts drawn;
    const auto run_sample = [&](FragmentBatch& batch, Outputs& out) {
        stages_.show(Stage::shaded, state, batch, out, out.alive);
        run_batch(state, program, batch, out, drawn);
    };
    source_.for_each_pixel_batch(list, state, rect(), JoinedColors::at_centre_and_samples,
                                 [&](PixelBatch& pixels) { stages_.for_each_sample(state, pixels, run_sample); });
    end_pass(state, PassKind::geometry, drawn);
    return drawn;
}

template <FragmentProgram P>
DrawCounts Region::draw_visits(const PassState& state, P& program) {
    const bool is_routed = state.selection.keeps == KeptFragments::submitted;
    if (is_routed) source_.route_submitted(state);
    stages_.open_cache(state);
    DrawCounts drawn;
    PassState drawn_to = state;
    while (FragmentBatch* const batch = source_.next_visit(state)) {
        if (is_routed) drawn_to.sample_mask = static_cast<std::uint8_t>(1u << source_.wave());
        run_batch(drawn_to, program, *batch, stages_.start_batch(*batch), drawn);
    }
    stages_.close_cache();
    if (is_routed) source_.finish_submitted(state);
    if (state.selection.outside == Outside::writes_alike)
        drawn.passed.own_ = source_.recorded();  // includes the fragments outside passes
    return drawn;
}

template <FragmentProgram P>
DrawCounts Region::full_screen(const PassState& given, P&& program) {
    const PassState state = altered(given, PassKind::full_screen);
    stages_.begin_pass(state, PassKind::full_screen);
    stages_.open_cache(state);
    DrawCounts drawn;
    std::size_t next = 0;
    while (FragmentBatch* const batch = stages_.next_screen_batch(next))
        run_batch(state, program, *batch, stages_.start_batch(*batch), drawn);
    end_pass(state, PassKind::full_screen, drawn);
    return drawn;
}

template <class P>
void Region::run_batch(const PassState& state, P& program, FragmentBatch& batch, Outputs& out, DrawCounts& drawn) {
    stages_.load(state, batch);
    const auto run = [&] { program(static_cast<const FragmentBatch&>(batch), stages_.loads(), out); };
    stages_.run_program(state, batch, out, std::ref(run));
    stages_.finish(state, batch, out, drawn);
}

template <FragmentProgram P>
void Region::trace_pixels(Target read, P&& program) {
    if (!frame().trace) return;
    stages_.begin_query();
    PassState state;
    state.reads[0] = read;
    const UncountedWork look{shared_.statistics};
    std::size_t next = 0;
    while (FragmentBatch* const batch = stages_.next_screen_batch(next)) {
        Outputs& out = stages_.start_batch(*batch);
        stages_.load(state, *batch);
        program(static_cast<const FragmentBatch&>(*batch), stages_.loads(), out);
        stages_.record_trace(*batch, out, out.alive);
    }
}

}  // namespace strata::pipeline
