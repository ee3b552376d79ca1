#include "tools/probe/operation.h"

namespace strata::probe {

const std::vector<Operation>& operations() {
    static const std::vector<Operation> all = [] {
        std::vector<Operation> list;
        add_arithmetic(list);
        add_conversions(list);
        add_lookups(list);
        add_transforms(list);
        return list;
    }();
    return all;
}

OperationReplies answers_by(std::size_t hypothesis) {
    OperationReplies replies;
    for (const Operation& operation : operations()) {
        const Hypothesis& rule = operation.hypotheses[std::min(hypothesis, operation.hypotheses.size() - 1)];
        std::vector<Words> words;
        for (const Words& input : operation.inputs) words.push_back(rule.result(input));
        replies[operation.name].words = std::move(words);
    }
    return replies;
}

}  // namespace strata::probe
