// peeling/algorithms/runs.h - the bodies that the registry lists: each runs its algorithm over one region and publishes the final colour.
#pragma once
#include "pipeline/region/region.h"

namespace strata::peeling {

// Sections 1 to 17 of algorithms.md have the steps of each, and the head of its file needs, passes and invariant.
void unsorted(pipeline::Region& region);  // painter as well: the order of the list is all that differs
void depth_units(pipeline::Region& region);
void shadow_map(pipeline::Region& region);  // with whichever depth the frame stores
void front_to_back(pipeline::Region& region);
void dual(pipeline::Region& region);
void dual_independent(pipeline::Region& region);
void weighted_average(pipeline::Region& region);
void weighted_sum(pipeline::Region& region);
void layer_peel(pipeline::Region& region);
void hybrid(pipeline::Region& region);
void coherent_stencil(pipeline::Region& region);
void coherent_blend(pipeline::Region& region);
void coherent_ideal(pipeline::Region& region);
void stencil_routed_k_buffer(pipeline::Region& region);
void k_buffer(pipeline::Region& region);
void batched(pipeline::Region& region);
void object_sorted(pipeline::Region& region);
void a_buffer(pipeline::Region& region);

}  // namespace strata::peeling
