// peeling/programs/fixed_passes/tail.h - what is shown of the fragments behind those that are composited in order.
//
// Rule     none: nothing. blend: OVER onto what lies behind, as they come. average: as weighted_average. weighted: as
//          weighted_blended. Targets are halves, or binary32 where the frame's colour is; the blend is in the frame's
//          colour format.
// Source   algorithms.md 21.3.
// Tests    tests/peeling/algorithms/atomic_loop_test.cpp
#pragma once
#include "peeling/programs/algorithm_options.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

// The targets of one tail: an algorithm draws its pass with `state`, has its program write what `write` says, and
// composites over `resolve`.
class TailTargets {
  public:
    TailTargets(pipeline::Region& region, Tail tail, const ListingInputs& inputs);

    // A pass over what is visible that adds what its program keeps.
    [[nodiscard]] pipeline::PassState state() const;
    // The outputs of a whole batch; its program discards what is not of the tail.
    void write(const pipeline::FragmentBatch& in, pipeline::Outputs& out) const;
    // The colour behind everything else: the tail over the opaque colour, in the frame's colour format.
    [[nodiscard]] pipeline::Target resolve();

  private:
    pipeline::Region& region_;
    Tail tail_;
    ListingInputs inputs_;
    pipeline::Target color_{}, sums_{}, other_{};  // what is blended onto; or sums, and a count or revealage
};

}  // namespace strata::peeling
