// tests/fuzz/input_files.cpp - fuzzed inputs that are read from files: a pack's manifest with its arrays, and EXR
// files.
#include <cstdlib>
#include <fstream>
#include <string>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/device/profile.h"
#include "pipeline/formats/image.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "scenes/packs/pack_scene.h"
#include "tests/fuzz/inputs.h"
#include "tests/support/own_folder.h"

namespace strata::fuzz {

namespace {

// A folder that is deleted when the process ends.
const std::filesystem::path& folder() {
    static const test::OwnFolder own;
    static const std::filesystem::path path = own.path();
    return path;
}

void write(const std::filesystem::path& path, Bytes bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// The manifest of a small scene, whose arrays are written to `to`.
std::string manifest_beside_arrays(const std::filesystem::path& to) {
    const scenes::Scene scene = scenes::make_procedural("random:seed=3,triangles=4", {});
    scenes::PackFiles files{[&](const std::string& name, const std::string& bytes) {
        std::filesystem::create_directories((to / name).parent_path());
        std::ofstream(to / name, std::ios::binary) << bytes;
    }};
    nlohmann::ordered_json manifest{{"format", "strata-pack"}, {"version", scenes::pack_version}};
    manifest["scene"] = scenes::scene_json(scene, pipeline::ColorSpace::encoded, files);
    manifest["view"] = scenes::view_json({});
    manifest["files"] = files.list();
    return manifest.dump();
}

pipeline::Image image(int width, int height, pipeline::Format format) {
    pipeline::Image made{format, width, height};
    for (std::size_t i = 0; i < made.size(); ++i) made.codes[i] = static_cast<std::uint32_t>(i * 37 % 251);
    return made;
}

}  // namespace

void try_pack(Bytes bytes) {
    static const std::string arrays = manifest_beside_arrays(folder() / "pack");
    write(folder() / "pack/manifest.json", bytes);
    try {
        const scenes::Scene scene = scenes::load_pack((folder() / "pack").string(), {});
        const peeling::RenderOptions options{.width = 8, .height = 8, .max_passes = 4, .threads = 1};
        peeling::Renderer renderer{scene.list, *scene.own_view, *pipeline::find_profile("ideal"), options};
        static_cast<void>(renderer.render(*peeling::find_algorithm("front_to_back")));
    } catch (const InputError&) {
    } catch (const pipeline::Refused&) {
    }
}

void write_packs(const std::filesystem::path& to) {
    const std::string manifest = manifest_beside_arrays(folder() / "pack");
    write(to / "manifest", {reinterpret_cast<const std::uint8_t*>(manifest.data()), manifest.size()});
}

void try_exr(Bytes bytes) {
    const std::string path = (folder() / "given.exr").string();
    write(path, bytes);
    try {
        std::vector<std::string> told, read;
        for (const scenes::FileDigest& one : scenes::digests_of(path))
            if (one.format != "deep") told.push_back(one.digest);
        for (const scenes::FileImage& one : scenes::read_images(path)) read.push_back(pipeline::digest(one.image));
        require(told == read, "a file's digests are those of its targets");
    } catch (const InputError&) {
    }
    try {
        const scenes::DeepFragments deep = scenes::read_deep(path);
        require(deep.z.size() == deep.rgba.size(), "every fragment of a deep file has its colour");
    } catch (const InputError&) {
    }
}

void write_exrs(const std::filesystem::path& to) {
    using pipeline::Format;
    const auto put = [&](const char* name, const auto& write_it) {
        const std::string path = (folder() / "seed.exr").string();
        write_it(path);
        std::filesystem::rename(path, to / name);
    };
    const scenes::OutputColor plain{.color = image(5, 3, Format::rgba8), .depth = {}},
        half{.color = image(4, 2, Format::rgba16f), .depth = image(4, 2, Format::d24), .premultiplied = true};
    put("rgba8", [&](const std::string& path) { scenes::write_image(path, plain); });
    put("half_and_depth", [&](const std::string& path) { scenes::write_image(path, half); });
    put("layers", [&](const std::string& path) { scenes::write_layers(path, std::vector{half, half}); });
    put("deep", [&](const std::string& path) {
        scenes::write_deep(path,
                           {.width = 2,
                            .height = 1,
                            .count = {1, 2},
                            .depth_code = {1, 2, 3},
                            .z = {0, 0.5f, 1},
                            .rgba = {{}, {}, {}},
                            .primitive = {0, 1, 2}},
                           {});
    });
}

}  // namespace strata::fuzz
