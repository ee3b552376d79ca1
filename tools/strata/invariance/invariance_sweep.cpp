#include "tools/strata/invariance/invariance_sweep.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "tools/strata/invariance/invariance_images.h"
#include "tools/strata/invariance/invariance_row.h"
#include "tools/strata/progress.h"
#include "tools/strata/table.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// The beginning that each line of the shard must have.
Lines descriptions(const Sweep& sweep, CellRunner& runner, const Shard& shard) {
    Lines lines;
    for (const std::size_t number : shard.cells(sweep.cells.size()))
        lines.push_back(description(number, sweep.cells[number], runner.view(sweep.cells[number])));
    return lines;
}

// results.csv is made anew from all lines; only the journal grows.
std::string csv_of(const Lines& lines) {
    std::string text = csv_header();
    for (const ordered_json& line : lines) text += to_csv(line);
    return text;
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

// Seconds that a cell took, all of it.
struct Timed {
    CellResult result;
    double seconds = 0;
};

Timed timed_run(CellRunner& runner, const Cell& cell) {
    const auto start = std::chrono::steady_clock::now();
    CellResult result = runner.run(cell);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return {std::move(result), taken.count()};
}

// The journal of an earlier run, held against the plan: a folder belongs to one plan.
Found checked(const std::string& path, const Lines& expected) {
    Found found = read_journal(path);
    check_journal(path, found.lines, expected);
    return found;
}

}  // namespace

int run_sweep(const Sweep& sweep, CellRunner& runner) {
    std::filesystem::create_directories(sweep.folder);
    const std::string results = shard_file(sweep.folder, "results", sweep.shard);
    const std::string timings = shard_file(sweep.folder, "timings", sweep.shard);
    const Lines expected = descriptions(sweep, runner, sweep.shard);
    Found found = checked(results, expected);
    if (found.torn)
        std::fprintf(stderr, "strata: warning: %s: the last line was torn; its cell is measured again\n",
                     results.c_str());
    // A finished sweep writes nothing but its CSV.
    if (found.lines.size() < expected.size()) {
        Journal journal(results, found.whole_bytes), clock(timings, read_journal(timings).whole_bytes);
        Progress progress("invariance", Remaining::shown);
        const auto mine = sweep.shard.cells(sweep.cells.size());
        const std::size_t before = found.lines.size();
        for (std::size_t i = before; i < mine.size(); ++i) {
            progress.show(static_cast<double>(i - before) / static_cast<double>(mine.size() - before));
            const Cell& cell = sweep.cells[mine[i]];
            const Timed timed = timed_run(runner, cell);
            // Pictures and the time are written first: a line in the journal means that its cell is
            // complete.
            if (sweep.images) write_cell_images(sweep.folder, mine[i], timed.result);
            clock.append(
                {{"cell", mine[i]}, {"seconds", timed.seconds}, {"peel_seconds", timed.result.measured.seconds}});
            journal.append(found.lines.emplace_back(to_line(mine[i], cell, timed.result)));
        }
    }
    if (sweep.shard.count > 1) {  // what it found is told when the shards are merged
        print(fmt::format("{}: {} cells; --merge {} puts the shards together\n", results, found.lines.size(),
                          sweep.shard.count));
        return 0;
    }
    scenes::write_file(path_in(sweep.folder, "results.csv"), csv_of(found.lines));
    print(summary(found.lines, sweep.folder));
    return exit_status(found.lines);
}

// Lines go to the places of their cells, so the merged files are those of a sweep in one shard.
int merge_shards(const Sweep& sweep, CellRunner& runner, std::size_t shards) {
    Lines results(sweep.cells.size());
    std::string timings;
    for (std::size_t index = 1; index <= shards; ++index) {
        const Shard shard{index, shards};
        const std::string path = shard_file(sweep.folder, "results", shard);
        const auto cells = shard.cells(sweep.cells.size());
        Found found = checked(path, descriptions(sweep, runner, shard));
        if (found.lines.size() != cells.size())
            throw InputError(path, "lines", std::to_string(cells.size()) + ", one a cell of the shard",
                             std::to_string(found.lines.size()));
        for (std::size_t i = 0; i < cells.size(); ++i) results[cells[i]] = std::move(found.lines[i]);
        // Times are joined shard by shard; each line names its cell.
        for (const ordered_json& line : read_journal(shard_file(sweep.folder, "timings", shard)).lines)
            timings += line.dump() + '\n';
    }
    std::string text;
    for (const ordered_json& line : results) text += line.dump() + '\n';
    scenes::write_file(path_in(sweep.folder, "results.jsonl"), text);
    scenes::write_file(path_in(sweep.folder, "results.csv"), csv_of(results));
    scenes::write_file(path_in(sweep.folder, "timings.jsonl"), timings);
    print(summary(results, sweep.folder));
    return exit_status(results);
}

// Cells of one scene, size and algorithm are taken to last equally long.
void dry_run(const Sweep& sweep, CellRunner& runner) {
    std::map<std::string, double> measured;
    double total = 0;
    const auto mine = sweep.shard.cells(sweep.cells.size());
    for (const std::size_t number : mine) {
        const Cell& cell = sweep.cells[number];
        const ordered_json line = description(number, cell, runner.view(cell));
        const std::string like =
            line["scene"].dump() + line["width"].dump() + line["height"].dump() + line["algorithm"].dump();
        if (!measured.contains(like)) measured[like] = timed_run(runner, cell).seconds;
        total += measured[like];
        print(line.dump() + '\n');
    }
    print(fmt::format("{} cells, about {:.0f} s on this machine\n", mine.size(), total));
}

}  // namespace strata::tools
