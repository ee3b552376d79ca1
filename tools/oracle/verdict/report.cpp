// tools/oracle/verdict/report.cpp - the sentences of a verdict: the first line from its state, then what was excused,
// wrong pixels, and leads (report.h).
#include "tools/oracle/verdict/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tools/oracle/verdict/opposite_edges.h"
#include "tools/oracle/verdict/verdict.h"

namespace strata::oracle::verdict {

namespace {

using nlohmann::ordered_json;

std::string pixels(std::uint64_t n) { return n == 1 ? "1 pixel" : fmt::format("{} pixels", n); }

std::string rounding_of(const CheckedAccount& c) {
    const bool is_in_codes = has_codes(c.account.hypothesis.result.storage);
    const auto number = [&](double n) { return is_in_codes ? fmt::format("{:.0f}", n) : fmt::format("{:.2g}", n); };
    if (c.possible == 0) return "no rounding is left open";
    return fmt::format("rounding at most {}{} where {} {} possible", number(c.observed),
                       !is_in_codes      ? " of 1/255"
                       : c.observed == 1 ? " code"
                                         : " codes",
                       number(c.possible), is_in_codes && c.possible == 1 ? "is" : "are");
}

std::string ties_of(const CheckedAccount& c) {
    return fmt::format("at {} fragments lie at one depth: {}", pixels(c.tied),
                       c.has_one_tie_rule ? describe(c.ties) : "composited by no one rule");
}

std::string excused_of(const CheckedAccount& c) {
    std::vector<std::string> kinds;
    if (c.at_edges > 0)
        kinds.push_back(fmt::format("{} at edges that another rasterizer may cover so{}", c.at_edges,
                                    c.at_edges < fewest_excused_edges ? ", too few to show it" : ""));
    if (c.at_close_depths > 0)
        kinds.push_back(fmt::format(
            "{} where depths differ by at most 2 codes, so that their order and merging are open", c.at_close_depths));
    if (c.lost_at_ties > 0)
        kinds.push_back(fmt::format("{} where fragments of one depth are lost or merged, as peels do{}", c.lost_at_ties,
                                    c.lost_at_ties > 1 && c.lost_at_ties == c.tied ? ": all that show it" : ""));
    return fmt::format("{}", fmt::join(kinds, " and "));
}

// The explanations that have different words. Rules of different kinds may say the same of a scene.
std::vector<const CheckedAccount*> told_apart(const Verdict& v, const pipeline::DrawList& list) {
    std::vector<const CheckedAccount*> all;
    std::set<std::string> told;
    for (const CheckedAccount& c : v.explanations)
        if (told.insert(description(c.account.rules, v.facts, list)).second) all.push_back(&c);
    return all;
}

}  // namespace

std::string first_line(const Verdict& v, const pipeline::DrawList& list) {
    if (!v.finding.empty()) return "wrong: " + v.finding;
    if (v.is_right && !v.equal_to.empty())
        return fmt::format("right: equal to the picture of {} at all {}", v.equal_to, pixels(v.right.pixels));
    // So few pixels at edges do not show whether another rasterizer or another error made them (opposite_edges.h).
    if (v.is_right && v.right.at_edges > 0 && v.right.at_edges < fewest_excused_edges)
        return fmt::format("right, but for {} of {}: {}; {}", v.right.excused(), pixels(v.right.pixels),
                           excused_of(v.right), rounding_of(v.right));
    if (v.state() == State::right_but_excused)
        return fmt::format("right: structure exact at {} of {}, {} excused: {}; {}", v.right.pixels - v.right.excused(),
                           pixels(v.right.pixels), v.right.excused(), excused_of(v.right), rounding_of(v.right));
    if (v.is_right)
        return fmt::format("right: structure exact at all {}; {}", pixels(v.right.pixels), rounding_of(v.right));
    if (v.is_undecided()) return fmt::format("not decided: {}", v.doubt);
    if (v.alpha.state == AlphaState::wrong)
        return fmt::format("wrong: alpha is wrong at {} of {}; the colours are right", v.alpha.wrong_pixels.size(),
                           pixels(v.right.pixels));
    if (v.explanations.empty())
        return fmt::format(
            "wrong: {} of {} have values that no right port reaches, and no single mistake explains them all",
            v.right.wrong_pixels.size(), pixels(v.right.pixels));
    const std::size_t count = told_apart(v, list).size();
    if (count == 1) return "wrong: " + description(v.explanations[0].account.rules, v.facts, list);
    return fmt::format("wrong: one of {} mistakes, which look the same here", count);
}

namespace {

// Pixels with wrong colours, or with wrong alpha if all colours are right.
const std::vector<std::uint32_t>& wrong_pixels(const Verdict& v) {
    return v.right.is_whole() ? v.alpha.wrong_pixels : v.right.wrong_pixels;
}

// The pixels at which a mistake is visible.
std::string reach_of(const CheckedAccount& c, const Verdict& v) {
    const std::uint64_t decided = c.changed - c.undecided;
    std::string text = fmt::format("explains all {} that it affects", pixels(c.changed));
    if (c.undecided > 0) text += fmt::format(" ({} exclude the right colour)", decided);
    return text + fmt::format("; the other {} are right", v.right.pixels - c.changed);
}

std::string lead_of(const Lead& l, const Verdict& v, const pipeline::DrawList& list) {
    return fmt::format("explains {} of {} sampled wrong pixels, contradicts {} of {} sampled right ones: {}",
                       l.explained, l.of, l.contradicted, l.right, description(l.rules, v.facts, list));
}

}  // namespace

std::vector<std::string> leads_of(const Verdict& v, const pipeline::DrawList& list) {
    std::vector<std::string> leads;
    for (const Lead& lead : v.leads) leads.push_back(lead_of(lead, v, list));
    return leads;
}

std::string to_text(const Verdict& v, const pipeline::DrawList& list) {
    std::string text = first_line(v, list) + '\n';
    const auto add = [&](const std::string& line) { text += "  " + line + '\n'; };
    const std::vector<const CheckedAccount*> explanations = told_apart(v, list);
    for (const CheckedAccount* const c : explanations) {
        if (explanations.size() > 1) add(description(c->account.rules, v.facts, list));
        add((explanations.size() > 1 ? "  " : "") + reach_of(*c, v));
    }
    if (!v.distinguishing_command.empty()) add("this scene distinguishes them: " + v.distinguishing_command);
    const CheckedAccount& account = v.explanations.empty() ? v.right : v.explanations[0];
    if (v.equal_to.empty())
        add((v.right.is_whole() || !v.explanations.empty() ? "" : "closest: ") + describe(account.account.hypothesis));
    if (!v.is_right && !v.explanations.empty()) add(rounding_of(account));
    if (account.tied > 0) add(ties_of(account));
    if (account.at_edges > 0)
        add(fmt::format(
            "{} of {} at edges, slivers or depths that nearly meet: as another rasterizer snaps or breaks ties",
            account.at_edges, pixels(account.edges)));
    if (v.shown_at_far_plane > 0)
        add(fmt::format("at {} with fragments at the far plane's depth: all are composited, as without a depth test",
                        pixels(v.shown_at_far_plane)));
    if (const std::string alpha = describe(v.alpha); !alpha.empty()) add(alpha);
    if (const auto& wrong = wrong_pixels(v); !wrong.empty()) {
        const std::uint32_t first = wrong[0], width = static_cast<std::uint32_t>(v.width);
        add(fmt::format("the first wrong pixel is {},{}", first % width, first / width));
    }
    for (const std::string& lead : leads_of(v, list)) add("lead: " + lead);
    if (v.is_stopped) add("the search reached its limit: not all mistakes were tried");
    if (v.explanations.empty() && !v.alike.empty())
        add(
            fmt::format("on this scene {} of {} mistakes have the same picture: strata diagnose --list "
                        "--suite lists scenes that show more of them",
                        v.alike.size(), v.kinds));
    return text;
}

namespace {

ordered_json json_of(const Rule& rule, const Verdict& v, const pipeline::DrawList& list) {
    ordered_json json{{"kind", name(rule.kind)}, {"n", rule.n}};
    if (rule.value != 0) json["value"] = rule.value;
    json["sentence"] = description(rule, v.facts, list);
    return json;
}

ordered_json json_of(const AlphaChecked& alpha) {
    ordered_json json{{"verdict", name(alpha.state)}, {"wrong", alpha.wrong_pixels.size()}};
    if (alpha.state == AlphaState::wrong) json["mistake"] = name(alpha.mistake);
    if (alpha.mistake == AlphaMistake::other_background) json["background"] = alpha.background;
    return json;
}

ordered_json json_of(const CheckedAccount& c, const Verdict& v, const pipeline::DrawList& list) {
    ordered_json json{{"mistakes", ordered_json::array()},
                      {"rounding",
                       {{"hypothesis", describe(c.account.hypothesis)},
                        {"observed", c.observed},
                        {"possible", c.possible},
                        {"slack", c.account.hypothesis.slack},
                        {"bits", c.bits}}},
                      {"at_edges", c.at_edges},
                      {"at_close_depths", c.at_close_depths},
                      {"wrong", c.wrong_pixels.size()},
                      {"changed", c.changed},
                      {"undecided", c.undecided}};
    for (const Rule& rule : c.account.rules) json["mistakes"].push_back(json_of(rule, v, list));
    if (c.tied > 0) json["ties"] = {{"pixels", c.tied}, {"rule", ties_of(c)}};
    return json;
}

}  // namespace

ordered_json json_of(const Verdict& v, const pipeline::DrawList& list) {
    ordered_json document{{"verdict", v.is_right         ? "right"
                                      : v.is_undecided() ? "undecided"
                                                         : "wrong"},
                          {"sentence", first_line(v, list)},
                          {"pixels", v.right.pixels},
                          {"covered", v.right.covered},
                          {"right_structure", json_of(v.right, v, list)},
                          {"explanations", ordered_json::array()},
                          {"leads", ordered_json::array()}};
    for (const CheckedAccount& c : v.explanations) document["explanations"].push_back(json_of(c, v, list));
    for (const Lead& l : v.leads)
        document["leads"].push_back({{"mistake", json_of(l.rules[0], v, list)},
                                     {"explained", l.explained},
                                     {"of", l.of},
                                     {"contradicted", l.contradicted},
                                     {"right", l.right}});
    if (v.right.is_whole() && v.explanations.empty()) document["alpha"] = json_of(v.alpha);
    document["alike"] = ordered_json::array();
    for (const Rule& rule : v.alike) document["alike"].push_back(name(rule.kind));
    document["kinds"] = v.kinds;
    document["stopped"] = v.is_stopped;
    if (v.shown_at_far_plane > 0) document["shown_at_far_plane"] = v.shown_at_far_plane;
    if (!v.distinguishing_command.empty()) document["telling"] = v.distinguishing_command;
    document["first_wrong"] = ordered_json::array();
    constexpr std::size_t most = 16;
    const auto width = static_cast<std::uint32_t>(v.width);
    const std::vector<std::uint32_t>& wrong = wrong_pixels(v);
    for (std::size_t i = 0; i < std::min(most, wrong.size()); ++i)
        document["first_wrong"].push_back({wrong[i] % width, wrong[i] / width});
    return document;
}

}  // namespace strata::oracle::verdict
