// scenes/models/load_model_module.h - the model module, loaded when it is first needed (load_module.h).
#pragma once
#include "scenes/models/model_module.h"

namespace strata::scenes {

[[nodiscard]] const ModelModule& model_module();

}  // namespace strata::scenes
