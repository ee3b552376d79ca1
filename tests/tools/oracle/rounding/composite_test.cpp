// Tests the intervals of pixel values against integer arithmetic for blends of 8-bit codes, and otherwise against
// port_model.h, which blends step by step like a port.
#include "tools/oracle/rounding/composite.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/tools/oracle/verdict/port_model.h"

using namespace strata::oracle::verdict;
using strata::test::PortModel;

namespace {

int code_of(double v) { return static_cast<int>(std::lround(v * 255)); }

Hypothesis of_codes(Order order, SourceRounding source, Rounding rounding) {
    const End end{Storage::unorm8, source, rounding};
    return {.order = order,
            .front = end,
            .back = end,
            .result = {Storage::unorm8, SourceRounding::unrounded, Rounding::nearest}};
}

float value(int code) { return static_cast<float>(code) / 255.0f; }

Stack one_layer(int s, int a, int d) {
    return {.layers = {{.color = {value(s), value(s), value(s), value(a)}}},
            .background = {value(d), value(d), value(d), 1}};
}

// The number of combinations of source, alpha and target (every `step`-th target) for which one layer reaches any code
// but the one that integer arithmetic gives.
std::uint64_t strays_of_one_layer(Rounding rounding, int step, int (*model)(int t)) {
    const Compositor compositor{of_codes(Order::over, SourceRounding::stored, rounding)};
    std::uint64_t strays = 0;
    for (int s = 0; s < 256; ++s)
        for (int a = 0; a < 256; ++a)
            for (int d = 0; d < 256; d += step) {
                const ReachableColor reach = compositor.reach(one_layer(s, a, d));
                const int wanted = model(s * a + d * (255 - a));
                strays += code_of(reach[0].low) == wanted && code_of(reach[0].high) == wanted ? 0 : 1;
            }
    return strays;
}

int nearest_code(int t) { return (2 * t + 255) / 510; }
int cut_code(int t) { return t / 255; }

Stack random_stack(std::mt19937_64& random, std::size_t most) {
    const auto unit = [&] {
        // Every fourth number is a code or the middle of two codes, where rounding decides.
        const auto n = static_cast<float>(random() >> 40) * 0x1p-24f;
        return random() % 4 == 0 ? static_cast<float>(random() % 511) / 510.0f : n;
    };
    Stack stack;
    const std::size_t layers = random() % (most + 1);
    for (std::size_t i = 0; i < layers; ++i) stack.layers.push_back({.color = {unit(), unit(), unit(), unit()}});
    stack.background = {unit(), unit(), unit(), 1};
    stack.near = (layers + 1) / 2;
    stack.near_without_middle = layers / 2;
    return stack;
}

struct Outside {
    std::uint64_t pixels = 0;
    std::string first{};
};

std::vector<Hypothesis> all_of(Storage result) {
    std::vector<Hypothesis> all;
    for (const HypothesisFamily& family : families(result, {0}, Looseness::loose))
        all.insert(all.end(), family.members.begin(), family.members.end());
    return all;
}

// Counts the random lists, `lists` per hypothesis, whose model result is outside the interval.
Outside outside_of(Storage result, int lists, std::uint64_t seed) {
    Outside outside;
    std::mt19937_64 random{seed};
    for (const Hypothesis& h : all_of(result)) {
        const Compositor compositor{h};
        PortModel port{h, seed};
        for (int i = 0; i < lists; ++i) {
            const Stack stack = random_stack(random, 12);
            const auto value = port.composite(stack);
            const ReachableColor reach = compositor.reach(stack);
            bool is_inside = holds(reach, value);
            for (std::size_t c = 0; c < 4; ++c)
                is_inside &= value[c] >= reach[c].low - 1e-12 && value[c] <= reach[c].high + 1e-12;
            if (!is_inside && outside.pixels++ == 0) outside.first = describe(h);
        }
    }
    return outside;
}

}  // namespace

// Two layers over a background; the expected red for each mixing is worked out by hand.
TEST_CASE("each variant of blending reaches the value that is worked out by hand and no other") {
    const End floats{Storage::single, SourceRounding::unrounded, Rounding::nearest};
    const Compositor under{{.order = Order::under, .front = floats, .back = floats, .result = floats}};
    Stack stack{.layers = {{.color = {1, 0, 0, 0.25f}}, {.color = {0.5f, 0, 0, 0.75f}}}, .background = {1, 1, 1, 1}};
    const auto red = [&](const Mixing& mixing) {
        stack.mixing = mixing;
        const Interval found = under.reach(stack)[0];
        CHECK(found.high - found.low < 1e-5);
        return (found.low + found.high) / 2;
    };
    using Through = Mixing::Through;
    using Behind = Mixing::Behind;
    CHECK(red({}) == Approx(0.25 + 0.75 * 0.375 + 0.1875));
    CHECK(red({.through = Through::squared}) == Approx(0.25 + 0.9375 * 0.375 + 0.9375 * 0.4375));
    CHECK(red({.through = Through::summed}) == Approx(0.25 + 0.75 * 0.375));
    CHECK(red({.behind = Behind::twice}) == Approx(0.25 + 0.75 * 0.375 + 0.1875 * 0.1875));
    CHECK(red({.behind = Behind::inverted}) == Approx(0.25 + 0.75 * 0.375 + 0.8125));
    CHECK(red({.attenuates = false}) == Approx(0.25 + 0.375 + 0.1875));
    // With two bits 0.25 is 1/3 and 0.75 is 2/3; 1/3 + 2/3 of 0.4 is 0.6 and becomes 2/3; 2/3 of 0.2 becomes 0.
    stack.layers[1].color[3] = 0.8f;
    CHECK(red({.color_bits = 2, .weight_bits = 2}) == Approx(2.0 / 3));
    const Compositor over{{.order = Order::over, .front = floats, .back = floats, .result = floats}};
    stack.mixing = {.behind = Behind::twice};
    CHECK(over.reach(stack)[0].low > over.reach(stack)[0].high);  // there is no front accumulator for this mixing
    // 0.25 is multiplied by alpha already; 1 - 0.5^2 of white is behind it.
    const Stack premultiplied{.layers = {{.color = {0.25f, 0, 0, 0.5f}, .is_premultiplied = true}},
                              .background = {1, 1, 1, 1},
                              .mixing = {.through = Through::squared}};
    CHECK(over.reach(premultiplied)[0].holds(0.25 + 0.75));
    CHECK(over.reach(premultiplied)[0].low > 0.999);
}

TEST_CASE("one layer of 8-bit codes reaches exactly the code that integer arithmetic gives") {
    CHECK(strays_of_one_layer(Rounding::nearest, 15, nearest_code) == 0);
    CHECK(strays_of_one_layer(Rounding::truncated, 15, cut_code) == 0);
}

TEST_CASE("one layer of 8-bit codes reaches the code of integer arithmetic for every source and alpha and target",
          "[exhaustive]") {
    CHECK(strays_of_one_layer(Rounding::nearest, 1, nearest_code) == 0);
    CHECK(strays_of_one_layer(Rounding::truncated, 1, cut_code) == 0);
}

TEST_CASE("two layers of 8-bit codes reach exactly the code that integer arithmetic gives") {
    const Compositor over{of_codes(Order::over, SourceRounding::stored, Rounding::nearest)};
    std::uint64_t strays = 0;
    for (int s = 0; s < 256; s += 17)
        for (int a = 0; a < 256; a += 17)
            for (int t = 0; t < 256; t += 17)
                for (int b = 0; b < 256; b += 17)
                    for (int d = 3; d < 256; d += 50) {
                        Stack stack = one_layer(s, a, d);
                        stack.layers.push_back({.color = {value(t), value(t), value(t), value(b)}});
                        const int behind = nearest_code(t * b + d * (255 - b));
                        const int wanted = nearest_code(s * a + behind * (255 - a));
                        const ReachableColor reach = over.reach(stack);
                        strays += code_of(reach[0].low) == wanted && code_of(reach[0].high) == wanted ? 0 : 1;
                    }
    CHECK(strays == 0);
}

TEST_CASE("the results of ports of every format and order and rounding are inside the interval of their hypothesis") {
    for (const Storage result : {Storage::unorm8, Storage::unorm16, Storage::half, Storage::single}) {
        const Outside outside = outside_of(result, 20, 7);
        INFO(name(result) << ": " << outside.first);
        CHECK(outside.pixels == 0);
    }
}

TEST_CASE("the results of ports are inside the interval of their hypothesis for ten million lists", "[exhaustive]") {
    for (const Storage result : {Storage::unorm8, Storage::unorm16, Storage::half, Storage::single}) {
        const int lists = static_cast<int>(2'500'000 / all_of(result).size()) + 1;
        const Outside outside = outside_of(result, lists, 8);
        INFO(name(result) << ": " << outside.first);
        CHECK(outside.pixels == 0);
    }
}

TEST_CASE(
    "the widest hypothesis of a family includes what its members reach and that of an order includes its families") {
    std::mt19937_64 random{9};
    const Families all = families(Storage::unorm8, {0, 0x1p-12}, Looseness::loose);
    const std::vector<Hypothesis> wide = widest(all);
    std::string first;
    const auto compare = [&](const Stack& stack, const Hypothesis& inner, const Hypothesis& outer) {
        const ReachableColor narrow = Compositor{inner}.reach(stack), reach = Compositor{outer}.reach(stack);
        for (std::size_t c = 0; c < 4; ++c)
            if (narrow[c].low < reach[c].low - 1e-12 || narrow[c].high > reach[c].high + 1e-12) first = describe(inner);
    };
    for (int i = 0; i < 20; ++i) {
        const Stack stack = random_stack(random, 8);
        for (const HypothesisFamily& family : all) {
            for (const Hypothesis& h : family.members) compare(stack, h, family.widest);
            compare(stack, family.widest, *std::ranges::find(wide, family.widest.order, &Hypothesis::order));
        }
    }
    CHECK(first == "");
}

TEST_CASE("hypotheses that share the ends of a stack reach what each alone reaches") {
    std::mt19937_64 random{57};
    const std::vector<double> slacks{0, 0x1p-20, 0x1p-9};
    const Families all = families(Storage::unorm8, slacks, Looseness::loose);
    for (int i = 0; i < 4; ++i) {
        const Stack stack = random_stack(random, 12);
        KnownEnds known;
        std::size_t others = 0;
        for (int again = 0; again < 2; ++again)
            for (const HypothesisFamily& family : all)
                for (const Hypothesis& h : family.members)
                    others += Compositor{h}.reach(stack, known) == Compositor{h}.reach(stack) ? 0 : 1;
        CHECK(others == 0);
    }
}
