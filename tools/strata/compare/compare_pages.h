// tools/strata/compare/compare_pages.h - the outputs of compare besides its plain text: the page of --report, and
// verdicts in colours.
//
// Rule     A page contains the printed text as sentences and tables, and the reference, the candidate and the heat map
//          of each compared picture. It contains no path of this machine.
// Tests    tests/tools/strata/compare/compare_test.cpp, tests/browser/plain_pages.py
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/pack/compare_packs.h"
#include "tools/strata/report/plain_page.h"

namespace strata::tools {

// The paths as given on the command line.
struct ComparedPaths {
    std::string reference, candidate;
};

[[nodiscard]] PlainPage page_of(const ComparedPaths& paths, const oracle::Picture& reference,
                                const oracle::Picture& candidate, const oracle::Comparison& found);

// Adds a heat map of the differences with a legend in codes, and a map of the kinds of differences.
void add_heat_map(PlainPage& page, const oracle::Comparison& found);
// The scale in codes of the heat map before it.
void add_heat_scale(PlainPage& page, const oracle::Comparison& found);
// Adds tables of targets, kinds and known mistakes, and a sentence such as "12 of 640 pixels differ, by at most 3
// codes."
void add_tables(PlainPage& page, const oracle::Comparison& found);
[[nodiscard]] std::string description_of(const oracle::Comparison& found);

// The pictures of one algorithm that the page of a pack shows: the final ones, or, if those are equal, the first pass
// that differs.
struct ShownPair {
    const oracle::Picture& reference;
    const oracle::Picture& candidate;
    const oracle::Comparison& comparison;
    std::string what;      // "" for the final picture, or ", target front after pass 3"
    std::string target{};  // the name of the one to show; "": the colours
};
// Empty if the candidate has no file of the algorithm, or neither a picture nor a pass that differs.
[[nodiscard]] std::optional<ShownPair> shown_pair(const std::vector<oracle::PackPictures>& reference,
                                                  const std::vector<oracle::PackPictures>& candidate,
                                                  const oracle::PackComparison& found);
[[nodiscard]] PlainPage page_of(const ComparedPaths& paths, const std::vector<oracle::PackPictures>& reference,
                                const std::vector<oracle::PackPictures>& candidate,
                                const std::vector<oracle::PackComparison>& found);

// Returns the printed text with colour codes if standard output shows colours. The verdict of each unindented line is
// green if it is "equal", yellow if the differences are accepted, and red if it is "different".
[[nodiscard]] std::string with_painted_verdicts(const std::string& text);

}  // namespace strata::tools
