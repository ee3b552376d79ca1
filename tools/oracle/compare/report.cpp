#include "tools/oracle/compare/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scenes/printable.h"
#include "tools/oracle/compare/report_json.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;

std::string in_part(const TargetReport& target) {
    return target.part.empty() ? target.name : fmt::format("{} {}", target.part, target.name);
}

std::string verdict(const Comparison& c) {
    if (c.equal) return "equal";
    const auto pixels = static_cast<std::uint64_t>(c.width) * static_cast<std::uint64_t>(c.height);
    return fmt::format("{}: {} of {} pixels differ", c.accepted ? "accepted" : "different", c.differing, pixels);
}

// The smallest distances: a port with other rounding only has 1 and 2.
std::string histogram(const TargetReport& target) {
    constexpr int most = 8;
    std::string text;
    int shown = 0;
    for (const auto& [distance, pixels] : target.distances) {
        if (shown++ == most) return text + fmt::format(", ... up to {}", target.greatest);
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", distance, pixels);
    }
    return text;
}

std::string share(const Explanation& e) {
    const double percent = 100.0 * static_cast<double>(e.explained) / static_cast<double>(e.of);
    return fmt::format("{:.1f} % of the differing pixels are those of {}{}", percent, e.description,
                       e.contradicted == 0 ? "" : fmt::format("; {} equal pixels speak against it", e.contradicted));
}

}  // namespace

std::string to_text(const Comparison& c) {
    std::string text = verdict(c) + '\n';
    for (const TargetReport& target : c.targets) {
        if (target.differing > 0 && target.greatest == 0)
            text += fmt::format("  target {} ({}): {} pixels differ, all of them by NaN or infinity\n", in_part(target),
                                name(target.reference), target.differing);
        if (target.greatest > 0)
            text += fmt::format(
                "  target {} ({}{}): {} pixels differ by at most {} codes; pixels by codes: {}\n", in_part(target),
                name(target.reference),
                target.candidate == target.reference ? "" : fmt::format(" against {}", name(target.candidate)),
                target.differing, target.greatest, histogram(target));
        if (const std::string numbers = not_finite_of(target); !numbers.empty())
            text += fmt::format("  target {}: {}\n", in_part(target), numbers);
        if (target.rmse) text += fmt::format("  target {}: {}\n", in_part(target), noise_of(target));
    }
    for (const KindReport& kind : c.kinds)
        text += fmt::format("  {}: {} pixels, {} of them beyond the tolerance, first at {},{}{}\n", name(kind.kind),
                            kind.pixels, kind.beyond, kind.first_x, kind.first_y,
                            kind.detail.empty() ? "" : "; " + kind.detail);
    for (const SpentBudget& budget : c.spent)
        text += fmt::format("  {}: {} of {} pixels spent\n", budget.name, budget.pixels, budget.allowed);
    for (const Explanation& e : c.explanations) text += fmt::format("  {}: {}\n", e.mistake, share(e));
    for (const std::string& note : c.notes) text += fmt::format("  {}\n", note);
    for (const std::string& left_out : c.not_compared) text += fmt::format("  not compared: {}\n", left_out);
    return text;
}

ordered_json json_of(const Comparison& c) {
    ordered_json document{{"equal", c.equal},   {"accepted", c.accepted},   {"width", c.width},
                          {"height", c.height}, {"differing", c.differing}, {"targets", ordered_json::array()}};
    for (const TargetReport& target : c.targets) {
        ordered_json distances = ordered_json::array();
        for (const auto& [distance, pixels] : target.distances) distances.push_back({distance, pixels});
        document["targets"].push_back({{"part", target.part},
                                       {"name", target.name},
                                       {"reference", name(target.reference)},
                                       {"candidate", name(target.candidate)},
                                       {"channels", target.channels},
                                       {"differing", target.differing},
                                       {"beyond", target.beyond},
                                       {"greatest", target.greatest},
                                       {"rmse", target.rmse ? ordered_json(*target.rmse) : ordered_json(nullptr)},
                                       {"psnr", target.psnr ? ordered_json(*target.psnr) : ordered_json(nullptr)},
                                       {"distances", std::move(distances)},
                                       {"nan", target.nan.pixels},
                                       {"infinite", target.infinite.pixels}});
    }
    document["kinds"] = ordered_json::array();
    for (const KindReport& kind : c.kinds)
        document["kinds"].push_back({{"kind", name(kind.kind)},
                                     {"pixels", kind.pixels},
                                     {"beyond", kind.beyond},
                                     {"first", {kind.first_x, kind.first_y}},
                                     {"detail", kind.detail}});
    document["explanations"] = ordered_json::array();
    for (const Explanation& e : c.explanations)
        document["explanations"].push_back({{"mistake", e.mistake},
                                            {"sentence", e.description},
                                            {"explained", e.explained},
                                            {"of", e.of},
                                            {"contradicted", e.contradicted}});
    document["spent"] = ordered_json::array();
    for (const SpentBudget& budget : c.spent)
        document["spent"].push_back({{"budget", budget.name}, {"pixels", budget.pixels}, {"allowed", budget.allowed}});
    document["notes"] = c.notes;
    document["not_compared"] = c.not_compared;
    return document;
}

std::string text_of(const ordered_json& document) {
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

std::string to_json(const Comparison& c) { return text_of(json_of(c)); }

std::string noise_of(const TargetReport& target) {
    if (!target.rmse) return "";
    const double rmse = *target.rmse / 255;
    const auto in_steps = [&](int steps) {
        return fmt::format("RMSE {:.3f}/{}, PSNR {:.2f} dB", rmse * steps, steps, *target.psnr);
    };
    switch (target.reference) {
        case Code::unorm8: return fmt::format("RMSE {:.3f}/255, PSNR {:.2f} dB", *target.rmse, *target.psnr);
        case Code::unorm10: return in_steps(1023);
        case Code::unorm16: return in_steps(65535);
        case Code::unorm24: return in_steps(16777215);
        case Code::half:
        case Code::single:
        case Code::integer: break;
    }
    return fmt::format("RMSE {:.6g}, PSNR {:.2f} dB of 1", rmse, *target.psnr);
}

std::string not_finite_of(const TargetReport& target) {
    std::string text;
    const auto add = [&](std::string_view name, const NotFinite& found) {
        if (found.first_x < 0) return;
        text +=
            fmt::format("{}{} at {} pixels of the reference and {} of the candidate, first at {},{}",
                        text.empty() ? "" : "; ", name, found.pixels[0], found.pixels[1], found.first_x, found.first_y);
    };
    add("NaN", target.nan);
    add("infinity", target.infinite);
    return text;
}

std::string failure_of(const KindReport& kind) {
    return fmt::format("{} pixels, first at {},{}{}", kind.beyond, kind.first_x, kind.first_y,
                       kind.detail.empty() ? "" : "; " + kind.detail);
}

std::string to_junit(const std::vector<JunitCase>& cases) {
    const auto failures = std::ranges::count_if(cases, [](const JunitCase& c) { return !c.failure.empty(); });
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    const auto skipped =
        std::ranges::count_if(cases, [](const JunitCase& c) { return c.failure.empty() && c.is_skipped; });
    text += fmt::format("<testsuite name=\"strata compare\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n",
                        cases.size(), failures, skipped);
    for (const JunitCase& c : cases) {
        text += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", scenes::markup_text(c.group),
                            scenes::markup_text(c.name));
        if (!c.failure.empty())
            text += fmt::format(">\n    <failure message=\"{}\"/>\n  </testcase>\n", scenes::markup_text(c.failure));
        else
            text += c.is_skipped ? ">\n    <skipped/>\n  </testcase>\n" : "/>\n";
    }
    return text + "</testsuite>\n";
}

std::string to_junit(const Comparison& c) {
    std::vector<JunitCase> cases;
    for (std::size_t k = 1; k < kind_count; ++k) {
        const auto kind = static_cast<Kind>(k);
        const auto found = std::ranges::find(c.kinds, kind, &KindReport::kind);
        const bool fails = found != c.kinds.end() && found->beyond > 0;
        cases.push_back({"strata.compare", std::string{name(kind)}, fails ? failure_of(*found) : "", !c.is_tested[k]});
    }
    return to_junit(cases);
}

}  // namespace strata::oracle
