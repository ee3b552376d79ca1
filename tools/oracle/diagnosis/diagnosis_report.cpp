// tools/oracle/diagnosis/diagnosis_report.cpp - the sentences of a diagnosis: the first line by its conclusion, then
// other explanations and hints (diagnosis_report.h).
#include "tools/oracle/diagnosis/diagnosis_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rasterizer/base/enum_values.h"
#include "tools/oracle/compare/report.h"
#include "tools/oracle/compare/report_json.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/suite.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_findings = 6;  // limit of findings in the text

// At most 99.9 unless all of them are counted.
std::string percent(std::uint64_t part, std::uint64_t all) {
    if (part == all) return "100";
    const double share = 100.0 * static_cast<double>(part) / static_cast<double>(all);
    return fmt::format("{:.1f}", std::min(share, 99.9));
}

// ", 2 of them by more than one code"; "" if all do, or none does.
std::string far_of(const Diagnosis& d) {
    if (d.differing_far == 0) return ", all of them by one code";
    return d.differing_far == d.differing ? "" : fmt::format(", {} of them by more than one code", d.differing_far);
}

// Where a picture of several samples per pixel differs.
std::string line_of_edges(const Diagnosis& d) {
    if (!d.at_edges || d.differing == 0) return "";
    if (*d.at_edges == d.differing)
        return fmt::format("  edges only: at all {} pixels that differ the samples have different fragments\n",
                           d.differing);
    return fmt::format("  {} of the {} pixels that differ are at edges, where samples have different fragments\n",
                       *d.at_edges, d.differing);
}

std::string line_of(const Finding& f, const Diagnosis& d) {
    std::string text = fmt::format("  {} % of the pixels are those of: {}\n", percent(f.agreeing, d.pixels),
                                   description_of(f.mistakes));
    if (!f.mistakes.empty() && d.differing > 0)
        text += fmt::format(
            "      explains {} of the {} pixels that differ; contradicted by {} pixels that do not differ\n",
            f.explained, d.differing, f.contradicted);
    return text;
}

// The agreement of the candidate's passes with those of a run; "" if they were not compared.
std::string line_of(const std::optional<PassAgreement>& passes, const std::string& whose) {
    if (!passes) return "";
    if (passes->is_whole())
        return fmt::format("  all {} targets of its passes are those of {}\n", passes->targets, whose);
    return fmt::format("  {} of {} targets of its passes are those of {}; the first that is not: pass {}\n",
                       passes->alike, passes->targets, whose, *passes->first_unlike);
}

ordered_json as_json(const std::optional<PassAgreement>& passes) {
    if (!passes) return nullptr;
    ordered_json object{{"targets", passes->targets}, {"alike", passes->alike}, {"first_unlike", nullptr}};
    if (passes->first_unlike) object["first_unlike"] = *passes->first_unlike;
    return object;
}

ordered_json names_of(const std::vector<const Mistake*>& mistakes) {
    ordered_json names = ordered_json::array();
    for (const Mistake* mistake : mistakes) names.push_back(mistake->name);
    return names;
}

// A port's rounding that no option of a profile has leaves a code or two.
std::string hint_of_tolerance(const Diagnosis& d, const Comparison& comparison) {
    constexpr std::uint32_t few_codes = 2;
    if (d.conclusion != Conclusion::unknown_mistake || comparison.distance_of.empty()) return "";
    const std::uint32_t most = *std::ranges::max_element(comparison.distance_of);
    if (most == 0 || most > few_codes) return "";
    return fmt::format("  it differs by at most {}: --tolerance color={} accepts it\n",
                       most == 1 ? "1 code" : fmt::format("{} codes", most), most);
}

// Peels with mistakes of samples may find layers again without end, and stop anywhere.
std::string hint_of_limit(const Diagnosis& d) {
    const Finding& best = d.findings.front();
    if (!d.at_edges || d.conclusion != Conclusion::unknown_mistake || best.mistakes.empty()) return "";
    if (2 * best.explained < d.differing) return "";
    return "  if the port's peel is stopped by a number of geometry passes, --limit N states it\n";
}

// A mistake with its name; an option of a right run has none that a command takes.
std::string description_of(const Mistake& mistake) {
    const bool is_listed = find_mistake(mistake.name) != nullptr;
    return mistake.description + (is_listed ? " (" + std::string(mistake.name) + ")" : "");
}

}  // namespace

std::string description_of(const std::vector<const Mistake*>& mistakes) {
    if (mistakes.empty()) return "a correct implementation";
    std::string text;
    for (const Mistake* mistake : mistakes) text += (text.empty() ? "" : "; and: ") + description_of(*mistake);
    return text;
}

std::string_view name(Conclusion conclusion) noexcept { return enum_name(conclusion); }

std::string first_line(const Diagnosis& d) {
    const Finding& best = d.findings.front();
    if (d.passes_contradict)
        return fmt::format(
            "none that is known: the picture is that of: {}; but no known renderer that draws it has these passes\n",
            description_of(best.mistakes));
    if (d.conclusion == Conclusion::unknown_mistake && d.is_blank)
        return "none that is known: the picture has one colour everywhere: nothing was drawn, or the picture was never "
               "written, and it does not show why\n";
    if (d.conclusion == Conclusion::unknown_mistake)
        return fmt::format(
            "none that is known: {} of {} pixels differ from the right picture{}, and no known mistake, nor two of "
            "them, "
            "explains them all\n",
            d.differing, d.pixels, far_of(d));
    if (d.conclusion == Conclusion::other_options)
        return fmt::format("right under other options: every pixel is{} that of: {}\n",
                           d.is_nearly ? ", within one code," : "", description_of(best.mistakes));
    return fmt::format("100 % of the pixels are{} those of: {}\n", d.is_nearly ? ", within one code," : "",
                       description_of(best.mistakes));
}

std::string lines_of(const Diagnosis& d, const Comparison& comparison) {
    std::string text = line_of_edges(d);
    const Finding& best = d.findings.front();
    if (!best.mistakes.empty()) text += line_of(best.passes, "this emulation");
    text += line_of(d.right_passes, "a correct implementation");
    text += hint_of_tolerance(d, comparison) + hint_of_limit(d);
    if (d.is_nearly) text += fmt::format("  to the last code: {} of the {} that differ\n", best.explained, d.differing);
    for (const Mistake* mistake : best.alike)
        text += fmt::format("  the same picture of this scene{}: {}\n", best.passes ? ", and passes alike" : "",
                            description_of(*mistake));
    const bool is_none = d.conclusion == Conclusion::unknown_mistake || d.conclusion == Conclusion::right_structure;
    if (d.distinguishing_scene != nullptr)
        text += fmt::format("  the suite's scene {} distinguishes {}: {}\n", d.distinguishing_scene->name,
                            is_none ? "the best of them" : "them", command_of(*d.distinguishing_scene));
    if (d.findings.size() > 1 && d.conclusion != Conclusion::right)
        text += is_none ? "the best:\n" : "the next best:\n";
    for (std::size_t i = is_none ? 0 : 1; i < std::min(d.findings.size(), most_findings); ++i)
        if (d.conclusion != Conclusion::right) text += line_of(d.findings[i], d);
    text += fmt::format(
        "tried: {} mistakes that show in this scene{}; {} that do not show, {} that cannot be made here\n", d.tried,
        d.pairs_tried > 0 ? fmt::format(" and {} pairs", d.pairs_tried) : "", d.hidden, d.impossible);
    if (d.conclusion != Conclusion::right) text += "compare: " + to_text(comparison);
    return text;
}

ordered_json json_of(const Diagnosis& d, const Comparison& comparison) {
    ordered_json document{{"verdict", name(d.conclusion)},
                          {"pixels", d.pixels},
                          {"differing", d.differing},
                          {"differing_at_edges", nullptr},
                          {"tried", d.tried},
                          {"pairs_tried", d.pairs_tried},
                          {"hidden", d.hidden},
                          {"impossible", d.impossible},
                          {"nearly", d.is_nearly},
                          {"one_colour", d.is_blank},
                          {"passes_contradict", d.passes_contradict},
                          {"right_passes", as_json(d.right_passes)},
                          {"distinguishing_scene", nullptr},
                          {"findings", ordered_json::array()}};
    if (d.at_edges) document["differing_at_edges"] = *d.at_edges;
    if (d.distinguishing_scene != nullptr) document["distinguishing_scene"] = d.distinguishing_scene->name;
    for (const Finding& f : d.findings) {
        ordered_json descriptions = ordered_json::array();
        for (const Mistake* mistake : f.mistakes) descriptions.push_back(mistake->description);
        document["findings"].push_back({{"mistakes", names_of(f.mistakes)},
                                        {"sentences", std::move(descriptions)},
                                        {"agreeing", f.agreeing},
                                        {"explained", f.explained},
                                        {"contradicted", f.contradicted},
                                        {"nearly", f.nearly},
                                        {"passes", as_json(f.passes)},
                                        {"alike", names_of(f.alike)}});
    }
    document["comparison"] = json_of(comparison);
    return document;
}

}  // namespace strata::oracle
