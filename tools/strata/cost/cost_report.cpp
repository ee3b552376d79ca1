#include "tools/strata/cost/cost_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace strata::tools {

namespace {

// The default row of each scene.
[[nodiscard]] std::map<std::string, const CostRow*> defaults_of(const std::vector<CostRow>& rows) {
    std::map<std::string, const CostRow*> defaults;
    for (const CostRow& row : rows)
        if (row.knob == "default") defaults[row.scene] = &row;
    return defaults;
}

// "1.25 times the time (1.20 to 1.31)" of the default's: the quotient of two ratios to the cheapest cell.
[[nodiscard]] std::string times_of(const CostRow& row, const CostRow& standard) {
    std::string text;
    if (row.usual && standard.usual) {
        const double unit = standard.usual->median;
        text += fmt::format(", {:.2f} times the time ({:.2f} to {:.2f})", row.usual->median / unit,
                            row.usual->least / unit, row.usual->greatest / unit);
    }
    if (row.literal && standard.usual)
        text += fmt::format(", literally {:.2f} times the cheapest literal one", row.literal->median);
    if (row.modelled && standard.modelled)
        text += fmt::format(", {:.2f} times the card's", *row.modelled / *standard.modelled);
    return text;
}

[[nodiscard]] std::string chain_sentence(const CostRow& row) {
    if (row.value == "machine")
        return fmt::format("{}: the chain as the machine has it is RMSE {:.6g} from the truth.", row.scene, row.rmse);
    if (row.knob == "alone")
        return fmt::format("{}: {} exact alone leaves RMSE {:.6g}.", row.scene, row.value, row.rmse);
    return fmt::format("{}: the chain exact up to {} leaves RMSE {:.6g}.", row.scene, row.value, row.rmse);
}

[[nodiscard]] std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : "";
}
[[nodiscard]] std::string number(const std::optional<TimeSpread>& s) {
    return s ? fmt::format("{:.6g},{:.6g},{:.6g}", s->median, s->least, s->greatest) : ",,";
}

// RFC 4180: the name of a scene may hold a comma.
[[nodiscard]] std::string csv_word(const std::string& word) {
    return word.find(',') == std::string::npos ? word : '"' + word + '"';
}

}  // namespace

std::vector<std::size_t> frontier_of(const std::vector<CostPoint>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].time != points[b].time ? points[a].time < points[b].time : points[a].error < points[b].error;
    });
    std::vector<std::size_t> frontier;
    for (const std::size_t i : order)
        if (frontier.empty() || points[i].error < points[frontier.back()].error) frontier.push_back(i);
    return frontier;
}

std::vector<std::string> sentences_of(const std::vector<CostRow>& rows) {
    const auto defaults = defaults_of(rows);
    std::vector<std::string> sentences;
    for (const CostRow& row : rows) {
        if (row.knob == "default") continue;
        if (row.is_chain()) {
            sentences.push_back(chain_sentence(row));
        } else if (!row.refusal.empty()) {
            sentences.push_back(fmt::format("{}: {} {} is refused: {}.", row.scene, row.knob, row.value, row.refusal));
        } else {
            const CostRow& standard = *defaults.at(row.scene);
            sentences.push_back(fmt::format(
                "{}: {} {}{} instead of the default: {:.4f} % of pixels differ, RMSE {:.6g} instead of {:.6g}{}.",
                row.scene, row.knob, row.value, row.opened.empty() ? "" : fmt::format(" (with {})", row.opened),
                100 * row.from_default, row.rmse, standard.rmse, times_of(row, standard)));
        }
    }
    return sentences;
}

std::string table_csv(const std::vector<CostRow>& rows) {
    std::string text =
        "scene,knob,value,outcome,rmse,from_default,default,default_least,default_greatest,literal,literal_least,"
        "literal_greatest,modelled\n";
    for (const CostRow& row : rows)
        text += fmt::format("{},{},{},{},{:.6g},{:.6g},{},{},{}\n", csv_word(row.scene), row.knob, row.value,
                            row.refusal.empty() ? "done" : "refused", row.rmse, row.from_default, number(row.usual),
                            number(row.literal), number(row.modelled));
    return text;
}

std::vector<CostPoint> points_of(const std::vector<CostRow>& rows, const std::string& scene,
                                 const std::string& column) {
    std::vector<CostPoint> points;
    for (const CostRow& row : rows) {
        if (row.scene != scene || row.is_chain() || !row.refusal.empty()) continue;
        std::optional<double> time = row.modelled;
        if (column == "default") time = row.usual ? std::optional(row.usual->median) : std::nullopt;
        if (column == "literal") time = row.literal ? std::optional(row.literal->median) : std::nullopt;
        if (time) points.push_back({*time, row.rmse, row.knob + " " + row.value});
    }
    return points;
}

}  // namespace strata::tools
