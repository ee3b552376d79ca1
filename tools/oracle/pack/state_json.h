// tools/oracle/pack/state_json.h - reads and writes the object "state" of a pack, which contains the options.
//
// Rule     tools/oracle/pack/PACK.md. Options that do not change bits (threads, tiles, execution) are omitted; those
//          that a pack cannot represent (clip planes, a second list, a window origin) throw InputError when it is
//          written.
// Tests    tests/tools/oracle/pack/golden_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "peeling/render_options.h"
#include "pipeline/device/profile.h"

namespace strata::oracle {

// The raster conventions are those of packs. The profile is the pack's: a state of several samples contains their
// positions.
[[nodiscard]] nlohmann::ordered_json state_json(const peeling::RenderOptions& options,
                                                const pipeline::DeviceProfile& profile);
// `file` is the manifest's name for errors.
[[nodiscard]] peeling::RenderOptions read_state(const nlohmann::json& manifest, const std::string& file,
                                                const pipeline::DeviceProfile& profile);

}  // namespace strata::oracle
