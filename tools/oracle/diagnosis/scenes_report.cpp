// tools/oracle/diagnosis/scenes_report.cpp - a diagnosis of several scenes as text and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/oracle/diagnosis/diagnosis_report.h"
#include "tools/oracle/diagnosis/scenes_diagnosis.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_shown = 6;  // limit of findings in the text

std::ptrdiff_t fitting(const ScenesFinding& f) { return std::ranges::count(f.fits, true); }

std::string verdict_line(const ScenesDiagnosis& d) {
    const ScenesFinding& best = d.findings.front();
    const std::size_t scenes = d.scenes.size();
    if (d.conclusion != Conclusion::unknown_mistake)
        return fmt::format("all {} scenes are those of: {}\n", scenes, description_of(best.mistakes));
    return fmt::format(
        "none that is known: {} of {} pixels differ from the right pictures, and no known mistake, nor two of them, "
        "explains "
        "all {} scenes\n",
        d.differing, d.pixels, scenes);
}

// " (coverage 56, color 218)"
std::string kinds_of(const Comparison& comparison) {
    std::string text;
    for (const KindReport& kind : comparison.kinds)
        text += fmt::format("{}{} {}", text.empty() ? " (" : ", ", name(kind.kind), kind.pixels);
    return text.empty() ? text : text + ")";
}

std::string line_of_scene(const Diagnosis& d, const SceneReport& report, bool fits) {
    const bool is_none = d.conclusion == Conclusion::unknown_mistake;
    return fmt::format("  {}: {} of {} pixels differ{}; by itself {}{}\n", report.name, d.differing, d.pixels,
                       kinds_of(report.comparison),
                       is_none ? "none that is known" : description_of(d.findings.front().mistakes),
                       fits ? "" : "; not what is named above");
}

ordered_json names_in(const std::vector<const Mistake*>& mistakes) {
    ordered_json names = ordered_json::array();
    for (const Mistake* mistake : mistakes) names.push_back(mistake->name);
    return names;
}

ordered_json kinds_in(const Comparison& comparison) {
    ordered_json kinds = ordered_json::array();
    for (const KindReport& kind : comparison.kinds)
        kinds.push_back({{"kind", name(kind.kind)}, {"pixels", kind.pixels}});
    return kinds;
}

}  // namespace

std::string to_text(const ScenesDiagnosis& d, const std::vector<SceneReport>& reports) {
    const ScenesFinding& best = d.findings.front();
    const bool is_none = d.conclusion == Conclusion::unknown_mistake;
    std::string text = verdict_line(d);
    for (const Mistake* mistake : best.alike)
        text += fmt::format("  the same in all of them: {} ({})\n", mistake->description, mistake->name);
    for (std::size_t i = 0; i < d.scenes.size(); ++i)
        text += line_of_scene(d.scenes[i], reports[i], is_none || best.fits[i]);
    if (d.conclusion == Conclusion::right) return text;
    const std::size_t first = is_none ? 0 : 1, end = std::min(d.findings.size(), most_shown);
    if (first < end) text += is_none ? "the best:\n" : "the next best:\n";
    for (std::size_t i = first; i < end; ++i)
        text += fmt::format("  {} of {} scenes: {}\n", fitting(d.findings[i]), d.scenes.size(),
                            description_of(d.findings[i].mistakes));
    return text;
}

std::string to_json(const ScenesDiagnosis& d, const std::vector<SceneReport>& reports) {
    ordered_json document{{"verdict", name(d.conclusion)},
                          {"pixels", d.pixels},
                          {"differing", d.differing},
                          {"scenes", ordered_json::array()},
                          {"findings", ordered_json::array()}};
    for (std::size_t i = 0; i < d.scenes.size(); ++i)
        document["scenes"].push_back({{"name", reports[i].name},
                                      {"verdict", name(d.scenes[i].conclusion)},
                                      {"pixels", d.scenes[i].pixels},
                                      {"differing", d.scenes[i].differing},
                                      {"mistakes", names_in(d.scenes[i].findings.front().mistakes)},
                                      {"kinds", kinds_in(reports[i].comparison)}});
    for (const ScenesFinding& f : d.findings) {
        ordered_json descriptions = ordered_json::array(), fits = ordered_json::array();
        for (const Mistake* mistake : f.mistakes) descriptions.push_back(mistake->description);
        for (const bool fit : f.fits) fits.push_back(fit);
        document["findings"].push_back({{"mistakes", names_in(f.mistakes)},
                                        {"sentences", std::move(descriptions)},
                                        {"fits", std::move(fits)},
                                        {"explained", f.explained},
                                        {"targets_alike", f.targets_alike},
                                        {"alike", names_in(f.alike)}});
    }
    return document.dump(2) + '\n';
}

}  // namespace strata::oracle
