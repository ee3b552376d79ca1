// tools/lab/sweep/journal.h - the lines of a sweep on disk: appended one by one, taken up again after a kill.
//
// Rule     A line is a JSON object whose last key, `line_digest`, is the XXH3-128 of the line's text before it. A line
//          of another digest, or of none, was changed since it was written, and counts for nothing. A last line without
//          its newline was torn by a kill. Each line is on the disk (fsync) before the next cell runs.
// Tests    tests/tools/sweep_journal_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace strata::tools {

using Lines = std::vector<nlohmann::ordered_json>;

// The value as JSON on one line; bytes that are no UTF-8, as a file's name may have, are replaced.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& value);

// A line as it stands in the file, with its digest and its newline. It has at least one key.
[[nodiscard]] std::string line_text(const nlohmann::ordered_json& line);

// The contents of a journal when it was opened.
struct Found {
    Lines lines;                         // those that are whole, without their digests
    std::vector<std::size_t> numbers{};  // of each in the file, from 1
    std::vector<std::size_t> changed{};  // the numbers of lines that are not what was written
    bool in_order = true;  // lines_of_cells found each cell behind those before it: a killed run may have measured one
                           // between others
    bool torn = false;     // the file has a last line without newline
    // The length of the file up to its last newline, where appending goes on.
    std::size_t whole_bytes = 0;
};

// Empty if there is no such file.
[[nodiscard]] Found read_journal(const std::string& path);

// What the lines of a journal must be: `cells` are the shard's, `described[i]` is all that is known of cells[i] before
// it runs, `keys` are those of a whole line.
struct Expected {
    std::vector<std::size_t> cells;
    Lines described;
    std::vector<std::string> keys;
};

// The lines at the places of their cells, null where there is none. A second line of a cell, and a line of other keys,
// goes to found.changed. Throws InputError for a line of another plan: a folder belongs to one plan.
[[nodiscard]] Lines lines_of_cells(const std::string& path, Found& found, const Expected& expected);

// Appends to a file; each line is on the disk when append() returns. Throws SystemError.
class Journal {
  public:
    // Cuts off what stands behind `whole_bytes`: a line behind a torn one would be lost with it.
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

// The text of those lines that are there, in order.
[[nodiscard]] std::string text_of(const Lines& lines);
// Warns of each line that counts for nothing.
void warn_of(const std::string& path, const Found& found);
// Opens a journal behind its whole lines. One with lines that count for nothing is written again first.
[[nodiscard]] Journal journal_behind(const std::string& path, const Found& found, const Lines& whole);

}  // namespace strata::tools
