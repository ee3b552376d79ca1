// pipeline/region/region_draw.h - how a region runs a caller's program over a pass's fragments: the templates of region.h, which alone
// includes this, behind its class.
#pragma once
#include <algorithm>

namespace strata::pipeline {

template <FragmentProgram P>
Drawn Region::draw_list(const PassState& state, const PreparedDraw& list, P& program) {
    if (alteration() != nullptr) {
        const PassState changed = altered(state, PassKind::geometry);
        begin_pass(changed, PassKind::geometry);
        return draw_everything(changed, list, program);
    }
    begin_pass(state, PassKind::geometry);
    if (state.selection.keeps == Keeps::everything || !find_visits(state, list))
        return draw_everything(state, list, program);
    return instruments_.check_selections ? checked([&] { return draw_visits(state, program); },
                                                   [&] { return draw_everything(state, list, program); })
                                         : draw_visits(state, program);
}

template <FragmentProgram P>
Drawn Region::draw_everything(const PassState& state, const PreparedDraw& list, P& program) {
    Drawn drawn;
    auto sink = [&](FragmentBatch& batch) {
        Outputs& out = start_batch(batch);
        if (source_ != Source::record) shade(list, batch, out);
        show(Stage::shaded, state, batch, out, out.alive);
        load(state, batch);
        run_program(state, program, batch, out);
        show(Stage::program, state, batch, out, out.alive);
        finish(state, batch, out, drawn);
    };
    open_cache(state);
    for_each_batch(list, state, rasterizer::BatchSink{sink});
    close_cache();
    tell_alteration(PassKind::geometry, drawn);
    show({.step = Step::geometry, .state = &state, .passed = drawn.passed.own_, .tallied = drawn.tallied.own_});
    return drawn;
}

template <FragmentProgram P>
Drawn Region::draw_visits(const PassState& state, P& program) {
    books_.taken.reads_record = true;
    const bool is_routed = state.selection.keeps == Keeps::arrivals;
    if (is_routed) route_arrivals(state);
    open_cache(state);
    Drawn drawn;
    PassState drawn_to = state;
    while (FragmentBatch* const batch = next_visit(state)) {
        Outputs& out = start_batch(*batch);
        load(state, *batch);
        run_program(state, program, *batch, out);
        if (is_routed) drawn_to.sample_mask = static_cast<std::uint8_t>(1u << wave_);
        finish(drawn_to, *batch, out, drawn);
    }
    close_cache();
    if (is_routed) finish_arrivals(state);
    if (state.selection.outside == Outside::writes_alike)
        drawn.passed.own_ = recorded();  // what lies outside passes, too
    return drawn;
}

// Both ways from the same targets. What is kept is the outcome of visiting everything, the definition. A program that
// writes elsewhere than to its outputs does so twice.
template <class Quick, class Definition>
Drawn Region::checked(const Quick& quick, const Definition& definition) {
    Snapshot taken = snapshot();
    const Count quick_passed = quick().passed;
    restore(taken);  // and takes what the quick way left
    const Drawn drawn = definition();
    require_equal(taken, quick_passed, drawn.passed);
    return drawn;
}

template <FragmentProgram P>
Drawn Region::full_screen(const PassState& state, P&& program) {
    return alteration() != nullptr ? draw_screen(altered(state, PassKind::full_screen), program)
                                   : draw_screen(state, program);
}

template <FragmentProgram P>
Drawn Region::draw_screen(const PassState& state, P& program) {
    begin_pass(state, PassKind::full_screen);
    open_cache(state);
    Drawn drawn;
    FragmentBatch& batch = screen_batch();
    for (std::size_t next = 0; next_screen_batch(batch, next);) {
        Outputs& out = start_batch(batch);
        load(state, batch);
        run_program(state, program, batch, out);
        show(Stage::program, state, batch, out, out.alive);
        finish(state, batch, out, drawn);
    }
    close_cache();
    tell_alteration(PassKind::full_screen, drawn);
    show({.step = Step::full_screen, .state = &state, .passed = drawn.passed.own_, .tallied = drawn.tallied.own_});
    return drawn;
}

template <FragmentProgram P>
void Region::trace_pixels(Target read, P&& program) {
    if (!frame_.trace) return;
    kind_ = PassKind::full_screen;
    PassState state;
    state.reads[0] = read;
    const UncountedWork look{books_};
    FragmentBatch& batch = screen_batch();
    for (std::size_t next = 0; next_screen_batch(batch, next);) {
        Outputs& out = start_batch(batch);
        load(state, batch);
        program(static_cast<const FragmentBatch&>(batch), loads(), out);
        record_trace(batch, out, out.alive);
    }
}

template <class P>
void Region::run_program(const PassState& state, P& program, FragmentBatch& batch, Outputs& out) {
    const std::uint64_t before = alive_count(out, batch.count);
    const std::uint64_t tally = out.tally;
    const auto run = [&] { program(static_cast<const FragmentBatch&>(batch), loads(), out); };
    if (const Alteration* a = alteration(); a != nullptr && a->program)
        a->program({state, kind_, batch, loads(), out}, run);
    else
        run();
    if (out.replaces_depth) std::copy_n(out.depth.begin(), batch.count, batch.code.begin());
    tallied_ += out.tally - tally;
    if (kind_ != PassKind::geometry) return;
    count({.discarded = before - alive_count(out, batch.count)});
    count_visits(static_cast<std::uint64_t>(batch.count));
}

}  // namespace strata::pipeline
