// tools/lab/hard_cases/hard_sweep.cpp - the rows of strata hard-cases: numbers the combinations of case, device, format
// and algorithm, and writes each as JSON and CSV (hard_sweep.h).
#include "tools/lab/hard_cases/hard_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <optional>

#include "peeling/algorithms/algorithm.h"
#include "tools/lab/sweep/csv.h"
#include "tools/request/choices.h"
#include "tools/strata/table.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// A cell of the sweep.
struct HardCell {
    std::size_t group = 0;  // number of the case, profile and format
    const scenes::HardCase* hard = nullptr;
    const pipeline::DeviceProfile* profile = nullptr;
    pipeline::DepthFormat format{};
    const peeling::Algorithm* algorithm = nullptr;
};

HardCell hard_cell(const HardSweep& sweep, std::size_t number) {
    const std::size_t formats = sweep.formats.size(), profiles = sweep.profiles.size();
    const std::size_t group = number / sweep.algorithms.size();
    return {group, sweep.cases[group / formats / profiles], &sweep.profiles[group / formats % profiles],
            sweep.formats[group % formats], sweep.algorithms[number % sweep.algorithms.size()]};
}

ordered_json hard_description(const HardSweep& sweep, std::size_t number) {
    const HardCell cell = hard_cell(sweep, number);
    return {{"cell", number},
            {"case", cell.hard->name},
            {"profile", cell.profile->name},
            {"depth", name_of(depth_formats, cell.format)},
            {"algorithm", cell.algorithm->name},
            {"moves", sweep.moves && cell.hard->is_moved && is_moved(*cell.algorithm)}};
}

ordered_json counts_of(const Composited& found) {
    return {
        {"visible", found.visible},         {"deepest", found.deepest},           {"layers", found.layers},
        {"tied_pixels", found.tied_pixels}, {"lost_by_ties", found.lost_by_ties}, {"lost", found.lost},
        {"repeated", found.repeated},       {"misplaced", found.misplaced},       {"wrong_pixels", found.wrong_pixels}};
}

ordered_json faults_of(const std::vector<pipeline::Diagnostic>& diagnostics) {
    ordered_json faults = ordered_json::array();
    for (const pipeline::Diagnostic& d : diagnostics)
        faults.push_back({{"fault", pipeline::name(d.fault)}, {"pixels", d.pixels}, {"detail", d.detail}});
    return faults;
}

void add_moved_columns(std::vector<std::string>& columns) {
    columns.emplace_back("/stability/verdict");
    for (const MoveSize size : move_sizes)
        for (const char* part : {"exact", "ours", "amplification", "within_move", "within_device", "beyond"})
            for (const char* figure : {"gained", "lost", "reordered", "color", "depth"})
                columns.push_back(fmt::format("/stability/{}/{}/{}", name_of(size), part, figure));
    for (const char* figure : {"/stability/permuted", "/stability/permuted_ties", "/flicker/compared", "/flicker/order",
                               "/flicker/coverage"})
        columns.emplace_back(figure);
    for (const auto& path : depth_paths()) columns.push_back(fmt::format("/flicker/paths/{}/order", path.name));
    columns.emplace_back("/flicker/paths/exact_unstored/order");
}

std::vector<std::string> hard_columns() {
    std::vector<std::string> columns{"/cell",      "/case",    "/profile", "/depth",
                                     "/algorithm", "/outcome", "/refusal", "/verdict"};
    const ordered_json counts = counts_of({});
    for (const auto& [key, value] : counts.items()) columns.push_back("/fragments/" + key);
    for (const char* key : {"/difference", "/difference_at_ties", "/bound", "/nan_values", "/digest"})
        columns.emplace_back(key);
    add_moved_columns(columns);
    return columns;
}

// The HardCaseRenderer of the last cells, and the number of their group.
struct HardCache {
    std::size_t group = 0;
    std::optional<HardCaseRenderer> renderer;
    const scenes::HardCase* hard = nullptr;
    std::optional<MovedCaseRenderer> moved;
};

std::optional<MovedRow> moved_row(const HardSweep& sweep, const HardCell& cell, const HardRow& row, HardCache& cache) {
    if (!sweep.moves || !cell.hard->is_moved || !is_moved(*cell.algorithm) || !row.refusal.empty()) return {};
    if (cache.hard != cell.hard) cache.moved.emplace(*cell.hard);
    cache.hard = cell.hard;
    return cache.moved->run(*cell.profile, cell.format, *cell.algorithm, row);
}

MeasuredRow hard_measured(const HardSweep& sweep, std::size_t number, HardCache& cache) {
    const auto start = std::chrono::steady_clock::now();
    const HardCell cell = hard_cell(sweep, number);
    if (!cache.renderer || cache.group != cell.group) {
        cache.renderer.emplace(*cell.hard, *cell.profile, cell.format);
        cache.group = cell.group;
    }
    const HardRow row = cache.renderer->run(*cell.algorithm);
    const ordered_json line = to_line(sweep, number, row, moved_row(sweep, cell, row, cache));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return {.line = line, .timing = {{"cell", number}, {"seconds", taken.count()}}, .seconds = taken.count()};
}

}  // namespace

ordered_json to_line(const HardSweep& sweep, std::size_t number, const HardRow& row,
                     const std::optional<MovedRow>& moved) {
    ordered_json line = hard_description(sweep, number);
    const bool ran = row.refusal.empty();
    const auto if_ran = [&](const ordered_json& value) { return ran ? value : ordered_json(nullptr); };
    line["outcome"] = ran ? "done" : "refused";
    line["refusal"] = row.refusal;
    line["verdict"] = name_of(row.verdict);
    line["reasons"] = if_ran(row.reasons);
    line["fragments"] = if_ran(counts_of(row.found));
    line["difference"] = if_ran(row.difference);
    line["difference_at_ties"] = if_ran(row.difference_at_ties);
    line["bound"] = if_ran(row.bound);
    line["nan_values"] = if_ran(row.nan_values);
    line["unlike"] = if_ran(row.unlike);
    line["diagnostics"] = if_ran(faults_of(row.diagnostics));
    line["digest"] = if_ran(row.digest);
    line["stability"] = moved ? to_json(moved->stability) : ordered_json(nullptr);
    line["flicker"] = moved ? flicker_json(*moved) : ordered_json(nullptr);
    return line;
}

Sweep sweep_of(const HardSweep& sweep) {
    return {.name = "hard cases",
            .rows = sweep.cases.size() * sweep.profiles.size() * sweep.formats.size() * sweep.algorithms.size(),
            .description = [&sweep](std::size_t i) { return hard_description(sweep, i); },
            .measure = [&sweep, cache = std::make_shared<HardCache>()](
                           std::size_t i) { return hard_measured(sweep, i, *cache); },
            .csv = [](const Lines& lines) { return csv_of_columns(hard_columns(), lines); },
            .summary = [&sweep](const Lines& lines, const Lines&) { return summary(sweep, lines); },
            .timing_class = [&sweep](std::size_t i) { return std::string{hard_cell(sweep, i).hard->name}; },
            .has_failed = has_failed};
}

namespace {

bool is_unstable(const ordered_json& line) {
    return !line["stability"].is_null() && line["stability"]["verdict"] == name_of(StabilityVerdict::unstable);
}

// The combination and all reasons.
std::string failure_of(const ordered_json& line, const std::string& word, const ordered_json& reasons) {
    std::string text = fmt::format("{}: {} by {} on {} at {}:", word, line["case"].get<std::string>(),
                                   line["algorithm"].get<std::string>(), line["profile"].get<std::string>(),
                                   line["depth"].get<std::string>());
    for (const auto& reason : reasons) text += " " + reason.get<std::string>() + ";";
    text.back() = '\n';
    return text;
}

}  // namespace

bool has_failed(const Lines& lines) {
    return std::any_of(lines.begin(), lines.end(), [](const ordered_json& line) {
        return line["verdict"] == name_of(HardVerdict::failed) || is_unstable(line);
    });
}

std::string summary(const HardSweep& sweep, const Lines& lines) {
    std::map<std::string, std::map<std::string, int>> counts;
    for (const ordered_json& line : lines)
        ++counts[line["case"].get<std::string>()][line["verdict"].get<std::string>()];
    Table table{{{"case"}}, {}};
    for (const HardVerdict verdict : hard_verdicts)
        table.columns.push_back({std::string{name_of(verdict)}, Align::right});
    for (const scenes::HardCase* hard : sweep.cases) {
        const std::string name{hard->name};
        if (!counts.contains(name)) continue;
        std::vector<std::string> cells{name};
        for (const HardVerdict verdict : hard_verdicts)
            cells.push_back(fmt::format("{}", counts[name][std::string{name_of(verdict)}]));
        table.rows.push_back(std::move(cells));
    }
    std::string text = to_text(table);
    for (const ordered_json& line : lines) {
        if (line["verdict"] == name_of(HardVerdict::failed)) text += failure_of(line, "failed", line["reasons"]);
        if (is_unstable(line)) text += failure_of(line, "unstable", line["stability"]["reasons"]);
    }
    return text;
}

}  // namespace strata::tools
