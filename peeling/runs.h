// peeling/runs.h - the bodies that the registry lists: each runs its algorithm over one region and publishes the final colour.
#pragma once
#include "pipeline/region.h"

namespace strata::peeling {

void unsorted(pipeline::Region& region);  // painter as well: the order of the list is all that differs
void depth_units(pipeline::Region& region);
void shadow_map(pipeline::Region& region);  // with whichever depth the frame stores
void front_to_back(pipeline::Region& region);
void dual(pipeline::Region& region);
void dual_independent(pipeline::Region& region);
void weighted_average(pipeline::Region& region);
void weighted_sum(pipeline::Region& region);
void a_buffer(pipeline::Region& region);

}  // namespace strata::peeling
