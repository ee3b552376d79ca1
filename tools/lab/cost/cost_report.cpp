#include "tools/lab/cost/cost_report.h"

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

// "1.25 times the time (1.20 to 1.31)" of the default's: the quotient of two ratios to the cheapest cell; or a note
// that the rounds of both overlap.
[[nodiscard]] std::string times_of(const CostRow& row, const CostRow& standard) {
    std::string text;
    if (row.usual && standard.usual) {
        const double unit = standard.usual->median;
        const std::size_t runs = std::min(row.usual->runs, standard.usual->runs);
        text += is_apart(*row.usual, *standard.usual)
                    ? fmt::format(", {:.2f} times the time ({:.2f} to {:.2f})", row.usual->median / unit,
                                  row.usual->least / unit, row.usual->greatest / unit)
                : runs < least_runs
                    ? fmt::format(", {} round{} too few to compare times", runs, runs == 1 ? " is" : "s are")
                    : fmt::format(", no other time beyond the noise of {} rounds", runs);
    }
    if (row.literal && standard.literal && is_apart(*row.literal, *standard.literal))
        text += fmt::format(", run literally {:.2f} times the default's literal time",
                            row.literal->median / standard.literal->median);
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
[[nodiscard]] std::string number(const std::optional<Spread>& s) {
    return s ? fmt::format("{:.6g},{:.6g},{:.6g}", s->median, s->least, s->greatest) : ",,";
}

// RFC 4180: the name of a scene may contain a comma.
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

std::vector<std::string> descriptions_of(const std::vector<CostRow>& rows) {
    const auto defaults = defaults_of(rows);
    std::vector<std::string> descriptions;
    for (const CostRow& row : rows) {
        if (row.knob == "default") continue;
        if (row.is_chain()) {
            descriptions.push_back(chain_sentence(row));
        } else if (!row.refusal.empty()) {
            descriptions.push_back(
                fmt::format("{}: {} {} is refused: {}.", row.scene, row.knob, row.value, row.refusal));
        } else {
            const CostRow& standard = *defaults.at(row.scene);
            descriptions.push_back(fmt::format(
                "{}: {} {}{} instead of the default: {:.4f} % of pixels differ, RMSE {:.6g} instead of {:.6g}{}.",
                row.scene, row.knob, row.value, row.opened.empty() ? "" : fmt::format(" (with {})", row.opened),
                100 * row.from_default, row.rmse, standard.rmse, times_of(row, standard)));
        }
    }
    return descriptions;
}

Table choice_table(const std::vector<CostRow>& rows) {
    Table table{{{"scene"},
                 {"knob"},
                 {"value"},
                 {"pixels that differ, %", Align::right},
                 {"RMSE / 255", Align::right},
                 {"time / default", Align::right},
                 {"literally / default", Align::right},
                 {"card / default", Align::right}},
                {}};
    const auto defaults = defaults_of(rows);
    const auto ratio = [](const std::optional<Spread>& own, const std::optional<Spread>& standard) -> std::string {
        if (!own || !standard) return "-";
        return is_apart(*own, *standard) ? fmt::format("{:.2f}", own->median / standard->median) : "noise";
    };
    for (const CostRow& row : rows) {
        const CostRow& standard = *defaults.at(row.scene);
        const std::string value = row.value + (row.opened.empty() ? "" : " (with " + row.opened + ")");
        if (!row.refusal.empty()) {
            table.rows.push_back({row.scene, row.knob, value, "-", "refused", "-", "-", "-"});
            continue;
        }
        const bool has_card = row.modelled && standard.modelled;
        const bool is_default = &row == &standard;
        table.rows.push_back({row.scene, row.knob, value, fmt::format("{:.4f}", 100 * row.from_default),
                              fmt::format("{:.6g}", row.rmse), is_default ? "1" : ratio(row.usual, standard.usual),
                              is_default ? "1" : ratio(row.literal, standard.literal),
                              has_card ? fmt::format("{:.2f}", *row.modelled / *standard.modelled) : "-"});
    }
    return table;
}

std::string summary_text(const std::vector<CostRow>& rows) {
    std::size_t tried = 0, refused = 0, same = 0, apart = 0;
    const auto defaults = defaults_of(rows);
    for (const CostRow& row : rows) {
        if (row.knob == "default" || row.is_chain()) continue;
        ++tried;
        const CostRow& standard = *defaults.at(row.scene);
        if (!row.refusal.empty()) {
            ++refused;
            continue;
        }
        if (row.from_default == 0) ++same;
        if (row.usual && standard.usual && is_apart(*row.usual, *standard.usual)) ++apart;
    }
    return fmt::format(
        "Of {} choices other than the default, {} change the picture, {} do not, {} are refused; {} take another time "
        "beyond the "
        "noise of the rounds.",
        tried, tried - refused - same, same, refused, apart);
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
    const CostRow* const standard = defaults_of(rows)[scene];
    const auto is_default_again = [&](const CostRow& row) {
        const auto time = column == "default" ? &CostRow::usual : &CostRow::literal;
        return standard != nullptr && &row != standard && column != "modelled" && row.rmse == standard->rmse &&
               row.*time && standard->*time && !is_apart(*(row.*time), *(standard->*time));
    };
    std::vector<CostPoint> points;
    for (const CostRow& row : rows) {
        if (row.scene != scene || row.is_chain() || !row.refusal.empty() || is_default_again(row)) continue;
        std::optional<double> time = row.modelled;
        if (column == "default") time = row.usual ? std::optional(row.usual->median) : std::nullopt;
        if (column == "literal") time = row.literal ? std::optional(row.literal->median) : std::nullopt;
        if (time) points.push_back({*time, row.rmse, row.knob + " " + row.value});
    }
    return points;
}

}  // namespace strata::tools
