// tools/lab/suite_mistakes.cpp - strata_suite_mistakes: diagnoses every mistake on every scene of the oracle's suite,
// as a sweep with a row per scene: strata_suite_mistakes [SCENE...] [-o FOLDER] [--shard K/N].
// tools/oracle/suite/page.py makes a page of the rows.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "tools/lab/sweep/csv.h"
#include "tools/lab/sweep/sweep.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/mistake_table.h"
#include "tools/strata/messages.h"

using namespace strata;
using namespace strata::tools;
using nlohmann::ordered_json;

namespace {

std::vector<const oracle::SuiteScene*> scenes_named(const std::vector<std::string>& names) {
    std::vector<const oracle::SuiteScene*> scenes;
    for (const std::string& name : names) {
        scenes.push_back(oracle::find_suite_scene(name));
        if (scenes.back() == nullptr) throw InputError("SCENE", name, "a scene of the suite", "none of that name");
    }
    if (names.empty())
        for (const oracle::SuiteScene& scene : oracle::suite()) scenes.push_back(&scene);
    return scenes;
}

MeasuredRow measured(std::size_t row, const oracle::SuiteScene& scene) {
    const auto start = std::chrono::steady_clock::now();
    const oracle::TableColumn column = oracle::table_column(scene);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ordered_json line{{"scene", scene.name}, {"why", scene.why}, {"command", command_of(scene)}, {"outcome", "done"}};
    for (std::size_t m = 0; m < column.cells.size(); ++m)
        line["mistakes"].push_back({{"name", oracle::catalogue()[m].name},
                                    {"answer", enum_name(column.cells[m])},
                                    {"picture", column.picture[m]}});
    return {std::move(line), {{"row", row}, {"seconds", seconds}}, seconds};
}

std::ptrdiff_t count_of(const ordered_json& line, std::string_view answer) {
    return std::ranges::count_if(line["mistakes"], [&](const ordered_json& m) { return m["answer"] == answer; });
}

// A scene and the numbers of its answers.
std::string csv_of(const Lines& lines) {
    Lines counts;
    std::vector<std::string> columns{"/scene"};
    for (const std::string_view answer : enum_names<oracle::TableAnswer>) columns.push_back(fmt::format("/{}", answer));
    for (const ordered_json& line : lines) {
        counts.push_back({{"scene", line["scene"]}});
        for (const std::string_view answer : enum_names<oracle::TableAnswer>)
            counts.back()[answer] = count_of(line, answer);
    }
    return csv_of_columns(columns, counts);
}

bool names_wrongly(const Lines& lines) {
    return std::ranges::any_of(
        lines, [](const ordered_json& line) { return count_of(line, "wrong") + count_of(line, "accused") > 0; });
}

int run(const std::vector<std::string>& names, const std::string& folder, const Shard& shard) {
    const auto scenes = scenes_named(names);
    const Sweep sweep{.name = "scenes of the suite",
                      .rows = scenes.size(),
                      .description = {},
                      .measure = [&](std::size_t row) { return measured(row, *scenes[row]); },
                      .csv = csv_of,
                      .summary = [](const Lines& lines, const Lines&) { return csv_of(lines); },
                      .timing_class = {},
                      .has_failed = names_wrongly};
    return run_sweep(sweep, folder, shard);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> names;
    std::string folder;
    Shard shard;
    CLI::App app;
    app.add_option("SCENE", names);
    app.add_option("-o,--output", folder);
    add_shard_option(app, shard);
    CLI11_PARSE(app, argc, argv);
    try {
        return run(names, folder, shard);
    } catch (const InputError& error) {
        say_error(error.what());
        return 2;
    }
}
