// tools/strata/sweep/journal.h - the lines of a sweep on disk: appended one by one, taken up again
// after a kill, merged.
//
// Rule     results.jsonl holds a line a cell in the order of the cells, so it is always a beginning of the finished
//          file. A last line without its newline was torn by a kill: it is cut off, and its cell measured again.
//          Every other line must be the one that this plan would write there.
// Tests    tests/tools/sweep_journal_test.cpp
#pragma once
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace strata::tools {

using Lines = std::vector<nlohmann::ordered_json>;

// The contents of a journal when it was opened.
struct Found {
    Lines lines;
    bool torn = false;  // the file has a last line without newline
    // The length of the file up to its last newline, where appending goes on.
    std::size_t whole_bytes = 0;
};

// Nothing if there is no such file. Throws InputError where a whole line is no JSON object.
[[nodiscard]] Found read_journal(const std::string& path);

// Throws InputError where a line is not what its cell's description, in `expected`, begins with.
void check_journal(const std::string& path, const Lines& lines, const Lines& expected);

// Cuts off what is torn and appends; each line is on disk when append() returns. Throws SystemError.
class Journal {
  public:
    Journal(const std::string& path, std::size_t whole_bytes);
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;
    ~Journal();
    void append(const nlohmann::ordered_json& line);

  private:
    std::string path_;
    std::FILE* file_ = nullptr;
};

}  // namespace strata::tools
