// tools/oracle/suite/suite_packs.cpp - writes a pack for each scene of the suite and suite.json, and derives both
// again for a check (suite_packs.h).
#include "tools/oracle/suite/suite_packs.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/strict_json.h"
#include "scenes/files/text_file.h"
#include "scenes/packs/new_folder.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/mistake_table.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

using Scenes = std::vector<const SuiteScene*>;

constexpr const char* list_name = "suite.json";

// The scenes in which the cell of mistake `m` is one of two values.
ordered_json scenes_with(const std::vector<TableColumn>& columns, std::size_t m, TableAnswer one, TableAnswer other) {
    ordered_json names = ordered_json::array();
    for (const TableColumn& column : columns)
        if (column.cells[m] == one || column.cells[m] == other) names.push_back(column.scene->name);
    return names;
}

std::string list_of(const std::vector<TableColumn>& columns) {
    ordered_json list{{"format", "strata-suite"},
                      {"version", 1},
                      {"scenes", ordered_json::array()},
                      {"mistakes", ordered_json::array()},
                      {"equivalent", ordered_json::array()}};
    for (const TableColumn& column : columns)
        list["scenes"].push_back({{"name", column.scene->name},
                                  {"why", column.scene->why},
                                  {"algorithm", column.scene->algorithm},
                                  {"profile", column.scene->profile},
                                  {"command", command_of(*column.scene)}});
    const auto all = catalogue();
    for (std::size_t m = 0; m < all.size(); ++m)
        list["mistakes"].push_back(
            {{"name", all[m].name},
             {"sentence", all[m].description},
             {"named_first", scenes_with(columns, m, TableAnswer::named, TableAnswer::named)},
             {"beside_another", scenes_with(columns, m, TableAnswer::alike, TableAnswer::alike)},
             {"named_otherwise", scenes_with(columns, m, TableAnswer::wrong, TableAnswer::accused)},
             {"does_not_show", scenes_with(columns, m, TableAnswer::hidden, TableAnswer::hidden)}});
    for (const LookAlikes& pair : look_alikes(columns))
        if (const char* reason = reason_for(pair))
            list["equivalent"].push_back(
                {{"first", pair.first->name}, {"second", pair.second->name}, {"reason", reason}});
    return list.dump(1) + '\n';
}

// The table's columns, which take half of the time.
std::vector<TableColumn> columns_of(const Scenes& scenes, const ShowProgress& progress) {
    std::vector<TableColumn> columns;
    for (const SuiteScene* scene : scenes) {
        columns.push_back(table_column(*scene));
        if (progress) progress(0.5 + 0.5 * static_cast<double>(columns.size()) / static_cast<double>(scenes.size()));
    }
    return columns;
}

std::string folder_of(const std::string& path) {
    const fs::path place{path};
    return place.filename() == list_name ? (place.has_parent_path() ? place.parent_path().string() : ".") : path;
}

Scenes scenes_in(const std::string& list, const std::string& file) {
    Scenes scenes;
    const auto parsed = scenes::parse_strict_json(list, file, "the list of a suite in JSON");
    const auto fail = [&](const std::string& place, const std::string& expected, const std::string& found) {
        throw InputError(file, place, expected, found);
    };
    if (!parsed.is_object() || parsed.value("format", nlohmann::json{}) != "strata-suite")
        fail("/format", "\"strata-suite\"", "another format");
    if (const auto version = parsed.value("version", nlohmann::json{}); version != 1)
        fail("/version", "1", version.is_null() ? "none" : version.dump());
    const auto listed = parsed.find("scenes");
    if (listed == parsed.end() || !listed->is_array()) fail("/scenes", "an array", "none");
    for (std::size_t i = 0; i < listed->size(); ++i) {
        const auto& entry = (*listed)[i];
        const bool has_name = entry.is_object() && entry.contains("name") && entry["name"].is_string();
        const std::string name = has_name ? entry["name"].get<std::string>() : "";
        scenes.push_back(find_suite_scene(name));
        if (scenes.back() == nullptr)
            fail("/scenes/" + std::to_string(i) + "/name",
                 "a scene of the suite (strata diagnose --list --suite shows them)", "'" + name + "'");
    }
    return scenes;
}

// The first line in which two lists differ.
std::string first_difference(const std::string& found, const std::string& expected) {
    const auto at = std::mismatch(found.begin(), found.end(), expected.begin(), expected.end());
    const auto line = 1 + std::count(found.begin(), at.first, '\n');
    return "line " + std::to_string(line) + ": differs from the list that strata derives again";
}

}  // namespace

Golden golden_of(const SuiteScene& of) {
    OpenScene opened = open(of);
    Golden golden{.scene = std::move(opened.scene),
                  .profile = std::move(opened.profile),
                  .options = opened.options,
                  .algorithms = {opened.algorithm},
                  .command = command_of(of, "golden")};
    golden.scene.own_view = opened.view;
    return golden;
}

void write_suite(const std::string& folder, std::span<const SuiteScene* const> scenes, const ShowProgress& progress,
                 Copies copies) {
    scenes::NewFolder place{folder};
    std::size_t written = 0;
    for (const SuiteScene* scene : scenes) {
        write_pack(golden_of(*scene), folder + "/" + scene->name, copies);
        if (progress) progress(0.5 * static_cast<double>(++written) / static_cast<double>(scenes.size()));
    }
    scenes::write_file(folder + "/" + list_name, list_of(columns_of({scenes.begin(), scenes.end()}, progress)));
    place.keep();
}

bool is_suite(const std::string& path) {
    std::error_code unreadable;
    return fs::is_regular_file(fs::path(folder_of(path)) / list_name, unreadable);
}

std::vector<PackFault> check_suite(const std::string& path, Simd simd, const ShowProgress& progress) {
    const std::string folder = folder_of(path), file = folder + "/" + list_name;
    const std::string list = scenes::read_text_file(file);
    const Scenes listed = scenes_in(list, file);
    std::vector<PackFault> faults;
    std::size_t checked = 0;
    for (const SuiteScene* scene : listed) {
        for (const PackFault& fault : check_pack(folder + "/" + scene->name, simd))
            faults.push_back({scene->name + "/" + fault.file, fault.message});
        if (progress) progress(0.5 * static_cast<double>(++checked) / static_cast<double>(listed.size()));
    }
    const std::string derived = list_of(columns_of(listed, progress));
    if (derived != list) faults.push_back({list_name, first_difference(list, derived)});
    return faults;
}

}  // namespace strata::oracle
