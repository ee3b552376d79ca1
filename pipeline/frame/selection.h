// pipeline/frame/selection.h - which fragments a geometry pass looks at, as data: tiles visit those alone.
//
// Rule     A selection is a promise about the pass's own state and program. At every pixel the *interval* is a range of
//          keys (Frame::key) between bounds that targets hold there when the pass begins, and the pass keeps some
//          fragments of the interval. The others leave every target as it is: those of the interval because the kept
//          ones decide alone, those outside because they die or write what is there. The program looks at no
//          primitive's number, and tallies nothing outside. `Instruments::check_selections` visits every fragment, too,
//          and compares.
// Source   execution.md 7.1.
// Tests    tests/peeling/selection_test.cpp, execution_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "pipeline/stages/depth_compare.h"
#include "pipeline/stages/target_handle.h"

namespace strata::pipeline {

// The fragments of its interval that decide what a pass leaves at a pixel.
enum class Keeps : std::uint8_t {
    everything,  // no selection: every fragment is visited
    nearest,   // the first submitted of the least key: by a depth test LESS with a write, without blending and stencil
    interval,  // all of the interval, in submission order, whatever the tests
    ends,      // the first and the last key, all of equal keys, and the nearest and farthest between: by MAX of (-z, z)
    submitted  // from number `first_submitted` of the interval on, in submission order, one for each sample: by a
               // stencil test that all of the interval count down and only those meet
};

// What a fragment outside the interval does.
enum class Outside : std::uint8_t {
    dies,         // by the program, by the alpha test or by a depth unit, before the tests
    writes_alike  // writes what any other of its pixel's outside the interval writes, under blends that keep it
};

// One end of an interval: what a target holds.
struct KeyBound {
    Target target{};
    bool includes = false;  // the key itself lies in the interval
    int channel = -1;       // of a float target that holds values of stored codes; else a depth target
    [[nodiscard]] bool exists() const noexcept { return target.exists(); }
    [[nodiscard]] static constexpr KeyBound beyond(Target target) noexcept { return {target}; }
    [[nodiscard]] static constexpr KeyBound at(Target target) noexcept { return {target, true}; }
    friend bool operator==(const KeyBound&, const KeyBound&) = default;
};
struct FragmentSelection {
    Keeps keeps = Keeps::everything;
    Outside outside = Outside::dies;
    KeyBound near{};                      // keys greater than it
    std::array<KeyBound, 2> far{};        // keys less than each
    Target range{};                       // float target: keys from minus its red to its green, both included
    std::uint32_t least = 0, most = ~0u;  // keys, both included
    std::uint32_t first_submitted = 0;
    // Of nearest and ends: `near` or `range` bounds the depth that this compares, and no key.
    std::optional<DepthCompare> compared{};
    friend bool operator==(const FragmentSelection&, const FragmentSelection&) = default;
};

}  // namespace strata::pipeline
