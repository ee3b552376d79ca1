// pipeline/frame/instruments.h - what a caller may add to a run in order to measure or to check it. No result bit,
// counter or pass count depends on it, but for an alteration, whose purpose that is; a run without instruments is the
// usual one.
#pragma once
#include <cstdint>

namespace strata::pipeline {

// Effects that a pass can be made to simulate though no state needs them: values of its fragments, and stages with a
// state that changes nothing.
enum class Effect : std::uint8_t {
    none,
    color,
    texcoord,
    shader_z,
    code,
    facing,
    loads,
    alpha_test,
    stencil_test,
    depth_test,
    blending
};

struct Observer;    // pipeline/frame/observer.h
struct Alteration;  // pipeline/frame/alteration.h

struct Instruments {
    Effect once_more =
        Effect::none;         // simulated once more than the state asks for, and never replayed: its cost can be timed
    bool log_passes = false;  // fill FrameResult::pass_log
    bool check_selections =
        false;               // visit every fragment, too, and throw std::logic_error where a selection promised wrongly
    bool trust_idle = true;  // false: as if every algorithm promised Idle::no; finds promises that are not kept
    const Observer* observer = nullptr;      // sees every step; the run is then literal
    const Alteration* alteration = nullptr;  // changes steps: a deliberate mistake; the run is then literal
};

}  // namespace strata::pipeline
