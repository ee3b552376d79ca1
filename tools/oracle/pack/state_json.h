// tools/oracle/pack/state_json.h - the object "state" of a pack: all that options choose.
//
// Rule     tools/oracle/PACK.md. Options that leave every bit alone (threads, tiles, execution) are not in it; those
//          that a pack cannot hold (clip planes, a second list, a window's corner) throw InputError when it is written.
// Tests    tests/tools/oracle/golden_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "peeling/render_options.h"

namespace strata::oracle {

[[nodiscard]] nlohmann::ordered_json state_json(const peeling::RenderOptions& options);
// `file` is the manifest's name for errors. Raster conventions are those of the pack.
[[nodiscard]] peeling::RenderOptions read_state(const nlohmann::json& manifest, const std::string& file);

}  // namespace strata::oracle
