// tools/library/folders.cpp - compares the pictures of two folders (strata/compare.h).
#include <nlohmann/json.hpp>

#include "rasterizer/base/input_error.h"
#include "strata/compare.h"
#include "tools/oracle/compare/report_json.h"
#include "tools/oracle/folders/folders_report.h"

namespace strata {
inline namespace v0_1 {

namespace {

// At most `most` patterns; none for an empty text.
std::vector<oracle::NamePattern> patterns_of(const char* field, const std::string& text, std::size_t most) {
    if (text.empty()) return {};
    auto found = oracle::name_patterns(text);
    if (!found || found->size() > most)
        throw InputError("folders", field, "patterns with {name} such as '{name}.png'", "'" + text + "'");
    return std::move(*found);
}

oracle::PictureNames picture_names(const FolderNames& given) {
    oracle::PictureNames names;
    const auto both = patterns_of("names", given.names, 2);
    if (!both.empty()) names.reference = both.front(), names.candidate = both.back();
    names.baselines = patterns_of("baselines", given.baselines, SIZE_MAX);
    return names;
}

}  // namespace

ComparedFolders compare_folders(const std::string& reference, const std::string& candidate,
                                const Tolerances& tolerances, const FolderNames& names) {
    const auto read = [](const std::string& path) { return oracle::read_picture(path); };
    ComparedFolders compared;
    compared.summary =
        oracle::compare_folders({.reference = reference,
                                 .candidate = candidate,
                                 .names = picture_names(names),
                                 .tolerances = tolerances,
                                 .read_reference = read,
                                 .read_candidate = read},
                                [&](oracle::FolderCase&& one) { compared.cases.push_back(std::move(one)); });
    return compared;
}

std::string to_text(const ComparedFolders& compared) {
    std::string text = oracle::first_line(compared.summary) + '\n';
    for (const oracle::FolderCase& one : compared.cases) text += oracle::line_of(one) + '\n';
    return text;
}

std::string to_json(const ComparedFolders& compared) {
    nlohmann::ordered_json cases = nlohmann::ordered_json::array();
    for (const oracle::FolderCase& one : compared.cases) cases.push_back(oracle::json_of(one));
    return oracle::text_of(oracle::json_of(compared.summary, std::move(cases)));
}

std::string to_junit(const ComparedFolders& compared) {
    std::vector<oracle::JunitCase> cases;
    for (const oracle::FolderCase& one : compared.cases) cases.push_back(oracle::junit_case(one));
    return oracle::to_junit(cases);
}

}  // namespace v0_1
}  // namespace strata
