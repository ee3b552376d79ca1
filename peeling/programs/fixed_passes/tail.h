// peeling/programs/fixed_passes/tail.h - the tail: how an algorithm that composites only some fragments of a pixel in
// order shows the others, which are behind them.
//
// Rule     none: the tail is not shown. blend: its fragments are blended OVER the colour behind them, usually the
//          opaque one, in submission order, in the frame's colour format. average: their colour is that of
//          weighted_average; weighted: that of weighted_blended. The sums of the last two are stored as halves, or as
//          binary32 if the frame's colour format is rgba32f.
// Source   peeling/reference/algorithms.md 21.3.
// Tests    tests/peeling/algorithms/atomic_loop_test.cpp
#pragma once
#include "peeling/programs/algorithm_options.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

// The render targets of a tail. An algorithm draws a pass with `state()` whose program calls `write`, and composites
// its ordered fragments over the target that `resolve()` returns.
class TailTargets {
  public:
    // `behind`: the colour behind the tail; by default the opaque colour.
    TailTargets(pipeline::Region& region, Tail tail, const ListingInputs& inputs, pipeline::Target behind = {});

    // The state of a pass over the visible fragments: those that its program keeps are added to the tail.
    [[nodiscard]] pipeline::PassState state() const;
    // Writes the outputs of all fragments of a batch; the program discards those that do not belong to the tail.
    void write(const pipeline::FragmentBatch& in, pipeline::Outputs& out) const;
    // The colour behind everything else: the tail over the colour behind it, in the frame's colour format.
    [[nodiscard]] pipeline::Target resolve();

  private:
    pipeline::Region& region_;
    Tail tail_;
    ListingInputs inputs_;
    pipeline::Target behind_{};
    pipeline::Target color_{}, sums_{}, other_{};  // the colour onto which the tail is blended; the sums; and the count
                                                   // (average) or revealage (weighted)
};

}  // namespace strata::peeling
