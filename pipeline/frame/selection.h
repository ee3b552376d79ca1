// pipeline/frame/selection.h - which fragments a geometry pass looks at, as data: replay visits those alone, and counts the others.
//
// Rule     A selection is a promise about the pass's own state and program. At every pixel the *window* is a range of keys
//          (Frame::key) between bounds that targets hold there when the pass begins, and the pass keeps some fragments of the
//          window. The others leave every target as it is: those of the window because the kept ones decide alone, those outside
//          because the machine drops them at the stage that `outside` names. The program looks at no primitive's number. `Instruments::check_selections` visits every
//          fragment, too, and compares.
// Source   execution.md 7.1.
// Tests    tests/peeling/selection_test.cpp, execution_test.cpp
#pragma once
#include <cstdint>
#include <optional>

#include "pipeline/stages/depth_compare.h"
#include "pipeline/stages/target_handle.h"

namespace strata::pipeline {

// The fragments of its window that decide what a pass leaves at a pixel.
enum class Keeps : std::uint8_t {
    everything,  // no selection: every fragment is visited
    nearest,   // the first arrival of the least key, by a depth test LESS with a write and without blending; a stencil
               // that every update increments is set to what they leave
    last_two,  // as nearest, with blending that the last two updates decide
    previous,  // the update before the nearest's: by a stencil that holds how many there are, up to 255, and that each of
               // a second walk decrements down to 1
    window,    // all of the window, in the order of arrival, whatever the tests
    arrivals,  // from number `first_arrival` of the window on, in the order of arrival, one for each sample: by a
               // stencil test that all of the window count down and only those meet
    run,  // the window's first arrivals while each is farther than the one before, and what ends them: by a stencil that counts to
          // 128 and that a depth test GREATER inverts where it fails
    nearest_after,  // the nearest of the window but for its first arrivals, which fill a stencil up to 255
    last_run,  // of updates below `before`, the last two; between them the last of those that arrive in order, what arrives
    // out of order, and the nearest that arrives later; and all one key before the window: for registers that
    // a program reads and writes, beside colours that the others blend with (0, 0, 0, 0) UNDER
    ends  // the window's first and last key, all arrivals, and the nearest and farthest between: for MAX of (-z, z)
};

// The stage at which a fragment outside the window ends.
enum class Outside : std::uint8_t {
    discarded,    // by the program
    alpha_test,   // its alpha becomes 0; within the window it is the fragment's own
    depth_unit,   // by the first depth unit
    nothing_new,  // at the targets: what it writes they hold already, under an idempotent blend
    one_value  // at the targets: under MAX every such fragment writes one value a pixel, which only one needs to write
};

struct FragmentSelection {
    Keeps keeps = Keeps::everything;
    Outside outside = Outside::discarded;
    Target behind{};                 // depth target: keys greater than its code
    Target from{};                   // depth target: keys not less than its code
    Target at{};                     // depth target: keys equal to its code
    Target before{}, also_before{};  // depth targets: keys less than their codes
    Target up_to{};                  // depth target: keys not greater than its code
    Target range{};                  // float target: keys from minus its red to its green, both included
    struct Channel {                 // of a float target, which holds values of stored codes
        Target target{};
        int channel = 0;
        friend bool operator==(const Channel&, const Channel&) = default;
    };
    Channel behind_value{}, before_value{};  // keys with a greater and with a lesser value
    std::uint32_t least = 0, most = ~0u;     // keys, both included
    std::uint32_t first_arrival = 0;
    // What the pass leaves of a kept fragment follows from its key: of `nearest` the depth alone; of `ends` what lies between is
    // (-z, z) in color[0], of two binary32 channels under MAX, and the program looks at no colour there.
    bool keys_suffice = false;
    // Of nearest and ends: `behind` or `range` bounds the depth that this compares, and no key; the program looks at no other. Of
    // nearest it asks no more than whether that depth lies behind the bound.
    std::optional<DepthCompare> compared{};
    // Of nearest: at a pixel where `behind` and the depth target hold what they held before the pass that went before, it writes what that
    // one wrote. Its program tallies nothing.
    bool repeats = false;
    friend bool operator==(const FragmentSelection&, const FragmentSelection&) = default;
};

}  // namespace strata::pipeline
