#include "tools/lab/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/unfinished_files.h"
#include "tools/lab/sweep/csv.h"
#include "tools/lab/sweep/leftovers.h"
#include "tools/lab/sweep/lock.h"
#include "tools/strata/messages.h"
#include "tools/strata/progress.h"
#include "tools/strata/report/plain_page.h"
#include "tools/strata/table.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

Expected expected_of(const Work& work, const Shard& shard) {
    Expected expected{.cells = shard.cells(work.cells), .described = {}, .keys = work.keys};
    for (const std::size_t cell : expected.cells) expected.described.push_back(work.description(cell));
    return expected;
}

std::string path_in(const std::string& folder, const char* name) {
    return (std::filesystem::path(folder) / name).string();
}

// 2 if every cell was refused.
int exit_status(const Lines& lines) {
    for (const ordered_json& line : lines)
        if (line["outcome"] != "refused") return 0;
    say_error("every cell was refused: " + lines[0]["refusal"].get<std::string>());
    return 2;
}

// Images that the sweep has written to the folder, by name: 0007.png before 0007.errors.png.
std::vector<std::filesystem::path> pictures_in(const std::string& folder) {
    std::vector<std::filesystem::path> pictures;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".png" || entry.path().extension() == ".svg") pictures.push_back(entry.path());
    std::ranges::sort(pictures, {}, [](const auto& path) { return path.parent_path() / path.stem(); });
    return pictures;
}

// Removes the columns that have one value in every row from a table and returns them as a sentence.
std::string without_constants(Table& table) {
    std::string text;
    for (std::size_t c = table.columns.size(); c-- > 0 && table.rows.size() > 1;) {
        const std::string value = table.rows[0][c];
        if (std::ranges::any_of(table.rows, [&](const auto& row) { return row[c] != value; })) continue;
        if (!value.empty()) text = table.columns[c].title + " " + value + (text.empty() ? "" : ", ") + text;
        const auto at = static_cast<std::ptrdiff_t>(c);
        table.columns.erase(table.columns.begin() + at);
        for (auto& row : table.rows) row.erase(row.begin() + at);
    }
    return text;
}

// One row per cell; a page of thousands of rows is of no use.
void add_cells(PlainPage& page, const std::string& csv) {
    constexpr std::size_t most_rows = 1000;
    page.heading("Cells");
    const auto rows = csv_rows(csv);
    Table table;
    for (const std::string& title : rows[0]) table.columns.push_back({title});
    table.rows.assign(rows.begin() + 1,
                      rows.begin() + 1 + static_cast<std::ptrdiff_t>(std::min(rows.size() - 1, most_rows)));
    if (const std::string alike = without_constants(table); !alike.empty())
        page.paragraph("In every cell: " + alike + ".");
    page.table(table, "A row a cell, as in results.csv");
    if (rows.size() - 1 > most_rows)
        page.paragraph(
            fmt::format("The first {} rows; {} more stand in results.csv.", most_rows, rows.size() - 1 - most_rows));
}

PlainPage page_of(const Work& work, const std::string& folder, const std::string& csv, const Lines& lines) {
    PlainPage page{"strata " + work.name, fmt::format("{} cells; the whole table is results.csv", work.cells)};
    const Findings found = work.findings(lines);
    page.lead(found.lead);
    if (!found.table.rows.empty()) page.table(found.table, found.name);
    page.items(found.items);
    const auto pictures = pictures_in(folder);
    if (!pictures.empty()) page.heading("Pictures");
    for (const auto& picture : pictures)
        page.picture_file(picture.string(), work.caption(picture.lexically_relative(folder).string(), lines));
    add_cells(page, csv);
    return page;
}

// Writes everything that is derived from all lines.
int finish(const Work& work, const std::string& folder, const Lines& lines) {
    const std::string csv = work.csv(lines), summary = work.summary(lines);
    scenes::write_file(path_in(folder, "results.csv"), csv);
    if (!work.report.empty()) write_page(work.report, page_of(work, folder, csv, lines));
    print(summary);
    return exit_status(lines);
}

// The line as the next run reads it, so that results.csv is the same in both cases.
ordered_json as_read(const ordered_json& line) { return ordered_json::parse(json_text(line)); }

// Measures the cells of the shard whose line is null.
void measure_missing(const Work& work, const std::string& folder, const Expected& expected, const Shard& shard,
                     const JournalContents& found, Lines& lines) {
    const std::string results = shard_file(folder, "results", shard), timings = shard_file(folder, "timings", shard);
    const auto missing = std::count(lines.begin(), lines.end(), nullptr);
    bool in_order = found.in_order || !found.changed.empty();  // a changed journal is rewritten
    if (missing == 0 && found.changed.empty() && !found.torn && in_order) return;
    const JournalContents timed = read_journal(timings);
    Journal journal = journal_behind(results, found, lines), clock = journal_behind(timings, timed, timed.lines);
    Progress progress(work.name, Remaining::shown);
    std::ptrdiff_t done = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!lines[i].is_null()) {
            in_order = in_order && done == 0;
            continue;
        }
        progress.show(static_cast<double>(done) / static_cast<double>(missing));
        scenes::set_interrupt_message(fmt::format("{} of {} cells stand in {}; the same command measures the rest",
                                                  lines.size() - static_cast<std::size_t>(missing - done), lines.size(),
                                                  results));
        const MeasuredCell measured = work.measure(expected.cells[i]);
        // Images and times are written first: a line in the journal means that its cell is complete.
        clock.append(measured.timing);
        journal.append(measured.line);
        lines[i] = as_read(measured.line);
        ++done;
    }
    scenes::set_interrupt_message("");
    // If cells in between were missing, their lines are at the end: the finished file is rewritten in order.
    if (!in_order) scenes::write_file(results, text_of(lines));
}

// A folder of results may come from someone else. Files that are truncated, appended to or filled must be in it: a
// journal that is a link would otherwise be truncated at its target.
void refuse_links(const std::string& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool is_ours = name.starts_with("results") || name.starts_with("timings") ||
                             name.starts_with(".results") || name == "images" || name == "pictures";
        if (is_ours && entry.is_symlink())
            throw InputError(entry.path().string(), "file", "a file or folder in its own place", "a link");
    }
}

}  // namespace

int run_sweep(const Work& work, const std::string& folder, const Shard& shard) {
    std::filesystem::create_directories(folder);
    refuse_links(folder);
    const std::string results = shard_file(folder, "results", shard);
    const Lock lock(results);
    remove_leftovers(folder, shard);
    const Expected expected = expected_of(work, shard);
    JournalContents found = read_journal(results);
    Lines lines = lines_of_cells(results, found, expected);
    warn_of(results, found);
    measure_missing(work, folder, expected, shard, found, lines);
    if (shard.count > 1) {  // findings are printed when the shards are merged
        print(fmt::format("{}: {} cells; --merge {} puts the shards together\n", results, lines.size(), shard.count));
        return 0;
    }
    // results.csv is written again from all lines; only the journal is appended to.
    return finish(work, folder, lines);
}

// Lines are put at the indices of their cells, so the merged files equal those of a sweep in one shard.
int merge_shards(const Work& work, const std::string& folder, std::size_t shards) {
    if (!std::filesystem::is_directory(folder))
        throw InputError(folder, fmt::format("no such folder; it is to hold the results of {} shards", shards));
    refuse_links(folder);
    const Lock lock(shard_file(folder, "results", {}));
    Lines results(work.cells);
    std::string timings;
    for (std::size_t index = 1; index <= shards; ++index) {
        const Shard shard{index, shards};
        const std::string path = shard_file(folder, "results", shard);
        const Expected expected = expected_of(work, shard);
        JournalContents found = read_journal(path);
        Lines lines = lines_of_cells(path, found, expected);
        warn_of(path, found);
        const auto missing = static_cast<std::size_t>(std::count(lines.begin(), lines.end(), nullptr));
        if (missing > 0)
            throw InputError(path, "lines", std::to_string(lines.size()) + ", one a cell of the shard",
                             std::to_string(lines.size() - missing));
        for (std::size_t i = 0; i < lines.size(); ++i) results[expected.cells[i]] = std::move(lines[i]);
        // Times are concatenated shard by shard; each line has its cell's number.
        timings += text_of(read_journal(shard_file(folder, "timings", shard)).lines);
    }
    scenes::write_file(path_in(folder, "results.jsonl"), text_of(results));
    scenes::write_file(path_in(folder, "timings.jsonl"), timings);
    return finish(work, folder, results);
}

void dry_run(const Work& work, const Shard& shard) {
    std::map<std::string, double> measured;
    double total = 0;
    const auto mine = shard.cells(work.cells);
    for (const std::size_t cell : mine) {
        const std::string like = work.timing_class(cell);
        if (!measured.contains(like)) measured[like] = work.measure(cell).seconds;
        total += measured[like];
        print(json_text(work.description(cell)) + '\n');
    }
    print(fmt::format("{} cell{}, about {:.0f} s on this machine\n", mine.size(), mine.size() == 1 ? "" : "s", total));
}

}  // namespace strata::tools
