#include "tools/lab/cost/cost_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

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

}  // namespace strata::tools
