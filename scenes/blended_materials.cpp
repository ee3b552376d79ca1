// scenes/blended_materials.cpp - makes the named materials of a draw list transparent (blended_materials.h).
#include "scenes/blended_materials.h"

#include "rasterizer/base/input_error.h"
#include "scenes/nearest_name.h"

namespace strata::scenes {

void blend_materials(pipeline::DrawList& list, std::span<const MaterialAlpha> wanted, const std::string& spec) {
    for (const MaterialAlpha& one : wanted) {
        std::vector<std::string_view> names;
        bool is_found = false;
        for (pipeline::Material& material : list.materials) {
            names.push_back(material.name);
            if (material.name != one.material) continue;
            is_found = true;
            if (material.alpha_mode == pipeline::AlphaMode::mask)
                throw InputError(spec, "--alpha", "a material whose alphaMode is OPAQUE or BLEND",
                                 "'" + one.material + "', whose alphaMode is MASK");
            material.alpha_mode = pipeline::AlphaMode::blend;
            material.front[3] *= one.alpha;
            material.back[3] *= one.alpha;
        }
        if (!is_found)
            throw InputError(spec, "--alpha", "a material of the scene (strata scene lists them)",
                             quoted_with_suggestion(one.material, names));
    }
}

}  // namespace strata::scenes
