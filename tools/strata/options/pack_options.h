// tools/strata/options/pack_options.h - a golden pack as the SCENE of a command: the pack's state replaces options that
// are not given.
#pragma once
#include <string>

#include "tools/strata/options/options.h"

namespace strata::tools {

// Copies size, formats, orders, colour space and profile of the pack to `options`; does nothing if the scene is not a
// pack. Called when SCENE is parsed, before the options that override these fields.
void take_pack_state(RunOptions& options, const std::string& scene);

}  // namespace strata::tools
