// tools/lab/sweep/journal.h - the lines of a sweep on disk: appended one by one, and continued after the process was
// killed.
//
// Why      Text rather than SQLite: people and jq read a journal while the sweep writes it, journals of shards are
//          joined by concatenating them, and a killed process loses at most the line that it was writing.
// Rule     A line is a JSON object whose last key, `line_digest`, is the XXH3-128 of the line's text before it. A line
//          with another digest, or none, was changed after it was written, and is ignored. A last line without a
//          newline was truncated when the process was killed. Each line is on disk (fsync) before the next cell runs.
// Tests    tests/tools/sweep_journal_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace strata::tools {

using Lines = std::vector<nlohmann::ordered_json>;

// The value as JSON on one line; bytes that are not UTF-8, which a file name may contain, are replaced.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& value);

// A line of the file, with its digest and its newline. It must have at least one key.
[[nodiscard]] std::string line_text(const nlohmann::ordered_json& line);

// The contents of a journal when it is opened.
struct JournalContents {
    Lines lines;                         // the valid lines, without their digests
    std::vector<std::size_t> numbers{};  // the line number of each in the file, from 1
    std::vector<std::size_t> changed{};  // the numbers of lines that were changed
    bool in_order = true;                // false: a cell was measured after a later one (set by lines_of_cells)
    bool torn = false;                   // the last line has no newline
    // The length of the file up to its last newline, where appending continues.
    std::size_t whole_bytes = 0;
};

// Empty if the file does not exist.
[[nodiscard]] JournalContents read_journal(const std::string& path);

// The expected lines of a journal: `cells` are the shard's, `described[i]` has all keys of cells[i] that are known
// before it runs, `keys` are those of a complete line.
struct Expected {
    std::vector<std::size_t> cells;
    Lines described;
    std::vector<std::string> keys;
};

// The lines, at the indices of their cells; null where there is none. A second line of a cell, and a line with other
// keys, is added to found.changed. Throws InputError for a line of another plan: a folder belongs to one plan.
[[nodiscard]] Lines lines_of_cells(const std::string& path, JournalContents& found, const Expected& expected);

// Appends to a file; each line is on disk when append() returns. Throws SystemError.
class Journal {
  public:
    // Truncates the file to `whole_bytes`: a line appended to a truncated one would be lost with it.
    Journal(const std::string& path, std::size_t whole_bytes);
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;
    ~Journal();
    void append(const nlohmann::ordered_json& line);

  private:
    [[noreturn]] void fail() const;

    std::string path_;
    int descriptor_ = -1;
};

// The text of the lines that are not null, in order.
[[nodiscard]] std::string text_of(const Lines& lines);
// Warns of each ignored line.
void warn_of(const std::string& path, const JournalContents& found);
// Opens a journal for appending after its valid lines. If it has ignored lines, it is rewritten without them first.
[[nodiscard]] Journal journal_behind(const std::string& path, const JournalContents& found, const Lines& whole);

}  // namespace strata::tools
