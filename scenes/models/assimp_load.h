// scenes/models/assimp_load.h - the function of the model module (rule: model_module.h).
#pragma once
#include "scenes/models/model_module.h"

namespace strata::scenes::models {

[[nodiscard]] LoadedModel load(const std::string& name, const ReadRelativeFile& read);

}  // namespace strata::scenes::models
