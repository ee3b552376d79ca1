// scenes/gltf/material.cpp - materials, textures and their conversion to the frame's colour space (material.h).
#include "scenes/gltf/material.h"

#include <fmt/format.h>

#include <algorithm>

#include "rasterizer/base/numerics.h"
#include "scenes/files/image_decode.h"
#include "scenes/gltf/base_color.h"
#include "scenes/gltf/document/uri.h"
#include "scenes/numbers/elementary.h"
#include "scenes/numbers/srgb_encode.h"

namespace strata::scenes {
namespace {

using pipeline::AlphaMode;

// An absent mode has been set to OPAQUE, glTF's default.
AlphaMode alpha_mode(const std::string& name) {
    if (name == "MASK") return AlphaMode::mask;
    return name == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

pipeline::TextureWrap wrap(int code) {
    if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return pipeline::TextureWrap::clamp_to_edge;
    return code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? pipeline::TextureWrap::mirrored_repeat
                                                         : pipeline::TextureWrap::repeat;
}

// From the checked JSON: tinygltf stores whole numbers of extensions as int, which would truncate large ones.
std::optional<TextureTransform> texture_transform(const JsonAt& info) {
    const auto extensions = info.find("extensions");
    const auto at = extensions ? extensions->find("KHR_texture_transform") : std::nullopt;
    if (!at) return std::nullopt;
    TextureTransform t;
    if (const auto offset = at->find("offset")) t.offset_u = offset->json()[0], t.offset_v = offset->json()[1];
    if (const auto scale = at->find("scale")) t.scale_u = scale->json()[0], t.scale_v = scale->json()[1];
    if (const auto rotation = at->find("rotation"))
        t.cosine = cos(rotation->number()), t.sine = sin(rotation->number());
    return t;
}

// The transform may name its own texture coordinate set, which overrides the texture's (KHR_texture_transform).
int texcoord_set(const JsonAt& info) {
    const auto extensions = info.find("extensions");
    const auto transform = extensions ? extensions->find("KHR_texture_transform") : std::nullopt;
    const auto replaced = transform ? transform->find("texCoord") : std::nullopt;
    return replaced ? replaced->json().get<int>() : info.json().value("texCoord", 0);
}

// Every fourth code is an alpha. Returns whether one was below 1.
bool make_opaque(std::vector<std::uint8_t>& texels) {
    bool had_alpha = false;
    for (std::size_t i = 3; i < texels.size(); i += 4) had_alpha |= std::exchange(texels[i], std::uint8_t{255}) < 255;
    return had_alpha;
}

}  // namespace

pipeline::Vec2 TextureTransform::apply(pipeline::Vec2 uv) const noexcept {
    const double u = scale_u * double{uv[0]}, v = scale_v * double{uv[1]};
    return {static_cast<float>(offset_u + (cosine * u + sine * v)),
            static_cast<float>(offset_v + (cosine * v - sine * u))};
}

pipeline::Rgba frame_color(const pipeline::Rgba& linear, pipeline::ColorSpace space) {
    pipeline::Rgba color = linear;
    for (std::size_t c = 0; c < 4; ++c) color[c] = std::clamp(color[c], 0.0f, 1.0f);
    return from_linear(color, space);
}

const LoadedMaterial& Materials::operator[](int material) {
    const auto found = materials_.find(material);
    return found != materials_.end() ? found->second : materials_.emplace(material, load(material)).first->second;
}

LoadedMaterial Materials::load(int material) {
    LoadedMaterial loaded;
    pipeline::Material made;
    made.name = "default";
    if (material >= 0) read(static_cast<std::size_t>(material), made, loaded);
    loaded.is_opaque = made.alpha_mode == AlphaMode::opaque;
    // glTF 2.0, 3.9.4: OPAQUE ignores alpha wherever it comes from.
    const bool loses_factor = loaded.is_opaque && made.front[3] < 1;
    const bool loses_texture =
        loaded.is_opaque && made.texture >= 0 && textures_with_alpha_.contains(static_cast<std::size_t>(made.texture));
    if (loaded.is_opaque) made.front[3] = 1;
    made.front = made.back = frame_color(made.front, c_.options.color_space);
    loaded.is_unlit = made.unlit = made.unlit || !c_.options.light;
    loaded.index = static_cast<std::uint32_t>(c_.list.materials.size());
    c_.list.materials.push_back(std::move(made));
    if (loses_factor) note_alpha(loaded, "factor");
    if (loses_texture) note_alpha(loaded, "texture");
    return loaded;
}

void Materials::note_alpha(const LoadedMaterial& material, const std::string& of) {
    OpaqueWithAlpha note{c_.list.materials[material.index].name, of};
    auto& notes = c_.opaque_with_alpha;
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
}

void Materials::read(std::size_t material, pipeline::Material& made, LoadedMaterial& loaded) {
    const tinygltf::Material& m = c_.model.materials[material];
    made.name = m.name.empty() ? "material " + std::to_string(material) : m.name;
    made.alpha_mode = alpha_mode(m.alphaMode);
    made.alpha_cutoff = static_cast<float>(std::min(m.alphaCutoff, 2.0));  // with a cutoff above 1 nothing passes
    made.double_sided = m.doubleSided;
    const JsonAt at = c_.document.at("materials", material);
    const BaseColor base = base_color_of(at);
    for (std::size_t i = 0; i < 4; ++i)
        made.front[i] = base.factor ? static_cast<float>(base.factor->json()[i].get<double>()) : 1.0f;
    // Neither vertex colours nor textures can raise the material's alpha.
    if (made.alpha_mode == AlphaMode::mask && made.front[3] < made.alpha_cutoff)
        c_.warnings.add(at.location().pointer, "its alpha is below its cutoff: nothing of it is drawn");
    if (made.alpha_mode == AlphaMode::blend && made.front[3] == 0)
        c_.warnings.add(at.location().pointer,
                        "its alpha is 0: nothing of it is seen, but its fragments are peeled as layers");
    const auto extensions = at.find("extensions");
    if (extensions) warn_of_transmission(*extensions, made);
    made.unlit = extensions && extensions->has("KHR_materials_unlit");
    if (!base.texture) return;
    made.texture = texture(base.texture->member("index").json().get<int>(), made.alpha_mode == AlphaMode::opaque);
    loaded.texcoord_set = texcoord_set(*base.texture);
    loaded.transform = texture_transform(*base.texture);
}

// Transmission lets light through without blending and is not alpha: the material is drawn with its alpha mode.
void Materials::warn_of_transmission(const JsonAt& extensions, const pipeline::Material& made) {
    const auto transmission = extensions.find("KHR_materials_transmission");
    const auto factor = transmission ? transmission->find("transmissionFactor") : std::nullopt;
    if (!factor || !factor->json().is_number() || !(factor->number() > 0)) return;
    const double through = std::min(factor->number(), 1.0);
    const std::string option = fmt::format("{}={:.2g}", made.name, std::max(1 - through, 0.05));
    c_.warnings.add(
        transmission->location().pointer,
        fmt::format(
            "{} transmits {:.3g} of the light (KHR_materials_transmission), which is not drawn; --alpha {} draws "
            "that material alone blended",
            in_quotes(made.name), through, option.find(' ') == option.npos ? option : in_quotes(option)));
}

int Materials::texture(int texture, bool is_opaque) {
    const auto [known, is_new] =
        textures_.emplace(std::pair{texture, is_opaque}, static_cast<int>(c_.list.textures.size()));
    if (is_new)
        c_.list.textures.push_back(load_texture(c_.model.textures[static_cast<std::size_t>(texture)], is_opaque));
    return known->second;
}

pipeline::Texture Materials::load_texture(const tinygltf::Texture& texture, bool is_opaque) {
    pipeline::Texture made;
    made.name = texture.name;
    if (texture.sampler >= 0) {
        const tinygltf::Sampler& s = c_.model.samplers[static_cast<std::size_t>(texture.sampler)];
        made.wrap_s = wrap(s.wrapS);
        made.wrap_t = wrap(s.wrapT);
        if (s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) made.filter = pipeline::TextureFilter::nearest;
        if (s.minFilter > TINYGLTF_TEXTURE_FILTER_LINEAR)
            c_.warnings.add("/samplers/" + std::to_string(texture.sampler) + "/minFilter",
                            "mip levels are not emulated: magFilter is used");
    }
    // In an encoded frame texels are used as stored; in a linear one the sampler decodes them first.
    made.decode_srgb = c_.options.color_space == pipeline::ColorSpace::linear;
    made.texels = load_image(texture.source, made);
    if (is_opaque && make_opaque(made.texels)) textures_with_alpha_.insert(c_.list.textures.size());
    return made;
}

std::vector<std::uint8_t> Materials::load_image(int image, pipeline::Texture& into) {
    const JsonAt at = c_.document.at("images", static_cast<std::size_t>(image));
    if (const auto name = at.find("name"); name && into.name.empty()) into.name = name->string();
    const auto uri = at.find("uri");
    // A uri's bytes are kept here until they are decoded; a view's remain in the buffer.
    const Resource held =
        uri ? read_uri(uri->json().get_ref<const std::string&>(), c_.document.folder, uri->location()) : Resource{};
    const Bytes bytes =
        uri ? Bytes{held.bytes} : c_.buffers.view(at.member("bufferView").index(c_.model.bufferViews.size()));
    const FileLocation location = uri ? uri->location() : at.location();
    const ImageHeader header = read_image_header(bytes, location);
    const std::string found = header.kind == ImageKind::png ? "image/png" : "image/jpeg";
    const auto media_type = at.find("mimeType");
    // The image's mimeType and the type of a data: uri must both agree with the bytes.
    for (const std::string& said :
         {media_type ? media_type->string() : found, held.media_type.empty() ? found : held.media_type})
        if (said != found) location.fail("IMAGE_MIME_TYPE_INVALID", "data of type " + in_quotes(said), found);
    // Charged by the header's size, before the decoder allocates memory.
    c_.budget.pay_texels(std::uint64_t{header.width} * header.height, location);
    into.width = static_cast<int>(header.width);
    into.height = static_cast<int>(header.height);
    return decode_image(bytes, header, location);
}

}  // namespace strata::scenes
