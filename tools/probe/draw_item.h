// tools/probe/draw_item.h - an item of a kit drawn by a device that is a profile.
//
// Rule     One region, one pass a draw, by the profile's own depth path. An item that the device lacks something for is
//          refused with a sentence.
// Tests    tests/tools/probe/kit_test.cpp
#pragma once
#include "pipeline/device/profile.h"
#include "tools/probe/item.h"

namespace strata::probe {

[[nodiscard]] Reply draw_item(const pipeline::DeviceProfile& profile, const Item& item, YDirection y);

}  // namespace strata::probe
