// scenes/packs/pack_scene.h - the scene of a golden pack: buffers as stored, materials, textures, instances, light and
// view.
//
// Rule     tools/oracle/pack/PACK.md. Reading a written scene gives the same bits.
// Tests    tests/scenes/packs/pack_scene_test.cpp
#pragma once
#include <string>

#include "scenes/packs/json_fields.h"
#include "scenes/packs/pack_files.h"
#include "scenes/scene.h"

namespace strata::scenes {

inline constexpr int pack_version = 1;

// A folder with a manifest.json, or that file.
[[nodiscard]] bool is_pack(const std::string& path);
// The pack's folder.
[[nodiscard]] std::string pack_folder(const std::string& path);

// FOLDER/profile.json. InputError if it is missing or a link that leaves the folder.
[[nodiscard]] std::string pack_profile(const std::string& folder);

// manifest.json as a value. InputError if it is no manifest, or of an unknown version.
[[nodiscard]] nlohmann::json read_manifest(const std::string& folder);

// The manifest's objects "scene" and "view"; the arrays are added to `files`.
[[nodiscard]] nlohmann::ordered_json scene_json(const Scene& scene, pipeline::ColorSpace space, PackFiles& files);
[[nodiscard]] nlohmann::ordered_json view_json(const pipeline::View& view);

// The scene, with the pack's view as its own_view.
[[nodiscard]] Scene read_pack_scene(const std::string& folder, const nlohmann::json& manifest);
[[nodiscard]] pipeline::ColorSpace color_space_of(const std::string& folder, const nlohmann::json& manifest);

// The implementation of load_scene for a pack: InputError if the options request another scene or another colour space.
[[nodiscard]] Scene load_pack(const std::string& path, const SceneOptions& options);

}  // namespace strata::scenes
