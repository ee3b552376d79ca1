// scenes/models/assimp_load.h - the module's own function; model_module.h states the rule.
#pragma once
#include "scenes/models/model_module.h"

namespace strata::scenes::models {

[[nodiscard]] LoadedModel load(const std::string& name, const ReadBeside& read);

}  // namespace strata::scenes::models
