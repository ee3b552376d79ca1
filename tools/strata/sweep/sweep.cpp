#include "tools/strata/sweep/sweep.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "tools/strata/progress.h"
#include "tools/strata/table.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// The beginning that each line of the shard must have.
Lines descriptions(const Work& work, const Shard& shard) {
    Lines lines;
    for (const std::size_t cell : shard.cells(work.cells)) lines.push_back(work.description(cell));
    return lines;
}

std::string path_in(const std::string& folder, const char* name) {
    return (std::filesystem::path(folder) / name).string();
}

// 2 if every cell was refused.
int exit_status(const Lines& lines) {
    for (const ordered_json& line : lines)
        if (line["outcome"] != "refused") return 0;
    std::fprintf(stderr, "strata: every cell was refused: %s\n", lines[0]["refusal"].get<std::string>().c_str());
    return 2;
}

// The journal of an earlier run, held against the plan: a folder belongs to one plan.
Found checked(const std::string& path, const Lines& expected) {
    Found found = read_journal(path);
    check_journal(path, found.lines, expected);
    return found;
}

// Measures the cells of the shard that have no line yet, and adds their lines to `found`.
void measure_missing(const Work& work, const std::string& folder, const Shard& shard, Found& found) {
    const std::string results = shard_file(folder, "results", shard), timings = shard_file(folder, "timings", shard);
    Journal journal(results, found.whole_bytes), clock(timings, read_journal(timings).whole_bytes);
    Progress progress(work.name, Remaining::shown);
    const auto mine = shard.cells(work.cells);
    const std::size_t before = found.lines.size();
    for (std::size_t i = before; i < mine.size(); ++i) {
        progress.show(static_cast<double>(i - before) / static_cast<double>(mine.size() - before));
        Measured measured = work.measure(mine[i]);
        // Pictures and the time are written first: a line in the journal means that its cell is complete.
        clock.append(measured.timing);
        journal.append(found.lines.emplace_back(std::move(measured.line)));
    }
}

}  // namespace

int run_sweep(const Work& work, const std::string& folder, const Shard& shard) {
    std::filesystem::create_directories(folder);
    const std::string results = shard_file(folder, "results", shard);
    const Lines expected = descriptions(work, shard);
    Found found = checked(results, expected);
    if (found.torn)
        std::fprintf(stderr, "strata: warning: %s: the last line was torn; its cell is measured again\n",
                     results.c_str());
    // A finished sweep writes nothing but its CSV.
    if (found.lines.size() < expected.size()) measure_missing(work, folder, shard, found);
    if (shard.count > 1) {  // what it found is told when the shards are merged
        print(fmt::format("{}: {} cells; --merge {} puts the shards together\n", results, found.lines.size(),
                          shard.count));
        return 0;
    }
    // results.csv is made anew from all lines; only the journal grows.
    scenes::write_file(path_in(folder, "results.csv"), work.csv(found.lines));
    print(work.summary(found.lines));
    return exit_status(found.lines);
}

// Lines go to the places of their cells, so the merged files are those of a sweep in one shard.
int merge_shards(const Work& work, const std::string& folder, std::size_t shards) {
    Lines results(work.cells);
    std::string timings;
    for (std::size_t index = 1; index <= shards; ++index) {
        const Shard shard{index, shards};
        const std::string path = shard_file(folder, "results", shard);
        const auto cells = shard.cells(work.cells);
        Found found = checked(path, descriptions(work, shard));
        if (found.lines.size() != cells.size())
            throw InputError(path, "lines", std::to_string(cells.size()) + ", one a cell of the shard",
                             std::to_string(found.lines.size()));
        for (std::size_t i = 0; i < cells.size(); ++i) results[cells[i]] = std::move(found.lines[i]);
        // Times are joined shard by shard; each line names its cell.
        for (const ordered_json& line : read_journal(shard_file(folder, "timings", shard)).lines)
            timings += line.dump() + '\n';
    }
    std::string text;
    for (const ordered_json& line : results) text += line.dump() + '\n';
    scenes::write_file(path_in(folder, "results.jsonl"), text);
    scenes::write_file(path_in(folder, "results.csv"), work.csv(results));
    scenes::write_file(path_in(folder, "timings.jsonl"), timings);
    print(work.summary(results));
    return exit_status(results);
}

void dry_run(const Work& work, const Shard& shard) {
    std::map<std::string, double> measured;
    double total = 0;
    const auto mine = shard.cells(work.cells);
    for (const std::size_t cell : mine) {
        const std::string like = work.alike(cell);
        if (!measured.contains(like)) measured[like] = work.measure(cell).seconds;
        total += measured[like];
        print(work.description(cell).dump() + '\n');
    }
    print(fmt::format("{} cells, about {:.0f} s on this machine\n", mine.size(), total));
}

}  // namespace strata::tools
