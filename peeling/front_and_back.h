// peeling/front_and_back.h - the end of dual peeling: what its passes and its closed form share.
#pragma once
#include "pipeline/region.h"

namespace strata::peeling {

// Publishes front over back, alpha 1; the front's alpha is 1 - transmittance (algorithms.md 5).
void publish_front_and_back(pipeline::Region& region, pipeline::Target front, pipeline::Target back);

}  // namespace strata::peeling
