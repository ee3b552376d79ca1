// tools/oracle/pack/compare_packs.cpp - compares a candidate with a pack: picture, layers, and pass by pass until the
// first target that differs (compare_packs.h).
#include "tools/oracle/pack/compare_packs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/oracle/compare/report.h"
#include "tools/oracle/compare/report_json.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;

void count(const Comparison& comparison, PackComparison& to) {
    to.equal &= comparison.equal;
    to.accepted &= comparison.accepted;
}

std::optional<Comparison> compared(const Picture& reference, const Picture& candidate, const Tolerances& tolerances,
                                   const std::string& what, PackComparison& to) {
    if (reference.targets.empty()) return std::nullopt;
    if (candidate.targets.empty()) {
        to.missing.push_back(what);
        return std::nullopt;
    }
    Comparison found = compare(reference, candidate, tolerances);
    count(found, to);
    return found;
}

void compare_passes(const PackPictures& reference, const PackPictures& candidate, const Tolerances& tolerances,
                    PackComparison& to) {
    for (const PassPicture& pass : reference.passes) {
        const auto other = std::ranges::find(candidate.passes, pass.number, &PassPicture::number);
        if (other == candidate.passes.end()) {
            if (pass.has_own) to.missing.push_back(fmt::format("pass {}", pass.number));
            continue;
        }
        Comparison found = compare(pass.targets, other->targets, tolerances);
        // A target after a pass has no background, so codes within the tolerance are accepted at every pixel.
        found.accepted |=
            std::ranges::none_of(found.targets, [](const TargetReport& target) { return target.beyond > 0; });
        to.passes.push_back({pass.number, pass.kind, found.targets});
        count(found, to);
        if (found.accepted || to.first) continue;
        to.first = {pass.number, pass.iteration, pass.kind, std::move(found)};
    }
}

std::string targets_of(const Comparison& comparison) {
    std::string text;
    for (const TargetReport& target : comparison.targets)
        if (target.differing > 0)
            text += fmt::format("{}{} at {} pixels", text.empty() ? "" : ", ", target.name, target.differing);
    return text;
}

// "=", "48:12", "(48:1)".
std::string cell_of(const TargetReport& target) {
    if (target.differing == 0) return "=";
    const std::string apart = fmt::format("{}:{}", target.differing, target.greatest);
    return target.beyond == 0 ? "(" + apart + ")" : apart;
}

std::string padded_line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
    std::string line = " ";
    for (std::size_t i = 0; i < cells.size(); ++i) line += fmt::format(" {:<{}} ", cells[i], widths[i]);
    return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

// One row per pass and one column per target, in the order of first occurrence.
std::string table_of(const PackComparison& c) {
    std::vector<std::vector<std::string>> rows{{"pass", "kind"}};
    for (const ComparedPass& pass : c.passes)
        for (const TargetReport& target : pass.targets)
            if (std::ranges::find(rows[0], target.name) == rows[0].end()) rows[0].push_back(target.name);
    for (const ComparedPass& pass : c.passes) {
        std::vector<std::string> row(rows[0].size(), "-");
        row[0] = std::to_string(pass.number);
        row[1] = pass.kind;
        for (const TargetReport& target : pass.targets)
            row[static_cast<std::size_t>(std::ranges::find(rows[0], target.name) - rows[0].begin())] = cell_of(target);
        rows.push_back(std::move(row));
    }
    std::vector<std::size_t> widths(rows[0].size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text = "  =: equal; N:M: N pixels differ by at most M codes; in brackets: within the tolerance\n";
    for (const auto& row : rows) text += padded_line(row, widths);
    return text;
}

// The targets that are equal after every pass that both have.
std::string equal_targets(const PackComparison& c) {
    std::vector<std::string> equal, unequal;
    for (const ComparedPass& pass : c.passes)
        for (const TargetReport& target : pass.targets) {
            std::vector<std::string>& to = target.differing == 0 ? equal : unequal;
            if (std::ranges::find(to, target.name) == to.end()) to.push_back(target.name);
        }
    std::erase_if(equal, [&](const std::string& name) { return std::ranges::find(unequal, name) != unequal.end(); });
    return fmt::format("{}", fmt::join(equal, ", "));
}

// An image's report, indented by two spaces.
std::string indented(const std::string& text) {
    std::string result = "  ";
    for (std::size_t i = 0; i < text.size(); ++i) {
        result += text[i];
        if (text[i] == '\n' && i + 1 < text.size()) result += "  ";
    }
    return result;
}

ordered_json json_or_null(const std::optional<Comparison>& comparison) {
    return comparison ? json_of(*comparison) : ordered_json(nullptr);
}

}  // namespace

std::vector<PackComparison> compare_packs(const std::vector<PackPictures>& reference,
                                          const std::vector<PackPictures>& candidate, const Tolerances& tolerances) {
    std::vector<PackComparison> all;
    for (const PackPictures& expected : reference) {
        const auto found = std::ranges::find(candidate, expected.algorithm, &PackPictures::algorithm);
        PackComparison comparison{.algorithm = expected.algorithm, .is_there = found != candidate.end()};
        if (!comparison.is_there) {
            all.push_back(std::move(comparison));
            continue;
        }
        comparison.picture = compared(expected.picture, found->picture, tolerances, "picture", comparison);
        comparison.layers = compared(expected.layers, found->layers, tolerances, "layers", comparison);
        compare_passes(expected, *found, tolerances, comparison);
        all.push_back(std::move(comparison));
    }
    return all;
}

namespace {

bool has_difference(const ComparedPass& pass) {
    return std::ranges::any_of(pass.targets, [](const TargetReport& target) { return target.differing > 0; });
}

ordered_json passes_json(const std::vector<ComparedPass>& passes) {
    ordered_json array = ordered_json::array();
    for (const ComparedPass& pass : passes) {
        ordered_json targets = ordered_json::array();
        for (const TargetReport& target : pass.targets)
            targets.push_back({{"name", target.name},
                               {"differing", target.differing},
                               {"beyond", target.beyond},
                               {"greatest", target.greatest},
                               {"rmse", target.rmse ? ordered_json(*target.rmse) : ordered_json(nullptr)}});
        array.push_back({{"number", pass.number}, {"kind", pass.kind}, {"targets", std::move(targets)}});
    }
    return array;
}

}  // namespace

std::string to_text(const std::vector<PackComparison>& comparisons) {
    std::string text;
    for (const PackComparison& c : comparisons) {
        const char* verdict = !c.is_there  ? "not compared: the candidate has nothing of it"
                              : c.equal    ? "equal"
                              : c.accepted ? "within the tolerance"
                                           : "different";
        text += fmt::format("{}: {}\n", c.algorithm, verdict);
        for (const auto& [what, comparison] : {std::pair{"picture", &c.picture}, std::pair{"layers", &c.layers}})
            if (*comparison && !(*comparison)->equal)
                text += fmt::format("  {}:\n{}", what, indented(to_text(**comparison)));
        if (c.first)
            text += fmt::format("  the first pass that differs is {}, a {} pass of iteration {}: {}\n", c.first->number,
                                c.first->kind, c.first->iteration, targets_of(c.first->comparison));
        else if (!c.passes.empty() && c.accepted)
            text += fmt::format("  all {} passes compared are alike\n", c.passes.size());
        if (std::ranges::any_of(c.passes, has_difference)) {
            text += table_of(c);
            if (const std::string equal = equal_targets(c); !equal.empty())
                text += fmt::format("  equal after every pass: {}\n", equal);
        }
        if (!c.missing.empty())
            text += fmt::format("  not compared, for the candidate has none: {}\n", fmt::join(c.missing, ", "));
    }
    return text;
}

std::string to_json(const std::vector<PackComparison>& comparisons) {
    ordered_json document = ordered_json::array();
    for (const PackComparison& c : comparisons) {
        ordered_json first = nullptr;
        if (c.first)
            first = {{"number", c.first->number},
                     {"iteration", c.first->iteration},
                     {"kind", c.first->kind},
                     {"comparison", json_or_null(c.first->comparison)}};
        document.push_back({{"algorithm", c.algorithm},
                            {"is_there", c.is_there},
                            {"equal", c.equal},
                            {"accepted", c.accepted},
                            {"picture", json_or_null(c.picture)},
                            {"layers", json_or_null(c.layers)},
                            {"passes_compared", c.passes.size()},
                            {"passes", passes_json(c.passes)},
                            {"first_pass", std::move(first)},
                            {"missing", c.missing}});
    }
    return document.dump(2) + '\n';
}

namespace {

// The kinds beyond the tolerance, with their numbers of pixels.
std::string failures_of(const Comparison& comparison) {
    std::string text;
    for (const KindReport& kind : comparison.kinds)
        if (kind.beyond > 0)
            text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", name(kind.kind), failure_of(kind));
    return text;
}

JunitCase case_of(const PackComparison& c, const std::string& what, const std::optional<Comparison>& comparison) {
    const bool fails = comparison && !comparison->accepted;
    return {"strata.compare." + c.algorithm, what, fails ? failures_of(*comparison) : "", !comparison};
}

}  // namespace

std::string to_junit(const std::vector<PackComparison>& comparisons) {
    std::vector<JunitCase> cases;
    for (const PackComparison& c : comparisons) {
        cases.push_back(case_of(c, "picture", c.picture));
        cases.push_back(case_of(c, "layers", c.layers));
        cases.push_back({"strata.compare." + c.algorithm, "passes", "", c.passes.empty()});
        if (c.first)
            cases.back().failure = fmt::format("pass {}, a {} pass of iteration {}: {}", c.first->number, c.first->kind,
                                               c.first->iteration, failures_of(c.first->comparison));
    }
    return to_junit(cases);
}

}  // namespace strata::oracle
