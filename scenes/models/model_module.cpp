// scenes/models/model_module.cpp - the one symbol that the module exports.
#include "scenes/models/model_module.h"

#include "scenes/models/assimp_load.h"

extern "C" __attribute__((visibility("default"))) const strata::scenes::ModelModule* strata_model_module() {
    using namespace strata::scenes;
    static const ModelModule module{.version = STRATA_VERSION, .load = models::load};
    return &module;
}
