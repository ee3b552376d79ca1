#include "tools/lab/cost/cost_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "peeling/registry.h"
#include "tools/lab/bench/spread.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double number_or(const ordered_json& line, const char* key, double otherwise) {
    const ordered_json& value = line.at(key);
    return value.is_null() ? otherwise : value.get<double>();
}

// Of the time divided by the default's in the same round.
std::optional<Spread> ratio_in(const ordered_json& timing) {
    const ordered_json& s = timing.at("default");
    if (s.is_null()) return std::nullopt;
    return Spread{s["median"], s["least"], s["greatest"], s["rounds"]};
}

std::string error_text(const ordered_json& error) {
    return error.is_null() ? "-" : fmt::format("{:.4g}", error.get<double>());
}

// "1.50 (1.35 to 1.80)", with a question mark where the rounds of both overlap or are too few.
std::string time_text(const std::optional<Spread>& own, const std::optional<Spread>& standard, bool is_default) {
    if (!own) return "-";
    if (is_default) return "1";
    const bool is_sure = standard && is_apart(*own, *standard);
    return fmt::format("{:.2f} ({:.2f} to {:.2f}){}", own->median, own->least, own->greatest, is_sure ? "" : " ?");
}

std::string card_text(const ordered_json& line, const ordered_json& standard) {
    if (line.at("modelled_seconds").is_null() || standard.at("modelled_seconds").is_null()) return "-";
    return fmt::format("{:.2f}", line["modelled_seconds"].get<double>() / standard["modelled_seconds"].get<double>());
}

std::string choice_text(const ordered_json& line) {
    const std::string opened = line.at("opened").get<std::string>();
    return line.at("value").get<std::string>() + (opened.empty() ? "" : " (with " + opened + ")");
}

}  // namespace

Table ranked_table(const Lines& lines, const Lines& timings) {
    std::map<std::string, std::size_t> defaults;  // by scene
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].at("knob") == "default") defaults[lines[i].at("scene")] = i;
    std::vector<std::size_t> order(lines.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank = [&](std::size_t i) {
        const ordered_json& line = lines[i];
        const auto time = ratio_in(timings[i]);
        const double sorted = number_or(line, "sorted_rmse", infinity);
        return std::tuple{defaults.at(line.at("scene")), sorted,
                          sorted == infinity ? infinity : number_or(line, "rmse", infinity),
                          sorted == infinity || !time ? infinity : time->median};
    };
    std::ranges::stable_sort(order, {}, rank);
    const auto right = Align::right;
    Table table{{{"rank", right},
                 {"scene"},
                 {"knob"},
                 {"value"},
                 {"RMSE from sorted", right},
                 {"RMSE from exact", right},
                 {"time / default", right},
                 {"card's time / default", right}},
                {}};
    std::map<std::string, int> ranks;
    for (const std::size_t i : order) {
        const ordered_json& line = lines[i];
        const std::string scene = line.at("scene");
        const std::size_t standard = defaults.at(scene);
        const bool is_ranked = !line.at("sorted_rmse").is_null(), is_refused = line.at("outcome") == "refused";
        table.rows.push_back({is_ranked ? std::to_string(++ranks[scene]) : "-", scene, line.at("knob"),
                              choice_text(line), is_refused ? "refused" : error_text(line.at("sorted_rmse")),
                              error_text(line.at("rmse")),
                              time_text(ratio_in(timings[i]), ratio_in(timings[standard]), i == standard),
                              card_text(line, lines[standard])});
    }
    return table;
}

namespace {

// The row that is_before all others of a scene among those that are meant; null if there is none.
const ordered_json* best_of(const Lines& lines, const Lines& timings, const std::string& scene, auto is_meant,
                            auto rank) {
    const ordered_json* best = nullptr;
    std::size_t at = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const ordered_json& line = lines[i];
        if (line.at("scene") != scene || line.at("sorted_rmse").is_null() || !ratio_in(timings[i]) || !is_meant(line))
            continue;
        if (best != nullptr && !(rank(line, timings[i]) < rank(*best, timings[at]))) continue;
        best = &line;
        at = i;
    }
    return best;
}

}  // namespace

std::string best_rows(const Lines& lines, const Lines& timings) {
    const auto time_of = [](const ordered_json& timing) { return ratio_in(timing)->median; };
    const auto by_error = [&](const ordered_json& line, const ordered_json& timing) {
        return std::tuple{line.at("sorted_rmse").get<double>(), line.at("rmse").get<double>(), time_of(timing)};
    };
    const auto by_time = [&](const ordered_json& line, const ordered_json& timing) {
        return std::tuple{time_of(timing), line.at("sorted_rmse").get<double>()};
    };
    const auto is_algorithm = [](bool exact) {
        return [exact](const ordered_json& line) {
            const auto* const algorithm = peeling::find_algorithm(line.at("algorithm").get<std::string>());
            const std::string knob = line.at("knob");
            return algorithm != nullptr && !algorithm->is_oracle && algorithm->exact == exact &&
                   (knob == "default" || knob == "algorithm");
        };
    };
    std::vector<std::string> scenes;
    for (const ordered_json& line : lines)
        if (std::ranges::find(scenes, line.at("scene").get<std::string>()) == scenes.end())
            scenes.push_back(line.at("scene"));
    std::string text;
    const auto add = [&](const std::string& scene, const char* what, const ordered_json* line) {
        if (line == nullptr) return;
        const auto& timing = timings[static_cast<std::size_t>(line - lines.data())];
        const auto standard = std::ranges::find_if(
            lines, [&](const ordered_json& l) { return l.at("scene") == scene && l.at("knob") == "default"; });
        const auto of_default = standard == lines.end()
                                    ? std::nullopt
                                    : ratio_in(timings[static_cast<std::size_t>(standard - lines.begin())]);
        const bool is_sure = of_default && (&*standard == line || is_apart(*ratio_in(timing), *of_default));
        text += fmt::format("{}, {}: {} {}: RMSE {} from sorted, {} from exact, {:.2f}{} of the default's time\n",
                            scene, what, line->at("knob").get<std::string>(), choice_text(*line),
                            error_text(line->at("sorted_rmse")), error_text(line->at("rmse")), time_of(timing),
                            is_sure ? "" : " (?)");
    };
    for (const std::string& scene : scenes) {
        add(scene, "best exact algorithm", best_of(lines, timings, scene, is_algorithm(true), by_error));
        add(scene, "best approximate algorithm", best_of(lines, timings, scene, is_algorithm(false), by_error));
        add(scene, "least time",
            best_of(
                lines, timings, scene, [](const ordered_json&) { return true; }, by_time));
    }
    return text;
}

}  // namespace strata::tools
