// tools/probe/operation_findings.h - which rule explains what a device computed in a shader.
//
// Rule     A rule agrees with an answer if all lanes that count have its bits. `found`: one rule alone agrees with all answers.
//          `open`: several do. `broken`: none does; the one that agrees with most is named, with the first answer that it does
//          not explain. Of floats it is told how far the answers are at most from the definition, in units in the last place.
// Tests    tests/tools/probe/operations_test.cpp
#pragma once
#include "tools/probe/operation.h"

namespace strata::probe {

enum class OperationState : std::uint8_t { found, open, broken, not_drawn };
[[nodiscard]] std::string_view name(OperationState state) noexcept;

struct RuleCount {
    std::string name{};
    std::size_t agree = 0;
};

struct OperationFinding {
    std::string name{}, asks{};
    OperationState state = OperationState::not_drawn;
    std::size_t answers = 0;
    // The rules, those that agree with most first.
    std::vector<RuleCount> rules{};
    // The first answer that the first of them does not explain.
    struct Contradiction {
        Words input{}, expected{}, found{};
    };
    std::optional<Contradiction> first{};
    // Of floats: the farthest answer from the definition's; none where the two are NaN and a number, or of two signs.
    std::optional<std::uint64_t> most_units{};
    std::string refusal{};
};

[[nodiscard]] std::vector<OperationFinding> judge(const OperationReplies& replies);

// How many answers two operations share that are asked the same: whether a position is computed alike in two programs.
struct Likeness {
    std::string one{}, other{};
    std::size_t alike = 0, answers = 0;
};
[[nodiscard]] std::vector<Likeness> likenesses(const OperationReplies& replies);

}  // namespace strata::probe
