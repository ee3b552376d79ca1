// tools/strata/compare_pages.h - what compare leaves beside its text: pages of --report, and the verdicts in colours.
//
// Rule     A page holds what is printed, as a sentence and tables, and reference, candidate and heat map of each
//          picture compared; no path of this machine.
// Tests    tests/tools/compare_test.cpp, tests/browser/plain_pages.py
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/pack/compare_packs.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

// Paths of the command line.
struct ComparedPaths {
    std::string reference, candidate;
};

[[nodiscard]] PlainPage page_of(const ComparedPaths& paths, const oracle::Picture& reference,
                                const oracle::Picture& candidate, const oracle::Comparison& found);

// How far apart two pictures are, with a legend in codes, and which kind is where.
void add_heat_map(PlainPage& page, const oracle::Comparison& found);
// Targets, kinds and known mistakes as tables; "12 of 640 pixels differ, by at most 3 codes."
void add_tables(PlainPage& page, const oracle::Comparison& found);
[[nodiscard]] std::string sentence_of(const oracle::Comparison& found);

// Of a pack and a folder: what an algorithm's pictures show. The end, or, where that is alike, the first pass that is
// not.
struct ShownPair {
    const oracle::Picture& reference;
    const oracle::Picture& candidate;
    const oracle::Comparison& comparison;
    std::string what;  // "" for the end, ", after pass 3"
};
// Empty if the candidate has nothing of the algorithm, or no picture and no pass that differs.
[[nodiscard]] std::optional<ShownPair> shown_pair(const std::vector<oracle::PackPictures>& reference,
                                                  const std::vector<oracle::PackPictures>& candidate,
                                                  const oracle::PackComparison& found);
[[nodiscard]] PlainPage page_of(const ComparedPaths& paths, const std::vector<oracle::PackPictures>& reference,
                                const std::vector<oracle::PackPictures>& candidate,
                                const std::vector<oracle::PackComparison>& found);

// The printed text; where standard output shows colours, the verdict of each line that is not indented is green if it
// is "equal", yellow if differences are accepted, red if it is "different".
[[nodiscard]] std::string with_painted_verdicts(const std::string& text);

}  // namespace strata::tools
