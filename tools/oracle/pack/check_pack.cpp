// tools/oracle/pack/check_pack.cpp - compares a pack with its manifest and with a new derivation.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include "rasterizer/base/input_error.h"
#include "scenes/files/text_file.h"
#include "scenes/inside_folder.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/pack/exr_copies.h"
#include "tools/oracle/pack/golden.h"
#include "tools/oracle/pack/manifest_value.h"

namespace strata::oracle {

namespace {

using nlohmann::json;
using scenes::NumberArray;

constexpr std::size_t most_bytes = std::size_t{1} << 32;

// The array in a .npy file; empty for other files and for damaged ones.
std::optional<NumberArray> array_of(const std::string& bytes, const std::string& name) {
    if (!name.ends_with(".npy")) return std::nullopt;
    try {
        return scenes::parse_npy(bytes, name);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

// ", row 3, column 5, channel 1": the position of an element of the array.
std::string place_of(const NumberArray& array, std::size_t element) {
    static constexpr std::string_view of_two[] = {"row", "column"}, of_three[] = {"row", "column", "channel"},
                                      of_four[] = {"row", "column", "sample", "channel"}, of_one[] = {"entry"};
    const std::size_t sides = array.shape.size();
    const std::string_view* names = sides == 1 ? of_one : sides == 2 ? of_two : sides == 3 ? of_three : of_four;
    std::string place;
    for (std::size_t side = sides; side-- > 0; element /= std::max<std::size_t>(array.shape[side], 1))
        place = fmt::format(", {} {}", names[side], element % std::max<std::size_t>(array.shape[side], 1)) + place;
    return place;
}

// The byte at `position` of the file, and the element of its array.
std::string place_in_file(const std::string& bytes, const std::string& name, std::size_t position) {
    const auto array = array_of(bytes, name);
    std::string place = fmt::format("byte {}", position);
    if (!array || position + array->bytes.size() < bytes.size()) return place;
    const std::size_t within = position + array->bytes.size() - bytes.size();
    return place + place_of(*array, within / scenes::bytes_of(array->element));
}

std::string difference(const std::string& found, const std::string& expected, const std::string& name) {
    if (found.size() != expected.size())
        return fmt::format("size: expected {} bytes, found {} bytes", expected.size(), found.size());
    const auto at = std::mismatch(found.begin(), found.end(), expected.begin());
    const auto position = static_cast<std::size_t>(at.first - found.begin());
    return fmt::format("{}: expected {}, found {}", place_in_file(expected, name, position),
                       static_cast<unsigned char>(expected[position]), static_cast<unsigned char>(found[position]));
}

// The first difference of two manifests, as a JSON pointer.
std::string manifest_difference(const std::string& found, const std::string& expected) {
    const json patch = json::diff(json::parse(found), json::parse(expected));
    if (patch.empty()) return difference(found, expected, "manifest.json");
    return fmt::format("{}: differs from the value that strata derives again", patch[0]["path"].get<std::string>());
}

std::uint64_t sum_at(const ManifestValue& listed, std::size_t i) {
    std::uint64_t value = 0;
    const json sums = listed.value().value("sums", json::array());
    if (!sums.is_array() || i >= sums.size() || !sums[i].is_string())
        listed.fail("sums", "two strings of digits, the sums of the file's bytes");
    const auto& digits = sums[i].get_ref<const std::string&>();
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
}

// Empty if the file agrees with the manifest's list.
std::string listed_difference(const std::string& bytes, const std::string& name, const ManifestValue& listed) {
    const scenes::ByteSums sums{sum_at(listed, 0), sum_at(listed, 1)};
    const auto array = array_of(bytes, name);
    const std::string_view hashed = array ? std::string_view{array->bytes} : std::string_view{bytes};
    if (scenes::digest_of_bytes(hashed) == listed.text("digest") && scenes::sums_of(bytes) == sums) return "";
    const auto changed = scenes::changed_byte(bytes, sums);
    if (!changed) return "the file's digest differs from the manifest's: several bytes have changed";
    return fmt::format("{}: expected {}, found {}", place_in_file(bytes, name, changed->position), changed->was,
                       changed->is);
}

// True if a profile's text equals the other one without some of its keys: an earlier program without those keys wrote
// it.
bool is_older_profile(const std::string& found, const std::string& now) {
    const json patch = json::diff(json::parse(found), json::parse(now));
    return std::ranges::all_of(patch, [](const json& change) { return change["op"] == "add"; });
}

class Check {
  public:
    explicit Check(std::string folder) : folder_{std::move(folder)} {}

    // Checks the files that the manifest lists, each with its digest, and that there are no others.
    void files(const json& manifest) {
        const std::string file = folder_ + "/manifest.json";
        const ManifestValue listed = ManifestValue{manifest, file}.object("files");
        for (const auto& [name, entry] : listed.value().items()) {
            const ManifestValue described = listed.object(name);
            if (scenes::inside_folder(folder_, name).status != scenes::InsideFolder::PathStatus::nothing)
                static_cast<void>(scenes::path_inside(folder_, name, file, listed.pointer_to(name)));
            if (const auto bytes = read(name)) note(name, listed_difference(*bytes, name, described));
        }
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
            if (!entry.is_regular_file()) continue;
            const std::string name = std::filesystem::relative(entry.path(), folder_).generic_string();
            if (is_exr_copy(name))
                copies_.push_back(name);
            else if (name != "manifest.json" && !listed.value().contains(name))
                note(name, "is not in the manifest");
        }
        std::ranges::sort(copies_);
    }

    // Checks EXR copies against arrays that passed the check.
    void copies() {
        for (const PackFault& fault : check_exr_copies(folder_, copies_)) note(fault.file, fault.message);
    }

    void derived(const Golden& golden) {
        derive(golden, [&](const std::string& name, const std::string& expected) {
            if (known_.contains(name)) return;  // one message per file
            const auto found = read(name);
            if (!found || *found == expected) return;
            if (name == "profile.json" && is_older_profile(*found, expected)) {
                has_older_profile_ = true;
                return;
            }
            const std::string message =
                name == "manifest.json" ? manifest_fault(*found, expected) : difference(*found, expected, name);
            note(name, message);
        });
    }

    std::vector<PackFault> faults{};

  private:
    std::optional<std::string> read(const std::string& name) {
        try {
            return scenes::read_text_file(folder_ + "/" + name, most_bytes);
        } catch (const InputError& error) {
            std::error_code ignored;
            note(name, std::filesystem::exists(folder_ + "/" + name, ignored) ? error.what() : "no such file");
            return std::nullopt;
        }
    }

    // The manifest lists an older profile by its own bytes, which files() has checked.
    [[nodiscard]] std::string manifest_fault(const std::string& found, const std::string& expected) const {
        if (!has_older_profile_) return manifest_difference(found, expected);
        const json older = json::parse(found);
        json now = json::parse(expected);
        now["files"]["profile.json"] = older["files"]["profile.json"];
        return older == now ? "" : manifest_difference(found, now.dump(1) + '\n');
    }

    void note(const std::string& name, const std::string& message) {
        if (message.empty() || !known_.insert(name).second) return;
        faults.push_back({name, message});
    }

    std::string folder_;
    std::set<std::string> known_{};
    std::vector<std::string> copies_{};
    bool has_older_profile_ = false;
};

}  // namespace

std::vector<PackFault> check_pack(const std::string& path, Simd simd) {
    const std::string folder = scenes::pack_folder(path);
    Check check{folder};
    check.files(scenes::read_manifest(folder));
    const bool has_inputs = std::ranges::none_of(check.faults, [](const PackFault& fault) {
        return fault.file.starts_with("scene/") || fault.file == "profile.json";
    });
    // A changed input would change everything derived from it, so only its own fault is reported.
    if (!has_inputs) return check.faults;
    Golden golden = read_pack(path);
    golden.options.simd = simd;
    check.derived(golden);
    if (check.faults.empty()) check.copies();
    return check.faults;
}

}  // namespace strata::oracle
