// tools/oracle/pack/state_json.h - reads and writes the object "state" of a pack, which contains the options.
//
// Rule     tools/oracle/PACK.md. Options that do not change bits (threads, tiles, execution) are omitted; those that a
//          pack cannot represent (clip planes, a second list, a window origin) throw InputError when it is written.
// Tests    tests/tools/oracle/golden_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "peeling/render_options.h"

namespace strata::oracle {

[[nodiscard]] nlohmann::ordered_json state_json(const peeling::RenderOptions& options);
// `file` is the manifest's name for errors. The raster conventions are those of packs.
[[nodiscard]] peeling::RenderOptions read_state(const nlohmann::json& manifest, const std::string& file);

}  // namespace strata::oracle
