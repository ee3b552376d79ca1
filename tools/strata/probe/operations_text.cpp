#include "tools/strata/probe/operations_text.h"

#include <fmt/format.h>

#include "tools/probe/operation_findings.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;
using probe::OperationFinding;
using probe::OperationState;

std::string words_text(const probe::Words& words) {
    return fmt::format("{:08x} {:08x} {:08x} {:08x}", words[0], words[1], words[2], words[3]);
}

std::string evidence(const OperationFinding& f) {
    if (f.state == OperationState::not_drawn) return f.refusal;
    std::string text = fmt::format("{} of {}", f.rules.front().agree, f.answers);
    if (f.most_units) text += fmt::format(", at most {} ulp from the definition", *f.most_units);
    return text;
}

std::string others(const OperationFinding& f) {
    std::string text;
    for (std::size_t i = 1; i < f.rules.size() && i < 3; ++i)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", f.rules[i].name, f.rules[i].agree);
    return text;
}

}  // namespace

std::string operations_text(const probe::OperationReplies& replies) {
    const std::vector<OperationFinding> findings = probe::judge(replies);
    if (findings.empty()) return "";
    Table table{{{"operation"}, {"rule"}, {"state"}, {"evidence"}, {"runners-up"}}, {}};
    std::string left;
    for (const OperationFinding& f : findings) {
        table.rows.push_back({f.name, f.rules.empty() ? "" : f.rules.front().name, std::string{probe::name(f.state)},
                              evidence(f), others(f)});
        if (f.first)
            left += fmt::format("not explained: {} of {} answers of {}, first of {}: {} for {}\n",
                                f.answers - f.rules.front().agree, f.answers, f.name, words_text(f.first->input),
                                words_text(f.first->found), words_text(f.first->expected));
    }
    for (const probe::Likeness& l : probe::likenesses(replies))
        left += fmt::format("{} and {}: {} of {} positions alike\n", l.one, l.other, l.alike, l.answers);
    return "\n" + to_text(table) + left;
}

ordered_json operations_json(const probe::OperationReplies& replies) {
    ordered_json all{{"operations", ordered_json::array()}, {"alike", ordered_json::array()}};
    for (const OperationFinding& f : probe::judge(replies)) {
        ordered_json json{{"operation", f.name},
                          {"asks", f.asks},
                          {"state", probe::name(f.state)},
                          {"answers", f.answers},
                          {"rules", ordered_json::array()}};
        for (const probe::RuleCount& rule : f.rules)
            json["rules"].push_back({{"rule", rule.name}, {"agree", rule.agree}});
        json["most_ulp"] = f.most_units ? ordered_json(*f.most_units) : ordered_json{};
        json["first"] = nullptr;
        if (f.first)
            json["first"] = {{"input", words_text(f.first->input)},
                             {"expected", words_text(f.first->expected)},
                             {"found", words_text(f.first->found)}};
        json["reason"] = f.refusal;
        all["operations"].push_back(json);
    }
    for (const probe::Likeness& l : probe::likenesses(replies))
        all["alike"].push_back({{"one", l.one}, {"other", l.other}, {"alike", l.alike}, {"answers", l.answers}});
    return all;
}

}  // namespace strata::tools
