#include "tools/strata/diagnose/diagnosis_page.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "tools/oracle/compare/drawings.h"
#include "tools/oracle/diagnosis/diagnosis_report.h"
#include "tools/oracle/judge/picture_diagnosis.h"
#include "tools/strata/compare/compare_pages.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// Adds a table of the best findings if more than one was tried.
void add_findings(PlainPage& page, const oracle::Diagnosis& found) {
    constexpr std::size_t most_findings = 6;
    if (found.conclusion == oracle::Conclusion::right || found.findings.size() < 2) return;
    Table table{{{"known mistakes"},
                 {"pixels that are the candidate's"},
                 {"differing pixels explained"},
                 {"equal pixels against it"}},
                {}};
    for (const oracle::Finding& f : found.findings) {
        if (table.rows.size() == most_findings) break;
        table.rows.push_back({oracle::description_of(f.mistakes), std::to_string(f.agreeing),
                              std::to_string(f.explained), std::to_string(f.contradicted)});
    }
    page.table(table, "The best of what was tried, of " + std::to_string(found.pixels) + " pixels, " +
                          std::to_string(found.differing) + " of which differ from the right picture");
}

// Adds the printed text up to the comparison, without the best findings, which have a table. The first line is the
// verdict; the other lines are the reasons. A line with deeper indentation continues the line before it.
void add_lines(PlainPage& page, const std::string& text) {
    std::istringstream lines(text);
    std::string description;
    std::getline(lines, description);
    page.lead(description);
    std::vector<std::string> reasons;
    std::size_t usual = std::string::npos;
    bool is_finding = false;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t begin = line.find_first_not_of(' ');
        if (begin == std::string::npos) continue;
        if (line.substr(begin).starts_with("compare:")) break;
        is_finding = line.ends_with("best:") || (is_finding && begin > 0);
        if (is_finding) continue;
        usual = std::min(usual, begin);
        if (begin > usual && !reasons.empty())
            reasons.back() += (reasons.back().ends_with(':') ? " " : "; ") + line.substr(begin);
        else
            reasons.push_back(line.substr(begin));
    }
    page.items(reasons);
}

}  // namespace

PlainPage diagnosis_page(const std::string& command, const oracle::Judgement& judgement,
                         const oracle::Picture& candidate) {
    const oracle::PictureDiagnosis& shown = *judgement.emulations;
    PlainPage page{"Diagnosis", command};
    add_lines(page, judgement.text);
    add_findings(page, shown.found);
    page.heading("Pictures");
    page.begin_pictures();
    page.picture(oracle::as_shown(shown.right), "As it should be");
    page.picture(oracle::as_shown(candidate), "The candidate");
    add_heat_map(page, shown.comparison);
    page.end_pictures();
    if (shown.comparison.equal) return page;
    page.heading("What differs");
    add_tables(page, shown.comparison);
    return page;
}

}  // namespace strata::tools
