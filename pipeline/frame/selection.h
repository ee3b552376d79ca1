// pipeline/frame/selection.h - the fragments that a geometry pass needs, as data: tiles visit only those.
//
// Rule     A selection is a promise about the pass's own state and program. At every pixel the *interval* is a range of
//          keys (Frame::key) between bounds stored in targets when the pass begins, and the pass keeps some fragments
//          of the interval. The others leave every target unchanged: those of the interval because the kept ones alone
//          decide the result, those outside because they die or write the stored values. The program tallies nothing
//          outside, and uses primitive indices only where the pass keeps all ties at the depths that it takes (`group`,
//          `ends`, `interval`). `Instruments::check_selections` also visits every fragment
//          and compares.
// Source   pipeline/reference/execution.md 7.1.
// Tests    tests/peeling/execution/selection_test.cpp, execution_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "pipeline/stages/depth_compare.h"
#include "pipeline/stages/target_handle.h"

namespace strata::pipeline {

// The fragments of its interval that decide the result of a pass at a pixel.
enum class KeptFragments : std::uint8_t {
    everything,  // no selection: every fragment is visited
    nearest,     // the first submitted with the least key: for a depth test LESS with a write, no blending, no stencil
    group,       // all with the first key, and the first behind them: for MAX of -z
    interval,    // all of the interval, in submission order, for any tests
    ends,        // the first and last key with ties, and the nearest and farthest between: for MAX of (-z, z)
    submitted    // from index `first_submitted` of the interval on, in submission order, one per sample: for a stencil
                 // test that all fragments of the interval count down and that no others reach
};

// The effect of a fragment outside the interval.
enum class Outside : std::uint8_t {
    dies,         // killed by the program, by the alpha test or by a depth unit, before the tests
    writes_alike  // writes the same as every other fragment of its pixel outside the interval, with blends that keep it
};

// One end of an interval: the value of a target.
struct KeyBound {
    Target target{};
    bool includes = false;  // the key itself is in the interval
    int channel = -1;       // of a float target with values of stored codes; -1: a depth target
    [[nodiscard]] bool exists() const noexcept { return target.exists(); }
    [[nodiscard]] static constexpr KeyBound beyond(Target target) noexcept { return {target}; }
    [[nodiscard]] static constexpr KeyBound at(Target target) noexcept { return {target, true}; }
    friend bool operator==(const KeyBound&, const KeyBound&) = default;
};
struct FragmentSelection {
    KeptFragments keeps = KeptFragments::everything;
    Outside outside = Outside::dies;
    KeyBound near{};                // keys greater than this
    std::array<KeyBound, 2> far{};  // keys less than each of these
    Target range{};                 // float target: keys from minus its red to its green, if it has one, both included
    std::uint32_t least = 0, most = ~0u;  // bounds of keys, both included
    std::uint32_t first_submitted = 0;
    // For nearest and ends: if set, `near` or `range` bounds the depth that this compares instead of the key.
    std::optional<DepthCompare> compared{};
    friend bool operator==(const FragmentSelection&, const FragmentSelection&) = default;
};

}  // namespace strata::pipeline
