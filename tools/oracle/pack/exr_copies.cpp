#include "tools/oracle/pack/exr_copies.h"

#include <fmt/format.h>

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/pack/pack_pictures.h"
#include "tools/oracle/pack/target_json.h"
#include "tools/oracle/passes/target_parts.h"

namespace strata::oracle {

namespace {

using nlohmann::json;

constexpr std::string_view top = "expected/", ending = ".exr";

pipeline::Image image_of(const std::string& folder, const json& target) {
    const std::string file = folder + "/" + target.at("file").get<std::string>();
    const pipeline::Format format = format_named(target.at("format").get<std::string>(), file);
    const scenes::NumberArray array = scenes::read_npy(file);
    auto image = as_image(array, format, target.at("samples").get<int>());
    if (!image)
        throw InputError(file, "shape", fmt::format("the shape of a {} target", pipeline::info(format).name),
                         fmt::format("({})", fmt::join(array.shape, ", ")));
    return *std::move(image);
}

void write_copies_of(const json& result, const std::string& folder, pipeline::ColorSpace space) {
    const std::string place = folder + "/" + std::string{top} + result.at("algorithm").get<std::string>() + "/";
    scenes::write_image(place + "picture.exr", {.color = image_of(folder, result.at("picture")),
                                                .depth = image_of(folder, result.at("depth")),
                                                .space = space});
    std::vector<scenes::OutputColor> layers;
    for (const json& layer : result.at("layers"))
        layers.push_back({.color = image_of(folder, layer.at("color")),
                          .depth = image_of(folder, layer.at("depth")),
                          .premultiplied = result.at("premultiplied_layers").get<bool>(),
                          .space = space,
                          .part = layer.at("name").get<std::string>()});
    if (!layers.empty()) scenes::write_layers(place + "layers.exr", layers);
    for (const json& pass : result.at("passes")) {
        std::vector<NamedImage> targets;
        for (const json& target : pass.at("targets"))
            targets.push_back({target.at("name").get<std::string>(), image_of(folder, target)});
        write_targets(fmt::format("{}pass.{:03}.exr", place, pass.at("number").get<int>()), targets);
    }
}

// The target of an EXR file that corresponds to `expected`. In a pass the parts have the names of the targets.
const TargetImage* find_copy(const Picture& copy, const TargetImage& expected, bool is_pass) {
    const auto found = std::ranges::find_if(copy.targets, [&](const TargetImage& t) {
        return is_pass ? t.part == expected.name : t.part == expected.part && t.name == expected.name;
    });
    return found == copy.targets.end() ? nullptr : &*found;
}

std::string difference(const Picture& expected, const Picture& copy, bool is_pass) {
    for (const TargetImage& target : expected.targets) {
        const std::string name = target.part.empty() ? target.name : target.part + "." + target.name;
        const TargetImage* found = find_copy(copy, target, is_pass);
        if (found == nullptr) return fmt::format("has no part {}", name);
        if (found->codes != target.codes) return fmt::format("{}: its codes are not those of the array", name);
    }
    return "";
}

// "pass.003.exr": the arrays of which it is a copy. Null for any other name.
const Picture* original_of(const PackPictures& expected, const std::string& name) {
    if (name == "picture.exr") return &expected.picture;
    if (name == "layers.exr") return &expected.layers;
    const auto pass = std::ranges::find_if(
        expected.passes, [&](const PassPicture& p) { return name == fmt::format("pass.{:03}.exr", p.number); });
    return pass == expected.passes.end() ? nullptr : &pass->targets;
}

std::string fault_of(const std::vector<PackPictures>& all, const std::string& folder, const std::string& file) {
    const std::size_t slash = file.rfind('/');
    const std::string algorithm = file.substr(top.size(), std::max(slash, top.size()) - top.size());
    const std::string name = file.substr(slash + 1);
    const auto expected = std::ranges::find(all, algorithm, &PackPictures::algorithm);
    const Picture* original = expected == all.end() ? nullptr : original_of(*expected, name);
    if (original == nullptr) return "is a copy of no array";
    try {
        return difference(*original, read_picture(folder + "/" + file), name.starts_with("pass."));
    } catch (const InputError& error) {
        return std::string{"is damaged: "} + error.what();
    }
}

}  // namespace

void write_exr_copies(const std::string& folder) {
    const json manifest = scenes::read_manifest(folder);
    const pipeline::ColorSpace space = scenes::color_space_of(folder, manifest);
    for (const json& result : manifest.at("results")) write_copies_of(result, folder, space);
}

bool is_exr_copy(const std::string& file) { return file.starts_with(top) && file.ends_with(ending); }

std::vector<PackFault> check_exr_copies(const std::string& folder, const std::vector<std::string>& copies) {
    std::vector<PackFault> faults;
    if (copies.empty()) return faults;
    const std::vector<PackPictures> expected = expected_pictures(folder);
    for (const std::string& file : copies)
        if (const std::string message = fault_of(expected, folder, file); !message.empty())
            faults.push_back({file, message});
    return faults;
}

}  // namespace strata::oracle
