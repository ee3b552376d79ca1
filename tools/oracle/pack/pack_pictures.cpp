// tools/oracle/pack/pack_pictures.cpp - reads the targets that a manifest lists, checks their shapes, and turns them
// into pictures to compare (pack_pictures.h).
#include "tools/oracle/pack/pack_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "pipeline/formats/format.h"
#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "scenes/inside_folder.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/pack/manifest_value.h"
#include "tools/oracle/pack/target_json.h"
#include "tools/oracle/picture/numbers_file.h"

namespace strata::oracle {

pipeline::Format format_named(const std::string& name, const std::string& file) {
    for (const pipeline::Format format : enum_values<pipeline::Format>)
        if (pipeline::info(format).name == name) return format;
    throw InputError(file, "format", "the name of a target's format such as rgba8 or d24", "'" + name + "'");
}

namespace {

using pipeline::ChannelType;
using pipeline::Format;
using scenes::NumberArray;

constexpr int largest_side = 16384, most_samples_a_pixel = 16;

// Finds the file of a target; empty if there is none. `place` is the candidate's name for it.
using Finder = std::function<std::optional<std::string>(const ManifestValue& target, const std::string& place)>;

// Adds the samples of a target, each as its own target. `is_own`: the array belongs to the pack and must have the
// target's format.
void add_samples(const NumberArray& array, const ManifestValue& described, const std::string& file, bool is_own,
                 TargetImage target, std::vector<TargetImage>& to) {
    const Format format = format_named(described.text("format"), file);
    const auto samples = static_cast<std::size_t>(described.whole("samples", 1, 1, most_samples_a_pixel));
    const auto& shape = array.shape;
    const std::size_t sides = samples > 1 ? 4 : shape.size();
    const auto fits = [](std::size_t side) { return side >= 1 && side <= largest_side; };
    if ((sides != 2 && sides != 3 && sides != 4) || shape.size() != sides || (samples > 1 && shape[2] != samples) ||
        !fits(shape[0]) || !fits(shape[1]) || (sides == 4 && samples == 1 && shape[2] != 1) ||
        (sides > 2 && (shape.back() < 1 || shape.back() > 4)))
        throw InputError(file, "shape",
                         samples > 1 ? fmt::format("(rows, columns, {}, channels)", samples)
                                     : std::string{"(rows, columns) or (rows, columns, channels)"},
                         fmt::format("({})", fmt::join(shape, ", ")));
    target.width = static_cast<int>(shape[1]);
    target.height = static_cast<int>(shape[0]);
    target.channels = sides > 2 ? static_cast<int>(shape.back()) : 1;
    // A candidate's element of the format's own width is a code of the format; other elements are interpreted as in any
    // file.
    const scenes::Element own = element_of(format);
    if (is_own && array.element != own)
        throw InputError(file, "descr", std::string{scenes::name(own)}, std::string{scenes::name(array.element)});
    target.code = array.element == own ? code_of(format) : code_of(array.element, file);
    const ChannelType type = pipeline::info(format).type;
    target.meaning = type == ChannelType::depth     ? Meaning::depth
                     : type == ChannelType::stencil ? Meaning::other
                                                    : Meaning::color;
    const auto channels = static_cast<std::size_t>(target.channels);
    const std::string name = target.name;
    for (std::size_t sample = 0; sample < samples; ++sample) {
        target.name = name_of_sample(name, static_cast<int>(sample), static_cast<int>(samples));
        target.codes.clear();
        for (std::size_t pixel = 0; pixel < target.pixels(); ++pixel)
            for (std::size_t c = 0; c < channels; ++c)
                target.codes.push_back(array.word((pixel * samples + sample) * channels + c));
        to.push_back(target);
    }
}

class Reader {
  public:
    Reader(Finder find, bool is_own) : find_{std::move(find)}, is_own_{is_own} {}

    void add(const ManifestValue& described, const std::string& place, const std::string& part, const std::string& name,
             Picture& to) const {
        const auto file = find_(described, place);
        if (!file) return;
        to.file = *file;
        add_samples(scenes::read_npy(*file), described, *file, is_own_, {.part = part, .name = name}, to.targets);
    }

    PackPictures result(const ManifestValue& object) const {
        PackPictures pictures{.algorithm = object.algorithm("algorithm")};
        const std::string folder = pictures.algorithm + "/";
        add(object.object("picture"), folder + "picture.npy", "", "color", pictures.picture);
        add(object.object("depth"), folder + "depth.npy", "", "depth", pictures.picture);
        for (const ManifestValue& layer : near_to_far(object)) {
            const std::string name = layer.name("name");
            add(layer.object("color"), folder + name + ".color.npy", name, "color", pictures.layers);
            add(layer.object("depth"), folder + name + ".depth.npy", name, "depth", pictures.layers);
        }
        for (const ManifestValue& pass : object.list("passes")) {
            PassPicture shown{.number = pass.whole("number", 0, 0, INT32_MAX),
                              .iteration = pass.whole("iteration", 0, 0, INT32_MAX),
                              .kind = pass.text("kind")};
            for (const ManifestValue& target : pass.list("targets")) {
                const std::string name = target.name("name");
                shown.has_own |=
                    target.text("file").find(fmt::format("/pass.{:03}/", shown.number)) != std::string::npos;
                add(target, fmt::format("{}pass.{:03}/{}.npy", folder, shown.number, name), "", name, shown.targets);
            }
            if (!shown.targets.targets.empty()) pictures.passes.push_back(std::move(shown));
        }
        return pictures;
    }

  private:
    // Back layers are peeled from the far end.
    static std::vector<ManifestValue> near_to_far(const ManifestValue& object) {
        std::vector<ManifestValue> front, back;
        for (const ManifestValue& layer : object.list("layers"))
            (layer.text("name").starts_with("back.") ? back : front).push_back(layer);
        front.insert(front.end(), back.rbegin(), back.rend());
        return front;
    }

    Finder find_;
    bool is_own_;
};

bool is_empty(const PackPictures& pictures) {
    return pictures.picture.targets.empty() && pictures.layers.targets.empty() && pictures.passes.empty();
}

std::vector<PackPictures> all_of(const std::string& folder, const Reader& reader) {
    const nlohmann::json manifest = scenes::read_manifest(folder);
    const std::string file = folder + "/manifest.json";
    std::vector<PackPictures> all;
    for (const ManifestValue& object : ManifestValue{manifest, file}.list("results"))
        all.push_back(reader.result(object));
    std::erase_if(all, is_empty);
    return all;
}

}  // namespace

std::vector<PackPictures> expected_pictures(const std::string& path) {
    const std::string folder = scenes::pack_folder(path);
    const std::string manifest = folder + "/manifest.json";
    const auto find = [&](const ManifestValue& target, const std::string&) -> std::optional<std::string> {
        return scenes::path_inside(folder, target.text("file"), manifest, target.pointer_to("file"));
    };
    return all_of(folder, Reader{find, true});
}

std::vector<PackPictures> candidate_pictures(const std::string& pack, const std::string& candidate) {
    if (scenes::is_pack(candidate)) return expected_pictures(candidate);
    const auto find = [&](const ManifestValue&, const std::string& place) -> std::optional<std::string> {
        const std::string file = candidate + "/" + place;
        std::error_code unreadable;
        if (!std::filesystem::is_regular_file(file, unreadable)) return std::nullopt;
        return file;
    };
    std::vector<PackPictures> all = all_of(scenes::pack_folder(pack), Reader{find, false});
    if (all.empty())
        throw InputError(candidate, "folder", "ALGORITHM/picture.npy or another file that the pack lists",
                         "none of the pack's files");
    return all;
}

}  // namespace strata::oracle
