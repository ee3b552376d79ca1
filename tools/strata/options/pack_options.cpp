#include "tools/strata/options/pack_options.h"

#include "scenes/files/profile_json.h"
#include "scenes/packs/pack_scene.h"
#include "scenes/read_files.h"
#include "tools/oracle/pack/state_json.h"
#include "tools/request/complete.h"

namespace strata::tools {

void take_pack_state(RunOptions& options, const std::string& scene) {
    if (scenes::is_procedural(scene) || !scenes::is_pack(scene)) return;
    const std::string folder = scenes::pack_folder(scene);
    scenes::note_read_pack(folder);
    const nlohmann::json manifest = scenes::read_manifest(folder);
    options.profile = scenes::pack_profile(folder);
    static_cast<PictureRequest&>(options) =
        request_of(oracle::read_state(manifest, folder + "/manifest.json", scenes::load_profile(options.profile)));
    options.scene_options.color_space = scenes::color_space_of(folder, manifest);
    options.pack_convention = scenes::view_convention(options.render.raster);
}

}  // namespace strata::tools
