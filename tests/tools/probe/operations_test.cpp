// Model: for quotients, roots and fused sums numbers of 100 digits, rounded once; for the rest a device that follows one of the
// rules, whose rule must be found, and an answer that is changed.
#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/support/own_folder.h"
#include "tools/probe/kit.h"
#include "tools/probe/operation_findings.h"
#include "tools/probe/pack.h"

namespace {

using namespace strata::probe;
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>>;

const Operation& operation(const std::string& name) { return *std::ranges::find(operations(), name, &Operation::name); }
float value(std::uint32_t word) { return std::bit_cast<float>(word); }

// Inputs whose answer by the rule is not `exact` rounded to binary32.
template <class Value>
int wrong(const Operation& asked, std::size_t rule, Value&& exact) {
    int count = 0;
    for (const Words& input : asked.inputs)
        count += value(asked.hypotheses[rule].result(input)[0]) == exact(input).template convert_to<float>() ? 0 : 1;
    return count;
}

std::size_t number_of(const Operation& asked, const std::string& rule) {
    return static_cast<std::size_t>(std::ranges::find(asked.hypotheses, rule, &Hypothesis::name) -
                                    asked.hypotheses.begin());
}

}  // namespace

TEST_CASE("rules of one rounding round once") {
    const auto x = [](const Words& w, std::size_t k) { return Exact{value(w[k])}; };
    CHECK(wrong(operation("multiply-add"), 1, [&](const Words& w) { return Exact{x(w, 0) * x(w, 1) + x(w, 2)}; }) == 0);
    CHECK(wrong(operation("divide"), 0, [&](const Words& w) { return Exact{x(w, 0) / x(w, 1)}; }) == 0);
    CHECK(wrong(operation("reciprocal"), 0, [&](const Words& w) { return Exact{1 / x(w, 0)}; }) == 0);
    CHECK(wrong(operation("square-root"), 0, [&](const Words& w) { return Exact{sqrt(x(w, 0))}; }) == 0);
    CHECK(wrong(operation("inverse-square-root"), 0, [&](const Words& w) { return Exact{1 / sqrt(x(w, 0))}; }) == 0);
}

TEST_CASE("names of operations are unique, and no two rules of one agree on everything that is asked") {
    std::set<std::string> names;
    for (const Operation& asked : operations()) {
        INFO(asked.name);
        CHECK(names.insert(asked.name).second);
        CHECK(asked.inputs.size() >= 100);
        for (std::size_t a = 0; a < asked.hypotheses.size(); ++a)
            for (std::size_t b = a + 1; b < asked.hypotheses.size(); ++b) {
                INFO(asked.hypotheses[a].name << " and " << asked.hypotheses[b].name);
                CHECK(std::ranges::any_of(asked.inputs, [&](const Words& input) {
                    return asked.hypotheses[a].result(input) != asked.hypotheses[b].result(input);
                }));
            }
    }
}

TEST_CASE("the rule that a device follows is found, whichever it is") {
    for (std::size_t rule = 0; rule < 20; ++rule)
        for (const OperationFinding& finding : judge(answers_by(rule))) {
            const auto& rules = operation(finding.name).hypotheses;
            INFO(finding.name << ": " << rules[std::min(rule, rules.size() - 1)].name);
            CHECK(finding.state == OperationState::found);
            CHECK(finding.rules.front().name == rules[std::min(rule, rules.size() - 1)].name);
            CHECK(finding.rules.front().agree == finding.answers);
            CHECK_FALSE(finding.first);
        }
}

TEST_CASE("one changed answer breaks its operation's evidence, and no other's; the change is shown") {
    OperationReplies replies = answers_by(0);
    (*replies["divide"].words)[77][0] ^= 1;
    for (const OperationFinding& finding : judge(replies)) {
        if (finding.name != "divide") {
            CHECK(finding.state == OperationState::found);
            continue;
        }
        CHECK(finding.state == OperationState::broken);
        CHECK(finding.rules.front().agree == finding.answers - 1);
        REQUIRE(finding.first);
        CHECK(finding.first->input == operation("divide").inputs[77]);
        CHECK((finding.first->expected[0] ^ finding.first->found[0]) == 1);
        CHECK(finding.most_units == 1u);
    }
}

TEST_CASE("positions of two programs are counted alike one by one") {
    OperationReplies replies = answers_by(number_of(operation("transform"), "fused from x to w"));
    (*replies["transform-lit"].words)[3][2] ^= 1;
    const auto all = likenesses(replies);
    REQUIRE(all.size() == 3);
    CHECK(all[0].alike == all[0].answers - 1);
    CHECK(all[1].alike == all[1].answers);
    replies.erase("transform");
    CHECK(likenesses(replies).size() == 1);
}

TEST_CASE("answers to operations are read as they were written; a pack without any, or of others, is told apart") {
    const strata::test::OwnFolder folder;
    ProbePack pack{.made_by = "test", .kit_digest = digest(std::vector<Item>{})};
    const std::string without = folder.path() + "/without", with = folder.path() + "/with",
                      other = folder.path() + "/other";
    write_pack(pack, {}, without);
    CHECK(read_pack(without, {}).operations.empty());
    pack.operations_digest = digest(operations());
    pack.operations = answers_by(1);
    pack.operations["divide"] = {.words = std::nullopt, .refusal = "no quotients"};
    write_pack(pack, {}, with);
    CHECK(read_pack(with, {}).operations == pack.operations);
    pack.operations_digest = "another";
    write_pack(pack, {}, other);
    CHECK_THROWS_WITH(read_pack(other, {}),
                      Catch::Contains("/probe/operations: expected the operations of this program"));
}
