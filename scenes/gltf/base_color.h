// scenes/gltf/base_color.h - the members of a material that give its base colour and alpha.
//
// Rule     diffuseFactor and diffuseTexture of KHR_materials_pbrSpecularGlossiness where a material has that extension,
//          which replaces pbrMetallicRoughness; else baseColorFactor and baseColorTexture.
// Source   glTF 2.0, 3.9.2; KHR_materials_pbrSpecularGlossiness.
// Tests    tests/scenes/gltf/gltf_ways_out_test.cpp
#pragma once
#include <optional>

#include "scenes/gltf/document/json.h"

namespace strata::scenes {

struct BaseColor {
    std::optional<JsonAt> factor{}, texture{};
};

[[nodiscard]] inline BaseColor base_color_of(const JsonAt& material) {
    const auto extensions = material.find("extensions");
    if (const auto old = extensions ? extensions->find("KHR_materials_pbrSpecularGlossiness") : std::nullopt)
        return {old->find("diffuseFactor"), old->find("diffuseTexture")};
    const auto pbr = material.find("pbrMetallicRoughness");
    return pbr ? BaseColor{pbr->find("baseColorFactor"), pbr->find("baseColorTexture")} : BaseColor{};
}

}  // namespace strata::scenes
