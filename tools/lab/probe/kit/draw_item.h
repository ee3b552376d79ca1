// tools/lab/probe/kit/draw_item.h - draws an item of a kit on the device of a profile.
//
// Rule     One region and one pass per draw, with the profile's own depth path. An item that needs a missing feature is
//          refused with a message.
// Tests    tests/tools/lab/probe/kit_test.cpp
#pragma once
#include "pipeline/device/profile.h"
#include "tools/lab/probe/kit/item.h"

namespace strata::probe {

[[nodiscard]] Reply draw_item(const pipeline::DeviceProfile& profile, const Item& item, YDirection y);

}  // namespace strata::probe
