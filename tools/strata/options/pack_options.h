// tools/strata/options/pack_options.h - a pack as the SCENE of a command: its state stands for options that are not
// given.
#pragma once
#include <string>

#include "tools/strata/options/options.h"

namespace strata::tools {

// Size, formats, orders, colour space and profile of the pack become those of `options`; nothing for a scene that is no
// pack. It is called when SCENE is parsed, before the options that change what it sets.
void take_pack_state(RunOptions& options, const std::string& scene);

}  // namespace strata::tools
