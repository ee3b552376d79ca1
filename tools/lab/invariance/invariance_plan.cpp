// tools/lab/invariance/invariance_plan.cpp - expands a JSON plan, or the options of the command, into cells: every
// combination of the values of its keys (invariance_plan.h).
#include "tools/lab/invariance/invariance_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rasterizer/base/input_error.h"
#include "scenes/files/strict_json.h"
#include "tools/request/names.h"
#include "tools/request/parse.h"

namespace strata::tools {

using nlohmann::json;

namespace {

// The file name for messages.
struct PlanFile {
    const std::string& file;
    [[noreturn]] void fail(const std::string& place, const std::string& expected, const std::string& found) const {
        throw InputError(file, place, expected, found);
    }
};

std::vector<std::string> key_names() {
    std::vector<std::string> names;
    for (const PlanKey& key : plan_keys()) names.push_back(key.name);
    return names;
}

// A value in the form of the options: numbers in their shortest form.
std::string text_of(const json& value, const PlanFile& source, const std::string& place) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_unsigned()) return fmt::format("{}", value.get<std::uint64_t>());
    if (value.is_number_integer()) return fmt::format("{}", value.get<std::int64_t>());
    if (value.is_number()) return fmt::format("{}", value.get<double>());
    source.fail(place, "a string, a number, or a list of them", value.dump());
}

void check_value(const PlanKey& key, const std::string& text, const PlanFile& source, const std::string& place) {
    Cell cell;
    if (!key.set(cell, text)) source.fail(place, key.expected, "'" + text + "'");
}

// One value or a list of values, each checked by the key; `place` is the JSON pointer, to which a list appends the
// index.
std::vector<std::string> values_of_key(const PlanKey& key, const json& value, const PlanFile& source,
                                       const std::string& place) {
    if (value.is_array() && value.empty()) source.fail(place, "at least one value", "an empty list");
    std::vector<std::string> values;
    const json list = value.is_array() ? value : json::array({value});
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string where = value.is_array() ? fmt::format("{}/{}", place, i) : place;
        values.push_back(text_of(list[i], source, where));
        check_value(key, values.back(), source, where);
    }
    return values;
}

// The keys of an object of the plan. An unknown key is an error: otherwise a misspelled one would silently have its
// default.
KeyValues grid_of(const json& object, const PlanFile& source, const std::string& place) {
    if (!object.is_object()) source.fail(place, "an object", object.dump());
    KeyValues values;
    for (const auto& [name, value] : object.items()) {
        const auto& keys = plan_keys();
        const auto key =
            std::find_if(keys.begin(), keys.end(), [&wanted = name](const PlanKey& k) { return k.name == wanted; });
        if (key == keys.end()) source.fail(place, "keys " + one_of(key_names()), found_but_near(name, key_names()));
        values[name] = values_of_key(*key, value, source, place + "/" + name);
    }
    return values;
}

// Values of `over` replace those of `values`.
KeyValues merged(KeyValues values, const KeyValues& over) {
    for (const auto& [name, list] : over) values[name] = list;
    return values;
}

KeyValues fallbacks() {
    KeyValues values;
    for (const PlanKey& key : plan_keys())
        if (!key.fallback.empty())
            values[key.name] = key.is_list ? split(key.fallback, ',') : std::vector{key.fallback};
    return values;
}

// More than any useful sweep, and few enough for the search below.
constexpr std::size_t most_cells = 10000;

// The number of combinations, counted up to the limit.
std::size_t combinations_of(const KeyValues& grid) {
    std::size_t product = 1;
    for (const auto& [name, values] : grid) product = std::min(product * values.size(), most_cells + 1);
    return product;
}

// Adds all combinations of the values from key `k` on to `cell`; an existing cell is not added again. The search is
// linear, because plans have hundreds of cells.
void add_combinations(std::vector<Cell>& cells, const KeyValues& grid, std::size_t k, const Cell& cell) {
    const auto& keys = plan_keys();
    if (k == keys.size()) {
        if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
        return;
    }
    for (const std::string& text : grid.at(keys[k].name)) {
        Cell next = cell;
        keys[k].set(next, text);  // checked before
        add_combinations(cells, grid, k + 1, next);
    }
}

// The only key without a default.
void require_scene(const KeyValues& grid, const PlanFile& source, const std::string& place) {
    if (!grid.contains("scene")) source.fail(place, "a scene, here, in /common or on the command line", "none");
}

}  // namespace

std::vector<Cell> parse_plan(const std::string& text, const std::string& file, const KeyValues& options) {
    const PlanFile source{file};
    const json plan = scenes::parse_strict_json(text, file, "a plan in JSON");
    if (!plan.is_object()) source.fail("/", "an object with \"grids\"", plan.dump());
    for (const auto& [name, value] : plan.items())
        if (name != "common" && name != "grids" && name != "about")
            source.fail("/", "keys about, common or grids", found_but_near(name, {"about", "common", "grids"}));
    if (plan.contains("about") && !plan["about"].is_string()) source.fail("/about", "a string", plan["about"].dump());
    if (!plan.contains("grids") || !plan["grids"].is_array() || plan["grids"].empty())
        source.fail("/grids", "a list of at least one grid", plan.contains("grids") ? plan["grids"].dump() : "none");
    // A grid's own values override /common, which overrides the options, which override the defaults.
    const KeyValues base = merged(merged(fallbacks(), options),
                                  plan.contains("common") ? grid_of(plan["common"], source, "/common") : KeyValues{});
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < plan["grids"].size(); ++i) {
        const std::string place = fmt::format("/grids/{}", i);
        const KeyValues grid = merged(base, grid_of(plan["grids"][i], source, place));
        require_scene(grid, source, place);
        if (cells.size() + combinations_of(grid) > most_cells)
            source.fail(place, fmt::format("at most {} cells in all", most_cells), "more");
        add_combinations(cells, grid, 0, {});
    }
    return cells;
}

std::vector<Cell> cells_of(const KeyValues& options) {
    const std::string here = "strata";
    const KeyValues grid = merged(fallbacks(), options);
    require_scene(grid, PlanFile{here}, "SCENE");
    if (combinations_of(grid) > most_cells)
        PlanFile{here}.fail("options", fmt::format("at most {} cells in all", most_cells), "more");
    std::vector<Cell> cells;
    add_combinations(cells, grid, 0, {});
    return cells;
}

}  // namespace strata::tools
