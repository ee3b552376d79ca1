// scenes/gltf/material.h - converts glTF materials and textures to pipeline materials in the frame's colour space.
//
// Rule     Factors are linear in glTF: r g b are encoded to sRGB once (encoded) or kept (linear); alpha is never
//          encoded. Texture codes are unchanged; a linear frame decodes them. OPAQUE means alpha 1 in factor, vertex
//          colour and every texel, whatever the file contains. A material is unlit if it or SceneOptions says so. Wrap
//          modes and the magnification filter come from the sampler (default: repeat, linear); the minification filter
//          is ignored.
// Source   glTF 2.0, 3.8.4 (samplers), 3.9.2, 3.9.4 (alpha coverage); KHR_materials_unlit; scenes/reference/scenes.md
//          10.4 and 10.5.
// Tests    tests/scenes/gltf/gltf_material_test.cpp
#pragma once
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "scenes/gltf/document/buffers.h"
#include "scenes/gltf/document/warnings.h"
#include "scenes/gltf/model.h"
#include "scenes/scene.h"

namespace strata::scenes {

// KHR_texture_transform: u' = ou + (cos (su u) + sin (sv v)), v' = ov + (cos (sv v) - sin (su u)): counterclockwise as
// seen with v downwards, as in the extension's worked example and in Khronos' viewer (the matrix printed in its README
// is the transpose).
struct TextureTransform {
    double offset_u = 0, offset_v = 0, cosine = 1, sine = 0, scale_u = 1, scale_v = 1;
    [[nodiscard]] pipeline::Vec2 apply(pipeline::Vec2 uv) const noexcept;
};

struct LoadedMaterial {
    std::uint32_t index = 0;  // in DrawList::materials
    bool is_opaque = true, is_unlit = false;
    std::optional<int> texcoord_set;            // of the base colour texture, if there is one
    std::optional<TextureTransform> transform;  // of the base colour texture
};

class Materials {
  public:
    struct Context {
        const Document& document;
        const tinygltf::Model& model;
        Buffers& buffers;
        Budget& budget;
        Warnings& warnings;
        const SceneOptions& options;
        pipeline::DrawList& list;
        std::vector<OpaqueWithAlpha>& opaque_with_alpha;
    };
    explicit Materials(const Context& context) : c_{context} {}

    // A material is added to the draw list on first use, so unused ones cost nothing.
    const LoadedMaterial& operator[](int material);  // -1: glTF's default material
    // Notes an alpha below 1 that an opaque material ignores.
    void note_alpha(const LoadedMaterial& material, const std::string& of);

  private:
    [[nodiscard]] LoadedMaterial load(int material);
    void read(std::size_t material, pipeline::Material& made, LoadedMaterial& loaded);
    void warn_of_transmission(const JsonAt& extensions, const pipeline::Material& made);
    int texture(int texture, bool is_opaque);
    [[nodiscard]] pipeline::Texture load_texture(const tinygltf::Texture& texture, bool is_opaque);
    [[nodiscard]] std::vector<std::uint8_t> load_image(int image, pipeline::Texture& into);

    Context c_;
    std::map<int, LoadedMaterial> materials_;
    std::set<std::size_t> textures_with_alpha_;  // of those that were made opaque
    // Keyed by texture and opacity: an opaque material needs texels with alpha 1, so a shared texture may be loaded
    // twice.
    std::map<std::pair<int, bool>, int> textures_;
};

// Linear r g b of the file, converted to the frame's colour space and clamped to [0, 1].
[[nodiscard]] pipeline::Rgba frame_color(const pipeline::Rgba& linear, pipeline::ColorSpace space);

}  // namespace strata::scenes
