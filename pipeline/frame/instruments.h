// pipeline/frame/instruments.h - what a caller may add to a run in order to measure or check it. Result bits, counters
// and pass counts do not depend on it, except for an alteration, whose purpose is to change them. Most runs have no
// instruments.
#pragma once
#include <cstdint>

namespace strata::pipeline {

// Effects that a pass can be made to simulate although no state needs them: values of its fragments, and stages with a
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
    Effect once_more = Effect::none;  // simulated in addition to what passes need, without replay, to measure its cost
    bool log_passes = false;          // fill FrameResult::pass_log
    bool check_selections = false;    // also visit every fragment, and throw std::logic_error if a selection is wrong
    bool trust_idle = true;  // false: treat every algorithm as if it promised Idle::no, which finds broken promises
    const Observer* observer = nullptr;      // is notified of every step; the run is then literal
    const Alteration* alteration = nullptr;  // deliberate mistakes in steps; the run is then literal
};

}  // namespace strata::pipeline
