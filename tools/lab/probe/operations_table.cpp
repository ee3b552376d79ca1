#include "tools/lab/probe/operations_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;
using probe::HypothesisCount;
using probe::OperationFinding;
using probe::OperationState;

std::string hex(std::uint32_t word) { return fmt::format("{:08x}", word); }

std::string others(const OperationFinding& f) {
    std::string text;
    for (std::size_t i = 1; i < std::min<std::size_t>(f.counts.size(), 3); ++i)
        text += fmt::format("{}{} {}", i == 1 ? "" : "; ", f.counts[i].name, f.counts[i].agree);
    return text;
}

std::vector<std::string> row(const OperationFinding& f) {
    if (f.counts.empty()) return {f.name, "", std::string{name(f.state)}, f.reason, ""};
    const HypothesisCount& best = f.counts.front();
    return {f.name, best.name, std::string{name(f.state)}, fmt::format("{} of {}", best.agree, f.places), others(f)};
}

std::string left_over(const OperationFinding& f) {
    const HypothesisCount& best = f.counts.front();
    const probe::CounterExample& first = *best.first;
    return fmt::format(
        "{}: no hypothesis explains {} of {} words; by \"{}\" number {} of {}, {}, {} is {}, found {}; {} "
        "apart at most\n",
        f.name, f.places - best.agree, f.places, best.name, first.texel, hex(first.inputs[0]), hex(first.inputs[1]),
        hex(first.inputs[2]), hex(first.expected), hex(first.found), best.furthest);
}

ordered_json count_json(const HypothesisCount& count) {
    ordered_json json{
        {"hypothesis", count.name}, {"agree", count.agree}, {"furthest", count.furthest}, {"first", nullptr}};
    if (!count.first) return json;
    json["first"] = {{"texel", count.first->texel}, {"word", count.first->word}, {"inputs", ordered_json::array()}};
    for (const std::uint32_t word : count.first->inputs) json["first"]["inputs"].push_back(hex(word));
    json["first"]["expected"] = hex(count.first->expected);
    json["first"]["found"] = hex(count.first->found);
    return json;
}

}  // namespace

std::string operations_text(const std::vector<OperationFinding>& findings) {
    if (findings.empty()) return "";
    Table table{{{"operation"}, {"hypothesis"}, {"state"}, {"evidence"}, {"runners-up"}}, {}};
    std::string left;
    for (const OperationFinding& f : findings) {
        table.rows.push_back(row(f));
        if (f.state == OperationState::broken) left += left_over(f);
    }
    return to_text(table) + left;
}

ordered_json operations_json(const std::vector<OperationFinding>& findings) {
    ordered_json list = ordered_json::array();
    for (const OperationFinding& f : findings) {
        ordered_json counts = ordered_json::array();
        for (const HypothesisCount& count : f.counts) counts.push_back(count_json(count));
        list.push_back({{"operation", f.name},
                        {"state", name(f.state)},
                        {"places", f.places},
                        {"reason", f.reason},
                        {"hypotheses", counts}});
    }
    return list;
}

}  // namespace strata::tools
