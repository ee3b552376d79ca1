// pipeline/region/region_draw.h - the two templates of Region: a fragment program between the rasterizer and the fixed stages.
#pragma once
#include <algorithm>

#include "pipeline/region/region.h"

namespace strata::pipeline {

template <FragmentProgram P>
Drawn Region::draw_list(const PassState& state, const PreparedDraw& list, P& program) {
    begin_pass(state, PassKind::geometry);
    Drawn drawn;
    auto sink = [&](FragmentBatch& batch) {
        Outputs& out = start_batch(batch);
        shade_or_recall(list, batch, out);
        load(state, batch);
        run_program(program, batch, out);
        finish(state, batch, out, drawn);
    };
    for_each_batch(list, state, rasterizer::BatchSink{sink});
    return drawn;
}

template <FragmentProgram P>
Drawn Region::full_screen(const PassState& state, P&& program) {
    begin_pass(state, PassKind::full_screen);
    Drawn drawn;
    FragmentBatch& batch = screen_batch();
    for (std::size_t next = 0; next_screen_batch(batch, next);) {
        Outputs& out = start_batch(batch);
        load(state, batch);
        run_program(program, batch, out);
        finish(state, batch, out, drawn);
    }
    return drawn;
}

template <class P>
bool Region::look(const rasterizer::FragmentNeeds& needs, const rasterizer::Rect& band, P&& program) {
    counts_ = false;
    bool goes_on = true;
    auto sink = [&](FragmentBatch& batch) {
        if (!goes_on) return;
        Outputs& out = start_batch(batch);
        shade(*frame_.transparent, batch, out);
        goes_on = program(static_cast<const FragmentBatch&>(batch), static_cast<const Outputs&>(out));
    };
    rasterize_band(needs, band, rasterizer::BatchSink{sink}, goes_on);
    counts_ = true;
    return goes_on;
}

template <FragmentProgram P>
void Region::trace_pixels(Target read, P&& program) {
    if (!frame_.trace) return;
    kind_ = PassKind::full_screen;
    PassState state;
    state.reads[0] = read;
    const IterationRecord before = record();
    FragmentBatch& batch = screen_batch();
    for (std::size_t next = 0; next_screen_batch(batch, next);) {
        Outputs& out = start_batch(batch);
        load(state, batch);
        program(static_cast<const FragmentBatch&>(batch), loads(), out);
        record_trace(batch, out, out.alive);
    }
    record() = before;
}

template <class P>
void Region::run_program(P& program, FragmentBatch& batch, Outputs& out) {
    const std::uint64_t before = alive_count(out, batch.count);
    const std::uint64_t tally = out.tally;
    program(static_cast<const FragmentBatch&>(batch), loads(), out);
    if (out.replaces_depth) std::copy_n(out.depth.begin(), batch.count, batch.code.begin());
    tallied_ += out.tally - tally;
    if (kind_ == PassKind::geometry) record().counters.discarded += before - alive_count(out, batch.count);
}

}  // namespace strata::pipeline
