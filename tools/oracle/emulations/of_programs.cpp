// tools/oracle/emulations/of_programs.cpp - mistakes in the inputs and outputs of fragment programs.
#include <algorithm>

#include "peeling/programs/min_max.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

using namespace pipeline;

// Calls change(in) for every batch of fragments before its program runs.
template <class Change>
bool before_programs(AlteredRun& e, Change change) {
    e.alterations.push_back({.program = [change](const ProgramCall& call, const std::function<void()>& run) {
        if (call.kind == pipeline::PassKind::geometry) change(call.in);
        run();
    }});
    return true;
}

// Calls change(names, call) after every program of this kind of pass.
template <class Change>
bool behind_programs(AlteredRun& e, pipeline::PassKind kind, Change change) {
    e.alterations.push_back(
        {.program = [names = e.names, kind, change](const ProgramCall& call, const std::function<void()>& run) {
            run();
            if (call.kind == kind) change(*names, call);
        }});
    return true;
}

std::size_t count_of(const ProgramCall& call) { return static_cast<std::size_t>(call.in.count); }

// True for the pass of dual peeling whose program blends the near fragments.
bool is_dual_peel(const Names& names, const PassState& state) { return names.is(state.color[2], "back_layer"); }
bool is_min_max_peel(const Names& names, const PassState& state) {
    return names.is(state.color[0], "min_max") && state.color[1].exists();
}

// Calls body(i) for the lanes at the near end of the peeled range.
template <class Body>
void for_near(const ProgramCall& call, Body body) {
    peeling::PeelLanes side;
    peeling::scalar::classify(call.in.shader_z, call.loads.color(0), call.loads.depth(2), side, count_of(call));
    for (std::size_t i = 0; i < count_of(call); ++i)
        if (side.is_near[i] != 0) body(i);
}

// True for the pass that blends the front over the colour behind it.
bool is_last_quad(const Names& names, const PassState& state) {
    return names.is(state.color[0], "result") &&
           (names.is(state.reads[0], "front") || names.is(state.reads[0], "accumulated"));
}

// True for a target whose colours should be premultiplied.
bool is_premultiplied(const Names& names, const PassState& state, std::size_t target) {
    const Blend& blend = state.blend[target];
    const bool is_sum = names.is(state.color[target], "sums");
    const bool is_under = blend.enabled && blend.color == blend_mode::under.color;
    return is_sum || is_under || (names.is(state.color[target], "layer") && names.is(state.depth_target, "nearest"));
}

void leave_straight(const Names& names, const ProgramCall& call) {
    if (is_dual_peel(names, call.state)) {
        for_near(call, [&](std::size_t i) {
            const float through = 1.0f - call.loads.color(1)[3][i];
            for (std::size_t c = 0; c < 3; ++c)
                call.out.color[1][c][i] = call.loads.color(1)[c][i] + through * call.in.color[c][i];
        });
        return;
    }
    for (std::size_t target = 0; target < call.state.color.size(); ++target) {
        if (!call.state.color[target].exists() || !is_premultiplied(names, call.state, target)) continue;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < count_of(call); ++i)
                if (call.out.color[target][3][i] != 0) call.out.color[target][c][i] = call.in.color[c][i];
    }
}

// Fragments at the depth that was peeled last are peeled again.
void peel_again(const Names& names, const ProgramCall& call) {
    if (is_min_max_peel(names, call.state)) {
        const bool is_dual = is_dual_peel(names, call.state);
        peeling::PeelLanes side;
        peeling::scalar::classify(call.in.shader_z, call.loads.color(0), call.loads.depth(is_dual ? 2 : 1), side,
                                  count_of(call));
        for (std::size_t i = 0; i < count_of(call); ++i) {
            if ((side.is_near[i] | side.is_far[i]) == 0) continue;
            call.out.color[0][0][i] = -call.in.shader_z[i];
            call.out.color[0][1][i] = call.in.shader_z[i];
        }
        return;
    }
    if (!call.state.depth.write || !call.state.reads[0].exists()) return;
    if (!names.is(call.state.reads[0], "nearest") && !names.is(call.state.reads[0], "layer")) return;
    for (std::size_t i = 0; i < count_of(call); ++i)
        if (call.in.code[i] == call.loads.depth(0)[i]) call.out.alive[i] = ~0u;
}

// In dual peeling's program; in other algorithms UNDER is blend state (of_steps.cpp).
void forget_transmittance(const Names& names, const ProgramCall& call) {
    if (!is_dual_peel(names, call.state)) return;
    for_near(call, [&](std::size_t i) {
        const float alpha = call.in.color[3][i];
        for (std::size_t c = 0; c < 3; ++c)
            call.out.color[1][c][i] = call.loads.color(1)[c][i] + alpha * call.in.color[c][i];
    });
}

// Blending multiplies the far layer of dual peeling by its alpha, so its colours must not be premultiplied.
void premultiply_far_layer(const Names& names, const ProgramCall& call) {
    if (!is_dual_peel(names, call.state)) return;
    auto& far = call.out.color[2];
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count_of(call); ++i) far[c][i] *= far[3][i];
}

// t = 1 - average alpha, as for a single fragment.
void average_without_power(const Names& names, const ProgramCall& call) {
    if (!names.is(call.state.reads[0], "sums") || !names.is(call.state.reads[1], "count")) return;
    const ColorLanes& sum = call.loads.color(0);
    const ColorLanes& behind = call.loads.color(2);
    for (std::size_t i = 0; i < count_of(call); ++i) {
        const float n = call.loads.color(1)[0][i];
        if (!(n > 0 && sum[3][i] > 0)) continue;
        const float through = 1.0f - sum[3][i] / n;
        for (std::size_t c = 0; c < 3; ++c)
            call.out.color[0][c][i] = sum[c][i] / sum[3][i] * (1.0f - through) + behind[c][i] * through;
    }
}

const Mistake program_mistakes[] = {
    {"premultiplied_twice", "colours multiplied by their alpha twice", ChangedPart::programs,
     [](AlteredRun& e) {
         return before_programs(e, [](FragmentBatch& in) {
             for (std::size_t c = 0; c < 3; ++c)
                 for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) in.color[c][i] *= in.color[3][i];
         });
     }},
    {"not_premultiplied", "colours not multiplied by their alpha", ChangedPart::programs,
     [](AlteredRun& e) { return behind_programs(e, pipeline::PassKind::geometry, leave_straight); }},
    {"far_layer_premultiplied",
     "dual peeling's far layer premultiplied, and multiplied by alpha again when it is blended", ChangedPart::programs,
     [](AlteredRun& e) { return behind_programs(e, pipeline::PassKind::geometry, premultiply_far_layer); }},
    {"alpha_squared", "alpha multiplied by itself", ChangedPart::programs,
     [](AlteredRun& e) {
         return before_programs(e, [](FragmentBatch& in) {
             for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) in.color[3][i] *= in.color[3][i];
         });
     }},
    {"alpha_inverted", "1 - alpha for alpha", ChangedPart::programs,
     [](AlteredRun& e) {
         return before_programs(e, [](FragmentBatch& in) {
             for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                 in.color[3][i] = 1.0f - in.color[3][i];
         });
     }},
    {"peels_again", "fragments at the peeled depth peeled again: <= for <", ChangedPart::programs,
     [](AlteredRun& e) { return behind_programs(e, pipeline::PassKind::geometry, peel_again); }},
    {"program_without_transmittance", "the front colour blended by the program without (1 - alpha) of the front",
     ChangedPart::programs,
     [](AlteredRun& e) { return behind_programs(e, pipeline::PassKind::geometry, forget_transmittance); }},
    {"average_without_power", "one fragment's transmittance for that of all: (1 - a) for (1 - a)^n",
     ChangedPart::programs,
     [](AlteredRun& e) { return behind_programs(e, pipeline::PassKind::full_screen, average_without_power); }},
    {"nothing_behind", "the last quad shows the front accumulator only, without the background", ChangedPart::programs,
     [](AlteredRun& e) {
         return behind_programs(e, pipeline::PassKind::full_screen, [](const Names& names, const ProgramCall& call) {
             if (!is_last_quad(names, call.state)) return;
             for (std::size_t c = 0; c < 3; ++c)
                 std::copy_n(call.loads.color(0)[c].begin(), count_of(call), call.out.color[0][c].begin());
         });
     }},
    {"alpha_left", "the front's own alpha left in the picture", ChangedPart::programs,
     [](AlteredRun& e) {
         return behind_programs(e, pipeline::PassKind::full_screen, [](const Names& names, const ProgramCall& call) {
             if (is_last_quad(names, call.state))
                 std::copy_n(call.loads.color(0)[3].begin(), count_of(call), call.out.color[0][3].begin());
         });
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_programs() { return program_mistakes; }

}  // namespace strata::oracle
