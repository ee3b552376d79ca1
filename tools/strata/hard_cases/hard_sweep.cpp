#include "tools/strata/hard_cases/hard_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "peeling/algorithms/algorithm.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/progress.h"
#include "tools/strata/sweep/lock.h"
#include "tools/strata/table.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// What all algorithms of a group share.
struct HardGroup {
    const scenes::HardCase* hard = nullptr;
    const pipeline::DeviceProfile* profile = nullptr;
    pipeline::DepthFormat format{};
};

std::size_t groups(const HardSweep& sweep) { return sweep.cases.size() * sweep.profiles.size() * sweep.formats.size(); }

HardGroup group_of(const HardSweep& sweep, std::size_t number) {
    const std::size_t formats = sweep.formats.size(), profiles = sweep.profiles.size();
    return {sweep.cases[number / formats / profiles], &sweep.profiles[number / formats % profiles],
            sweep.formats[number % formats]};
}

// Numbers of the shard's lines among those of the whole sweep.
std::vector<std::size_t> lines_of(const HardSweep& sweep, const Shard& shard) {
    std::vector<std::size_t> numbers;
    for (const std::size_t group : shard.cells(groups(sweep)))
        for (std::size_t a = 0; a < sweep.algorithms.size(); ++a)
            numbers.push_back(group * sweep.algorithms.size() + a);
    return numbers;
}

ordered_json hard_description(const HardSweep& sweep, std::size_t number) {
    const HardGroup group = group_of(sweep, number / sweep.algorithms.size());
    return {{"cell", number},
            {"case", group.hard->name},
            {"profile", group.profile->name},
            {"depth", name_of(depth_formats, group.format)},
            {"algorithm", sweep.algorithms[number % sweep.algorithms.size()]->name}};
}

// A journal's lines at the places of the shard's combinations, null where one is missing.
struct HardLines {
    Found found;
    Lines lines;
};

HardLines checked_lines(const HardSweep& sweep, const Shard& shard) {
    const std::string path = shard_file(sweep.folder, "results", shard);
    Expected expected{.cells = lines_of(sweep, shard), .described = {}, .keys = {"verdict"}};
    for (const std::size_t number : expected.cells) expected.described.push_back(hard_description(sweep, number));
    HardLines checked{read_journal(path), {}};
    checked.lines = lines_of_cells(path, checked.found, expected);
    warn_of(path, checked.found);
    return checked;
}

std::ptrdiff_t missing_of(const Lines& lines) { return std::count(lines.begin(), lines.end(), nullptr); }

ordered_json counts_of(const Composited& found) {
    return {
        {"visible", found.visible},         {"deepest", found.deepest},           {"layers", found.layers},
        {"tied_pixels", found.tied_pixels}, {"lost_by_ties", found.lost_by_ties}, {"lost", found.lost},
        {"repeated", found.repeated},       {"misplaced", found.misplaced},       {"wrong_pixels", found.wrong_pixels}};
}

}  // namespace

ordered_json to_line(const HardSweep& sweep, std::size_t number, const HardRow& row) {
    ordered_json line = hard_description(sweep, number);
    line["verdict"] = name_of(row.verdict);
    if (!row.refusal.empty()) {
        line["refusal"] = row.refusal;
        return line;
    }
    line["reasons"] = row.reasons;
    line["fragments"] = counts_of(row.found);
    line["difference"] = row.difference;
    line["difference_at_ties"] = row.difference_at_ties;
    line["bound"] = row.bound;
    line["nan_values"] = row.nan_values;
    line["unlike"] = row.unlike;
    line["diagnostics"] = ordered_json::array();
    for (const pipeline::Diagnostic& d : row.diagnostics)
        line["diagnostics"].push_back({{"fault", pipeline::name(d.fault)}, {"pixels", d.pixels}, {"detail", d.detail}});
    line["digest"] = row.digest;
    return line;
}

Lines run_sweep(const HardSweep& sweep) {
    std::filesystem::create_directories(sweep.folder);
    const std::string path = shard_file(sweep.folder, "results", sweep.shard);
    const Lock lock(path);
    auto [found, lines] = checked_lines(sweep, sweep.shard);
    const std::vector<std::size_t> numbers = lines_of(sweep, sweep.shard);
    const std::ptrdiff_t missing = missing_of(lines);
    if (missing == 0 && found.changed.empty()) return lines;
    Journal journal = journal_behind(path, found, lines);
    Progress progress("hard cases", Remaining::shown);
    std::optional<HardMachine> machine;
    std::size_t group = ~std::size_t{0};
    std::ptrdiff_t done = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!lines[i].is_null()) continue;
        progress.show(static_cast<double>(done++) / static_cast<double>(missing));
        const std::size_t own = numbers[i] / sweep.algorithms.size();
        if (own != group) {
            const HardGroup is = group_of(sweep, own);
            machine.emplace(*is.hard, *is.profile, is.format);
            group = own;
        }
        const HardRow row = machine->run(*sweep.algorithms[numbers[i] % sweep.algorithms.size()]);
        journal.append(lines[i] = to_line(sweep, numbers[i], row));
    }
    // Combinations between others may have been missing: the finished file has all in order.
    scenes::write_file(path, text_of(lines));
    return lines;
}

Lines merge_shards(const HardSweep& sweep, std::size_t shards) {
    const Lock lock(shard_file(sweep.folder, "results", {}));
    Lines all(groups(sweep) * sweep.algorithms.size());
    for (std::size_t index = 1; index <= shards; ++index) {
        const Shard shard{index, shards};
        const std::vector<std::size_t> numbers = lines_of(sweep, shard);
        Lines lines = checked_lines(sweep, shard).lines;
        if (const std::ptrdiff_t missing = missing_of(lines); missing > 0)
            throw InputError(shard_file(sweep.folder, "results", shard), "lines",
                             std::to_string(numbers.size()) + ", one a combination of the shard",
                             std::to_string(numbers.size() - static_cast<std::size_t>(missing)));
        for (std::size_t i = 0; i < numbers.size(); ++i) all[numbers[i]] = std::move(lines[i]);
    }
    scenes::write_file(shard_file(sweep.folder, "results", {}), text_of(all));
    return all;
}

bool has_failed(const Lines& lines) {
    return std::any_of(lines.begin(), lines.end(),
                       [](const ordered_json& line) { return line["verdict"] == name_of(HardVerdict::failed); });
}

std::string summary(const HardSweep& sweep, const Lines& lines) {
    std::map<std::string, std::map<std::string, int>> counts;
    for (const ordered_json& line : lines)
        ++counts[line["case"].get<std::string>()][line["verdict"].get<std::string>()];
    constexpr std::array verdicts{HardVerdict::stable, HardVerdict::degrades, HardVerdict::breaks, HardVerdict::failed,
                                  HardVerdict::refused};
    Table table{{{"case"}}, {}};
    for (const HardVerdict verdict : verdicts) table.columns.push_back({std::string{name_of(verdict)}, Align::right});
    for (const scenes::HardCase* hard : sweep.cases) {
        const std::string name{hard->name};
        if (!counts.contains(name)) continue;
        std::vector<std::string> cells{name};
        for (const HardVerdict verdict : verdicts)
            cells.push_back(fmt::format("{}", counts[name][std::string{name_of(verdict)}]));
        table.rows.push_back(std::move(cells));
    }
    std::string text = to_text(table);
    for (const ordered_json& line : lines) {
        if (line["verdict"] != name_of(HardVerdict::failed)) continue;
        text += fmt::format("failed: {} by {} on {} at {}:", line["case"].get<std::string>(),
                            line["algorithm"].get<std::string>(), line["profile"].get<std::string>(),
                            line["depth"].get<std::string>());
        for (const auto& reason : line["reasons"]) text += " " + reason.get<std::string>() + ";";
        text.back() = '\n';
    }
    return text;
}

}  // namespace strata::tools
