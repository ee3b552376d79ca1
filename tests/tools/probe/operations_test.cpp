// Tests the operations of the kit: roundings against exact rationals of Boost.Multiprecision, stencil operations
// against plain loops, and packs changed by hand.
#include "tools/probe/operations.h"

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>

#include "rasterizer/base/input_error.h"
#include "tests/support/own_folder.h"
#include "tools/probe/kit.h"
#include "tools/probe/operations_pack.h"
#include "tools/probe/pack.h"

using namespace strata;
using namespace strata::probe;

namespace {

using Rational = boost::multiprecision::cpp_rational;

float as_float(std::uint32_t word) { return std::bit_cast<float>(word); }
Rational exact(float value) { return Rational{value}; }

const Operation& operation_called(const std::string& name) {
    for (const Operation& o : operations())
        if (o.name == name) return o;
    throw std::runtime_error("no operation " + name);
}

const Hypothesis& hypothesis_called(const Operation& o, const std::string& name) {
    for (const Hypothesis& h : o.hypotheses)
        if (h.name == name) return h;
    throw std::runtime_error("no hypothesis " + name);
}

// No representable number is nearer than `found`, and of two equally near ones it is the even one. `above(m)` has the
// sign of the exact value minus m, so roots need not be computed.
template <class Position>
bool is_nearest(float found, Position above) {
    const Rational low = (exact(found) + exact(std::nextafter(found, -INFINITY))) / 2;
    const Rational high = (exact(found) + exact(std::nextafter(found, INFINITY))) / 2;
    const Rational over_low = above(low), over_high = above(high);
    const bool is_even = (std::bit_cast<std::uint32_t>(found) & 1u) == 0;
    return is_even ? over_low >= 0 && over_high <= 0 : over_low > 0 && over_high < 0;
}

template <class Position>
void check_nearest(const std::string& name, const std::string& hypothesis, Position position) {
    const Operation& o = operation_called(name);
    const Hypothesis& h = hypothesis_called(o, hypothesis);
    std::size_t wrong = 0;
    for (const Texel& t : o.inputs)
        if (!is_nearest(as_float(h.answer(t)[0]), [&](const Rational& middle) { return position(t, middle); })) ++wrong;
    CHECK(wrong == 0);
}

Rational input(const Texel& t, std::size_t k) { return exact(as_float(t[k])); }

}  // namespace

TEST_CASE("fused sums and divisions and roots are the nearest binary32 of the exact value") {
    check_nearest("shader.mul-add", "fused", [](const Texel& t, const Rational& m) {
        return Rational{input(t, 0) * input(t, 1) + input(t, 2) - m};
    });
    check_nearest("shader.division", "correctly rounded",
                  [](const Texel& t, const Rational& m) { return Rational{input(t, 0) / input(t, 1) - m}; });
    check_nearest("shader.reciprocal", "correctly rounded",
                  [](const Texel& t, const Rational& m) { return Rational{1 / input(t, 0) - m}; });
    check_nearest("shader.sqrt", "correctly rounded",
                  [](const Texel& t, const Rational& m) { return Rational{input(t, 0) - m * m}; });
    check_nearest("shader.inversesqrt", "correctly rounded",
                  [](const Texel& t, const Rational& m) { return Rational{1 / input(t, 0) - m * m}; });
}

TEST_CASE("a sum of a rounded product is the nearest of the exact sum of the nearest product") {
    check_nearest("shader.mul-add", "rounded twice", [](const Texel& t, const Rational& m) {
        // The nearest product: double holds the product exactly, so this is the only rounding.
        const float product = static_cast<float>(double{as_float(t[0])} * double{as_float(t[1])});
        return Rational{exact(product) + input(t, 2) - m};
    });
}

TEST_CASE("a comparison with the exact reference and the exact texel agrees where no rounding matters") {
    const Operation& o = operation_called("texture.shadow-d16");
    const Hypothesis& h = o.hypotheses.front();
    std::size_t compared = 0, wrong = 0;
    for (const Texel& t : o.inputs) {
        const Rational reference = input(t, 1), texel = Rational{t[2]} / 65535;
        const Rational apart = reference - texel;
        if (apart * apart < Rational{1, 1u << 30} / 1024 || reference < 0 || reference > 1) continue;
        ++compared;
        wrong += h.answer(t)[0] != (reference <= texel ? 1u : 0u);
    }
    CHECK(compared > 500);
    CHECK(wrong == 0);
}

TEST_CASE("weights of a given number of bits are the nearest or the next lower multiple of their last bit") {
    const Operation& o = operation_called("texture.weights-r16f");
    for (const int count : {4, 8, 11}) {
        std::size_t wrong = 0;
        for (const Texel& t : o.inputs) {
            const Rational steps = (input(t, 0) * 2 - Rational{1, 2}) * (1 << count);
            const Rational cut =
                exact(as_float(hypothesis_called(o, std::to_string(count) + " bits, cut").answer(t)[0]) *
                      std::ldexp(1.0f, count));
            const Rational near =
                exact(as_float(hypothesis_called(o, std::to_string(count) + " bits, nearest").answer(t)[0]) *
                      std::ldexp(1.0f, count));
            if (!(cut <= steps && steps < cut + 1)) ++wrong;
            if (!(near * 2 - 1 <= steps * 2 && steps * 2 <= near * 2 + 1)) ++wrong;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("stencil operations step by one and saturate at 0 and 255 unless they wrap") {
    const Operation& o = operation_called("test.stencil");
    for (const bool wraps : {false, true}) {
        const Hypothesis& h = o.hypotheses[wraps ? 1 : 0];
        for (int op = 0; op < 8; ++op)
            for (const int value : {0, 1, 254, 255}) {
                int next = value;
                if (op == 1) next = 0;
                if (op == 2) next = 165;
                if (op == 3 || op == 6) next = value + 1;
                if (op == 4 || op == 7) next = value - 1;
                if (op == 5) next = 255 - value;
                if (next == 256) next = op == 6 || wraps ? 0 : 255;
                if (next == -1) next = op == 7 || wraps ? 255 : 0;
                int found = 0;
                for (std::uint32_t bit = 0; bit < 8; ++bit)
                    found |= static_cast<int>(
                        h.answer({static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(op), 2, bit})[0]
                        << bit);
                CHECK(found == next);
            }
    }
}

TEST_CASE("every operation has a unique name and whole rows and inputs that distinguish any two of its hypotheses") {
    std::set<std::string> names;
    for (const Operation& o : operations()) {
        INFO(o.name);
        CHECK(names.insert(o.name).second);
        CHECK(o.inputs.size() % static_cast<std::size_t>(o.width) == 0);
        CHECK(o.corners.size() % 3 == 0);
        CHECK(!o.programs.empty());
        for (std::size_t a = 0; a < o.hypotheses.size(); ++a)
            for (std::size_t b = a + 1; b < o.hypotheses.size(); ++b) {
                INFO(o.hypotheses[a].name << " and " << o.hypotheses[b].name);
                CHECK(answer(o, o.hypotheses[a]) != answer(o, o.hypotheses[b]));
            }
    }
}

TEST_CASE("a device that follows one hypothesis is found to follow it") {
    for (const Operation& o : operations())
        for (const Hypothesis& h : o.hypotheses) {
            INFO(o.name << ": " << h.name);
            const OperationFinding finding = judge(o, {.texels = answer(o, h), .refusal = ""});
            CHECK(finding.state == OperationState::inferred);
            CHECK(finding.counts.front().name == h.name);
        }
}

TEST_CASE("one changed value of a result is reported with its operation and texel and inputs") {
    OperationReplies replies = answer_operations();
    (*replies["shader.division"].texels)[77][0] ^= 1;
    for (const OperationFinding& f : judge(replies)) {
        INFO(f.name);
        if (f.name != "shader.division") {
            CHECK(f.state == OperationState::inferred);
            continue;
        }
        CHECK(f.state == OperationState::broken);
        CHECK(f.counts.front().agree == f.places - 1);
        CHECK(f.counts.front().furthest == 1);
        REQUIRE(f.counts.front().first);
        CHECK(f.counts.front().first->texel == 77);
        CHECK(f.counts.front().first->inputs == operation_called("shader.division").inputs[77]);
    }
}

TEST_CASE("results in a pack are read as written and a pack without results has none") {
    const strata::test::OwnFolder folder;
    const std::vector<Item> items{kit().front()};
    ProbePack pack = answer(*pipeline::find_profile("geforce3"), items, {YDirection::up});
    write_pack(pack, items, folder.path() + "/before");
    CHECK(read_pack(folder.path() + "/before", items).operations.empty());
    pack.operations = answer_operations();
    pack.operations["texture.nearest"] = {.texels = std::nullopt, .refusal = "no float textures"};
    write_pack(pack, items, folder.path() + "/now");
    const ProbePack read = read_pack(folder.path() + "/now", items);
    REQUIRE(read.operations.size() == operations().size());
    for (const auto& [name, reply] : pack.operations) {
        INFO(name);
        CHECK(read.operations.at(name).texels == reply.texels);
        CHECK(read.operations.at(name).refusal == reply.refusal);
    }
    CHECK(judge(read.operations).size() == operations().size());
}

TEST_CASE("results of another list or of another shape are rejected") {
    const nlohmann::json other{{"operations", "0000"}};
    CHECK_THROWS_AS(read_operations(other, {}, "pack"), InputError);
    const nlohmann::json ours{{"operations", operations_digest()}};
    const Operation& o = operations().front();
    scenes::NumberArray array = as_array(o, *answer_operations().at(o.name).texels);
    std::swap(array.shape[0], array.shape[2]);
    CHECK_THROWS_AS(read_operations(ours, {{operation_file(o.name), scenes::to_npy(array)}}, "pack"), InputError);
}
