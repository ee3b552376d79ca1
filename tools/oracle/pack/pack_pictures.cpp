#include "tools/oracle/pack/pack_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "pipeline/formats/format.h"
#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/numbers_file.h"
#include "tools/oracle/pack/target_json.h"

namespace strata::oracle {

pipeline::Format format_named(const std::string& name, const std::string& file) {
    for (const pipeline::Format format : enum_values<pipeline::Format>)
        if (pipeline::info(format).name == name) return format;
    throw InputError(file, "format", "a target's format", name);
}

namespace {

using nlohmann::json;
using pipeline::ChannelType;
using pipeline::Format;
using scenes::NumberArray;

// Finds the file of a target: nothing if there is none. `own` is the file that the pack names, `place` what a candidate calls it.
using Finder = std::function<std::optional<std::string>(const std::string& own, const std::string& place)>;

// The samples of a target, each by itself. `is_own`: the array is the pack's and has to be of the target's format.
void add_samples(const NumberArray& array, const json& described, const std::string& file, bool is_own, Target target,
                 std::vector<Target>& to) {
    const Format format = format_named(described.value("format", ""), file);
    const auto samples = static_cast<std::size_t>(described.value("samples", 1));
    const auto& shape = array.shape;
    const std::size_t sides = samples > 1 ? 4 : shape.size();
    if ((sides != 2 && sides != 3 && sides != 4) || shape.size() != sides || (samples > 1 && shape[2] != samples) ||
        shape[0] == 0 || shape[1] == 0 || (sides > 2 && (shape.back() < 1 || shape.back() > 4)))
        throw InputError(file, "shape",
                         samples > 1 ? "(rows, columns, samples, channels)" : "(rows, columns, channels)", "another");
    target.width = static_cast<int>(shape[1]);
    target.height = static_cast<int>(shape[0]);
    target.channels = sides > 2 ? static_cast<int>(shape.back()) : 1;
    // A candidate's element of the format's own width is a code of the format; others mean what they mean in any file.
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
        if (samples > 1) target.name = fmt::format("{}.sample{}", name, sample);
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

    void add(const json& described, const std::string& place, const std::string& part, const std::string& name,
             Picture& to) const {
        const auto file = find_(described.value("file", ""), place);
        if (!file) return;
        to.file = *file;
        add_samples(scenes::read_npy(*file), described, *file, is_own_, {.part = part, .name = name}, to.targets);
    }

    PackPictures result(const json& object) const {
        PackPictures pictures{.algorithm = object.value("algorithm", "")};
        const std::string folder = pictures.algorithm + "/";
        add(object.value("picture", json::object()), folder + "picture.npy", "", "color", pictures.picture);
        add(object.value("depth", json::object()), folder + "depth.npy", "", "depth", pictures.picture);
        for (const json* layer : near_to_far(object)) {
            const std::string name = layer->value("name", "");
            add(layer->value("color", json::object()), folder + name + ".color.npy", name, "color", pictures.layers);
            add(layer->value("depth", json::object()), folder + name + ".depth.npy", name, "depth", pictures.layers);
        }
        for (const json& pass : list_at(object, "passes")) {
            PassPicture shown{.number = pass.value("number", 0),
                              .iteration = pass.value("iteration", 0),
                              .kind = pass.value("kind", "")};
            for (const json& target : list_at(pass, "targets")) {
                const std::string name = target.value("name", "");
                shown.has_own |=
                    target.value("file", "").find(fmt::format("/pass.{:03}/", shown.number)) != std::string::npos;
                add(target, fmt::format("{}pass.{:03}/{}.npy", folder, shown.number, name), "", name, shown.targets);
            }
            if (!shown.targets.targets.empty()) pictures.passes.push_back(std::move(shown));
        }
        return pictures;
    }

  private:
    static const json& list_at(const json& object, const char* key) {
        static const json none = json::array();
        const auto found = object.find(key);
        return found != object.end() && found->is_array() ? *found : none;
    }

    // Back layers are peeled from the far end.
    static std::vector<const json*> near_to_far(const json& object) {
        std::vector<const json*> front, back;
        for (const json& layer : list_at(object, "layers"))
            (layer.value("name", "").starts_with("back.") ? back : front).push_back(&layer);
        front.insert(front.end(), back.rbegin(), back.rend());
        return front;
    }

    Finder find_;
    bool is_own_;
};

bool is_empty(const PackPictures& pictures) {
    return pictures.picture.targets.empty() && pictures.layers.targets.empty() && pictures.passes.empty();
}

// A type error of a manifest that nobody made by this program.
std::vector<PackPictures> all_of(const std::string& folder, const Reader& reader) {
    const json manifest = scenes::read_manifest(folder);
    std::vector<PackPictures> all;
    try {
        for (const json& object : manifest.at("results")) all.push_back(reader.result(object));
    } catch (const json::exception&) {
        throw InputError(folder + "/manifest.json", "/results", "what PACK.md describes", "something else");
    }
    std::erase_if(all, is_empty);
    return all;
}

}  // namespace

std::vector<PackPictures> expected_pictures(const std::string& path) {
    const std::string folder = scenes::pack_folder(path);
    const auto find = [&](const std::string& own, const std::string&) -> std::optional<std::string> {
        return folder + "/" + own;
    };
    return all_of(folder, Reader{find, true});
}

std::vector<PackPictures> candidate_pictures(const std::string& pack, const std::string& candidate) {
    if (scenes::is_pack(candidate)) return expected_pictures(candidate);
    const auto find = [&](const std::string&, const std::string& place) -> std::optional<std::string> {
        const std::string file = candidate + "/" + place;
        std::error_code unreadable;
        if (!std::filesystem::is_regular_file(file, unreadable)) return std::nullopt;
        return file;
    };
    std::vector<PackPictures> all = all_of(scenes::pack_folder(pack), Reader{find, false});
    if (all.empty())
        throw InputError(candidate, "folder", "ALGORITHM/picture.npy or another file of the pack", "none of them");
    return all;
}

}  // namespace strata::oracle
