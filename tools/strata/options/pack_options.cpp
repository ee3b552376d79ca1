#include "tools/strata/options/pack_options.h"

#include "scenes/packs/pack_scene.h"
#include "tools/oracle/pack/state_json.h"

namespace strata::tools {

void take_pack_state(RunOptions& options, const std::string& scene) {
    if (scenes::is_procedural(scene) || !scenes::is_pack(scene)) return;
    const std::string folder = scenes::pack_folder(scene);
    const nlohmann::json manifest = scenes::read_manifest(folder);
    options.render = oracle::read_state(manifest, folder + "/manifest.json");
    options.profile = scenes::pack_profile(folder);
    options.scene_options.color_space = scenes::color_space_of(folder, manifest);
    options.clip_depth = options.render.raster.clip_depth;
    options.depth_order = options.render.raster.depth_order;
    options.pack_convention = scenes::ClipConvention{*options.clip_depth, *options.depth_order};
}

}  // namespace strata::tools
