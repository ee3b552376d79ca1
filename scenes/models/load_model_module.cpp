// scenes/models/load_model_module.cpp - loads the model module on first use (load_model_module.h).
#include "scenes/models/load_model_module.h"

#include "scenes/files/load_module.h"

namespace strata::scenes {

const ModelModule& model_module() {
    static constexpr ModuleFile file{STRATA_MODEL_MODULE, model_module_symbol, "load the model module",
                                     "OBJ, PLY, STL and OFF files need it; it is built where Assimp is installed "
                                     "(Debian: libassimp-dev)"};
    // Once per process and thread-safe; after a failure the next call tries again.
    static const ModelModule& module = [&]() -> const ModelModule& {
        const ModelModule& found = *reinterpret_cast<ModelModuleEntry>(module_function(file))();
        check_version(file, found.version);
        return found;
    }();
    return module;
}

}  // namespace strata::scenes
