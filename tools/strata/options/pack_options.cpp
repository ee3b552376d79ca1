#include "tools/strata/options/pack_options.h"

#include "scenes/files/profile_json.h"
#include "scenes/packs/pack_scene.h"
#include "scenes/read_files.h"
#include "tools/oracle/pack/state_json.h"

namespace strata::tools {

void take_pack_state(RunOptions& options, const std::string& scene) {
    if (scenes::is_procedural(scene) || !scenes::is_pack(scene)) return;
    const std::string folder = scenes::pack_folder(scene);
    scenes::note_read_pack(folder);
    const nlohmann::json manifest = scenes::read_manifest(folder);
    options.profile = scenes::pack_profile(folder);
    options.render = oracle::read_state(manifest, folder + "/manifest.json", scenes::load_profile(options.profile));
    options.sampling = options.render.sampling;
    options.shades_pixels =
        options.sampling.samples > 1 && options.render.raster.interpolation != rasterizer::Interpolation::sample;
    options.scene_options.color_space = scenes::color_space_of(folder, manifest);
    options.clip_depth = options.render.raster.clip_depth;
    options.depth_order = options.render.raster.depth_order;
    options.pack_convention = scenes::ClipConvention{*options.clip_depth, *options.depth_order};
}

}  // namespace strata::tools
