// pipeline/frame/check_pass.h - checks a pass against the device before its first fragment.
#pragma once
#include <vector>

#include "pipeline/device/check.h"
#include "pipeline/device/profile.h"
#include "pipeline/frame/pass.h"
#include "pipeline/stages/target_storage.h"

namespace strata::pipeline {

// Throws Refused (check.h) for state that the profile lacks, and std::logic_error for a pass that no device could run:
// targets of the wrong kind or with different sample counts, a feedback loop (a target read and written without
// ordered_rmw), a test without its target.
void check_pass(const DeviceProfile& profile, const PassState& state, const std::vector<TargetStorage>& targets);

}  // namespace strata::pipeline
