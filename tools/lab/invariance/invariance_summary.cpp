// tools/lab/invariance/invariance_summary.cpp - the table of a sweep's results: columns that differ between cells, and
// a sentence with the values that all cells share (invariance_summary.h).
#include "tools/lab/invariance/invariance_summary.h"

#include <fmt/format.h>

#include <algorithm>

namespace strata::tools {

using nlohmann::ordered_json;

std::string orbit_text(const ordered_json& degrees) {
    return degrees.is_null() ? "" : fmt::format("{:g},{:g}", degrees[0].get<double>(), degrees[1].get<double>());
}

std::string safe_text(const ordered_json& bias) {
    if (bias.is_null()) return "";
    if (!bias.at("safe")) return "none";
    const auto end = [&](const char* key) { return bias.at(key).is_null() ? "" : bias.at(key).dump(); };
    return std::string(end("lowest")) + ".." + end("highest");
}

namespace {

// Nine digits, which identify a binary32 value.
std::string plane_text(const ordered_json& distance) {
    return distance.is_null() ? "" : fmt::format("{:.9g}", distance.get<double>());
}

std::string word_or_number(const ordered_json& line, const char* key) {
    const ordered_json& value = line.at(key);
    return value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump();
}

// The choices that distinguish cells; the parts of a remedy are in its name.
const std::vector<Knob>& every_knob() {
    const auto of = [](const char* key) {
        return [key](const ordered_json& line) { return word_or_number(line, key); };
    };
    static const std::vector<Knob> knobs{
        {"scene", of("scene")},
        {"size", [](const ordered_json& line) { return line.at("width").dump() + "x" + line.at("height").dump(); }},
        {"profile", of("profile")},
        {"algorithm", of("algorithm")},
        {"orbit", [](const ordered_json& line) { return orbit_text(line.at("orbit")); }},
        {"camera", of("camera")},
        {"alpha", of("alpha")},
        {"write", of("write_path")},
        {"compare", of("compare_path")},
        {"depth", of("depth_format")},
        {"subpixel bits", of("subpixel_bits")},
        {"near", [](const ordered_json& line) { return plane_text(line.at("near")); }},
        {"far", [](const ordered_json& line) { return plane_text(line.at("far")); }},
        {"vertex path", of("vertex_path")},
        {"split", of("split")},
        {"hypothesis", of("hypothesis")},
        {"max passes", of("max_passes")},
        {"remedy", of("remedy")}};
    return knobs;
}

}  // namespace

std::vector<Knob> knobs_of(const Lines& lines, Knobs which) {
    std::vector<Knob> chosen;
    for (const auto& [title, text_of] : every_knob()) {
        const std::string first = lines.empty() ? "" : text_of(lines[0]);
        const bool varies =
            std::ranges::any_of(lines, [&](const ordered_json& line) { return text_of(line) != first; });
        if (varies == (which == Knobs::varying) && (varies || !first.empty())) chosen.push_back({title, text_of});
    }
    return chosen;
}

Table summary_table(const Lines& lines) {
    Table table{{{"cell", Align::right}}, {}};
    const std::vector<Knob> knobs = knobs_of(lines, Knobs::varying);
    for (const Knob& knob : knobs) table.columns.push_back({knob.title});
    for (const char* title : {"passes", "differing", "ulp max", "duplicated", "lost", "pixels", "safe bias"})
        table.columns.push_back({title, Align::right});
    table.columns.push_back({"outcome"});
    for (const ordered_json& line : lines) {
        const bool is_refused = line.at("outcome") == "refused";  // nothing was counted: its counts are 0
        std::vector<std::string> row{line.at("cell").dump()};
        for (const Knob& knob : knobs) row.push_back(knob.text_of(line));
        for (const char* key : {"passes", "differing", "ulp_max", "duplicated", "lost", "pixels_touched"})
            row.push_back(is_refused ? "-" : line.at(key).dump());
        const std::string safe = safe_text(line.at("safe_bias"));
        row.push_back(safe.empty() ? "-" : safe);
        row.push_back(line.at("outcome"));
        table.rows.push_back(std::move(row));
    }
    return table;
}

std::string same_everywhere(const Lines& lines) {
    std::string text;
    const auto is_usual = [](const std::string& title, const std::string& value) {
        return (title == "vertex path" && value == "separate") || (title == "split" && value == "none") ||
               (title == "hypothesis" && value == "profile") || (title == "max passes" && value == "0");
    };
    for (const Knob& knob : knobs_of(lines, Knobs::alike))
        if (!is_usual(knob.title, knob.text_of(lines[0])))
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", knob.title, knob.text_of(lines[0]));
    return (lines.size() == 1 ? "" : "in every cell: ") + text;
}

std::string summary_text(const Lines& lines) {
    std::size_t right = 0, wrong = 0, endless = 0, refused = 0, compared = 0;
    for (const ordered_json& line : lines) {
        const std::string outcome = line.at("outcome");
        const bool has_errors = line.at("duplicated").get<std::uint64_t>() + line.at("lost").get<std::uint64_t>() > 0;
        if (outcome == "refused")
            ++refused;
        else if (outcome == "compared")
            ++compared;
        else if (outcome == "never_ends")
            ++endless;
        else
            ++(has_errors ? wrong : right);
    }
    std::string text = fmt::format("Of {} cell{}, {} peel{} every layer once", lines.size(),
                                   lines.size() == 1 ? "" : "s", right, right == 1 ? "s" : "");
    if (wrong > 0)
        text += fmt::format(", {} lose{} or repeat{} layers", wrong, wrong == 1 ? "s" : "", wrong == 1 ? "s" : "");
    if (endless > 0) text += fmt::format(", {} never end{}", endless, endless == 1 ? "s" : "");
    if (compared > 0) text += fmt::format(", {} compare{} depths alone", compared, compared == 1 ? "s" : "");
    if (refused > 0) text += fmt::format(", {} {} refused", refused, refused == 1 ? "is" : "are");
    return text + ".";
}

std::string summary(const Lines& lines, const std::string& folder) {
    constexpr std::size_t most_rows = 50;
    Table table = summary_table(lines);
    if (table.rows.size() > most_rows) table.rows.resize(most_rows);
    const std::string more = lines.size() > most_rows ? fmt::format("and {} more\n", lines.size() - most_rows) : "";
    return summary_text(lines) + '\n' + same_everywhere(lines) + '\n' + to_text(table) + more +
           fmt::format(
               "Rows: {0}/results.csv, {0}/results.jsonl. Page with plots: tools/lab/invariance/report.py {0}\n",
               folder);
}

}  // namespace strata::tools
