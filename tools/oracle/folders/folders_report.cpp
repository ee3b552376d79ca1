// tools/oracle/folders/folders_report.cpp - words and documents of the comparison of two folders (folders_report.h).
#include "tools/oracle/folders/folders_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scenes/printable.h"
#include "tools/oracle/compare/report_json.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;

template <class Count>
std::string counted(Count number, std::string_view thing) {
    return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

// "1 different, 2 missing"
std::string failed_states(const FolderSummary& summary) {
    std::string text;
    for (std::size_t i = 0; i < case_state_count; ++i) {
        const auto state = static_cast<CaseState>(i);
        if (state == CaseState::equal || state == CaseState::accepted || summary.of(state) == 0) continue;
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", summary.of(state), name(state));
    }
    return text;
}

// The baseline that was fitted, where there are several.
std::string fitted(const FolderCase& one) {
    if (one.references < 2 || one.candidate.empty()) return "";
    return one.is_accepted()
               ? fmt::format(" (baseline {})", scenes::printable(one.reference))
               : fmt::format(" (nearest of {} baselines: {})", one.references, scenes::printable(one.reference));
}

ordered_json json_or_null(const std::string& text) { return text.empty() ? ordered_json(nullptr) : ordered_json(text); }

}  // namespace

std::string counts_of(const FolderSummary& summary) {
    const std::string all = counted(summary.all(), "picture");
    if (summary.failed() > 0)
        return fmt::format("{} of {} fail{}: {}", summary.failed(), all, summary.failed() == 1 ? "s" : "",
                           failed_states(summary));
    const std::size_t accepted = summary.of(CaseState::accepted);
    if (accepted == 0) return all;
    return fmt::format("{} of {} differ{} within the tolerance", accepted, all, accepted == 1 ? "s" : "");
}

std::string first_line(const FolderSummary& summary) {
    const char* const state = summary.failed() > 0                  ? "different"
                              : summary.of(CaseState::accepted) > 0 ? "accepted"
                                                                    : "equal";
    return fmt::format("{}: {}", state, counts_of(summary));
}

std::string words_of(const FolderCase& one) {
    return fmt::format("{}{}{}{}", name(one.state), fitted(one), one.sentence.empty() ? "" : ": ", one.sentence);
}

std::string line_of(const FolderCase& one) { return fmt::format("{}: {}", scenes::printable(one.name), words_of(one)); }

JunitCase junit_case(const FolderCase& one) {
    return {.group = "strata.compare", .name = one.name, .failure = one.is_accepted() ? "" : words_of(one)};
}

ordered_json json_of(const FolderCase& one) {
    return {{"name", one.name},
            {"state", name(one.state)},
            {"accepted", one.is_accepted()},
            {"reference", json_or_null(one.reference)},
            {"candidate", json_or_null(one.candidate)},
            {"references", one.references},
            {"sentence", one.sentence},
            {"comparison", one.comparison ? json_of(*one.comparison) : ordered_json(nullptr)}};
}

ordered_json json_of(const FolderSummary& summary, ordered_json cases) {
    ordered_json states;
    for (std::size_t i = 0; i < case_state_count; ++i) {
        const auto state = static_cast<CaseState>(i);
        states[std::string(name(state))] = summary.of(state);
    }
    return {{"equal", summary.of(CaseState::equal) == summary.all()},
            {"accepted", summary.failed() == 0},
            {"pictures", summary.all()},
            {"failed", summary.failed()},
            {"states", std::move(states)},
            {"left_out", summary.left_out},
            {"cases", std::move(cases)}};
}

}  // namespace strata::oracle
