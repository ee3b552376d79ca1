#include "tools/probe/operation_findings.h"

#include <algorithm>
#include <utility>

#include "tools/probe/operation_numbers.h"

namespace strata::probe {

namespace {

bool agree(const Words& a, const Words& b, int lanes) { return std::equal(a.begin(), a.begin() + lanes, b.begin()); }

// Binary32 in order, as integers: neighbours differ by one, and the two zeros do not.
std::int64_t place_of(std::uint32_t word) {
    const auto magnitude = std::int64_t{word & 0x7fffffffu};
    return word >> 31 != 0 ? -magnitude : magnitude;
}
bool is_nan(std::uint32_t word) { return (word & 0x7fffffffu) > 0x7f800000u; }

std::optional<std::uint64_t> units_between(std::uint32_t a, std::uint32_t b) {
    if (is_nan(a) && is_nan(b)) return 0;
    if (is_nan(a) || is_nan(b)) return std::nullopt;
    const std::int64_t distance = place_of(a) - place_of(b);
    return static_cast<std::uint64_t>(distance < 0 ? -distance : distance);
}

std::optional<std::uint64_t> farthest(const Operation& operation, const std::vector<Words>& words) {
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const Words expected = operation.hypotheses.front().result(operation.inputs[i]);
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(operation.lanes); ++lane) {
            const auto units = units_between(words[i][lane], expected[lane]);
            if (!units) return std::nullopt;
            most = std::max(most, *units);
        }
    }
    return most;
}

std::size_t count_of(const Operation& operation, const Hypothesis& rule, const std::vector<Words>& words) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < words.size(); ++i)
        count += agree(rule.result(operation.inputs[i]), words[i], operation.lanes) ? 1 : 0;
    return count;
}

void find_first(const Operation& operation, const std::vector<Words>& words, OperationFinding& finding) {
    const auto best = std::ranges::find(operation.hypotheses, finding.rules.front().name, &Hypothesis::name);
    for (std::size_t i = 0; i < words.size() && !finding.first; ++i) {
        const Words expected = best->result(operation.inputs[i]);
        if (!agree(expected, words[i], operation.lanes)) finding.first = {operation.inputs[i], expected, words[i]};
    }
}

OperationFinding judge(const Operation& operation, const OperationReply& reply) {
    OperationFinding finding{.name = operation.name, .asks = operation.asks, .refusal = reply.refusal};
    if (!reply.words) return finding;
    const std::vector<Words>& words = *reply.words;
    finding.answers = words.size();
    for (const Hypothesis& rule : operation.hypotheses)
        finding.rules.push_back({rule.name, count_of(operation, rule, words)});
    std::ranges::stable_sort(finding.rules, std::greater{}, &RuleCount::agree);
    const auto all = std::ranges::count(finding.rules, words.size(), &RuleCount::agree);
    finding.state = all == 0 ? OperationState::broken : all == 1 ? OperationState::found : OperationState::open;
    find_first(operation, words, finding);
    if (operation.in_units) finding.most_units = farthest(operation, words);
    return finding;
}

}  // namespace

std::string_view name(OperationState state) noexcept {
    constexpr std::array names{"found", "open", "broken", "not drawn"};
    return names[static_cast<std::size_t>(state)];
}

std::vector<OperationFinding> judge(const OperationReplies& replies) {
    std::vector<OperationFinding> findings;
    for (const Operation& operation : operations())
        if (const auto reply = replies.find(operation.name); reply != replies.end())
            findings.push_back(judge(operation, reply->second));
    return findings;
}

std::vector<Likeness> likenesses(const OperationReplies& replies) {
    constexpr std::array pairs{std::pair{"transform", "transform-lit"},
                               std::pair{"transform-invariant", "transform-lit-invariant"},
                               std::pair{"transform", "transform-invariant"}};
    std::vector<Likeness> all;
    for (const auto& [one, other] : pairs) {
        const auto a = replies.find(one), b = replies.find(other);
        if (a == replies.end() || b == replies.end() || !a->second.words || !b->second.words) continue;
        Likeness likeness{one, other, 0, a->second.words->size()};
        for (std::size_t i = 0; i < likeness.answers; ++i)
            likeness.alike += (*a->second.words)[i] == (*b->second.words)[i] ? 1 : 0;
        all.push_back(likeness);
    }
    return all;
}

}  // namespace strata::probe
