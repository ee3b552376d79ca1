#include "tools/lab/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "tools/strata/messages.h"
#include "tools/strata/progress.h"
#include "tools/strata/table.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

std::string text_of(const Lines& lines) {
    std::string text;
    for (const ordered_json& line : lines) text += json_text(line) + '\n';
    return text;
}

// The folder may come from someone else: a link, a device or a pipe would lead the rows elsewhere.
void check_is_file(const std::string& path) {
    const auto type = std::filesystem::symlink_status(path).type();
    if (type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::regular)
        throw InputError(path, "file", "a file in its own place", "a link, a pipe, a device or a folder");
}

// Results are replaced only by a run of the same command: its rows have the keys of the description.
void check_is_own(const Sweep& sweep, const std::string& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line) || sweep.rows == 0) return;
    const auto row = nlohmann::json::parse(line, nullptr, false);
    const ordered_json own = sweep.description(0);
    for (const auto& [key, value] : own.items())
        if (!row.is_object() || !row.contains(key))
            throw InputError(
                path, "line 1",
                "a row of strata " + sweep.name + ", which this command replaces (-o names another folder)",
                "another text");
}

int exit_status(const Sweep& sweep, const Lines& lines) {
    if (sweep.has_failed && sweep.has_failed(lines)) return 1;
    const auto is_refused = [](const ordered_json& line) { return line["outcome"] == "refused"; };
    if (lines.empty() || !std::ranges::all_of(lines, is_refused)) return 0;
    say_error("every row was refused: " + lines[0]["refusal"].get<std::string>());
    return 2;
}

}  // namespace

std::string json_text(const ordered_json& value) {
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

int run_sweep(const Sweep& sweep, const std::string& folder, const Shard& shard) {
    const std::string results = shard_file(folder, "results", ".jsonl", shard),
                      csv = shard_file(folder, "results", ".csv", shard),
                      times = shard_file(folder, "timings", ".jsonl", shard);
    if (!folder.empty()) {
        std::filesystem::create_directories(folder);
        for (const std::string& path : {results, csv, times}) check_is_file(path);
        check_is_own(sweep, results);
    }
    Lines lines, timings;
    {
        Progress progress(sweep.name, Remaining::shown);
        const auto mine = shard.rows(sweep.rows);
        for (const std::size_t row : mine) {
            progress.show(static_cast<double>(lines.size()) / static_cast<double>(mine.size()));
            MeasuredRow measured = sweep.measure(row);
            lines.push_back(std::move(measured.line));
            timings.push_back(std::move(measured.timing));
        }
    }
    if (!folder.empty()) {
        scenes::write_file(times, text_of(timings));
        scenes::write_file(csv, sweep.csv(lines));
        scenes::write_file(results, text_of(lines));
    }
    print(shard.count == 1 ? sweep.summary(lines, timings) : fmt::format("{}: {} rows\n", results, lines.size()));
    return exit_status(sweep, lines);
}

void dry_run(const Sweep& sweep, const Shard& shard) {
    std::map<std::string, double> seconds;
    double total = 0;
    const auto mine = shard.rows(sweep.rows);
    for (const std::size_t row : mine) {
        const std::string like = sweep.timing_class(row);
        if (!seconds.contains(like)) seconds[like] = sweep.measure(row).seconds;
        total += seconds[like];
        print(json_text(sweep.description(row)) + '\n');
    }
    print(fmt::format("{} row{}, about {:.0f} s on this computer\n", mine.size(), mine.size() == 1 ? "" : "s", total));
}

}  // namespace strata::tools
