// Tests the stencil test against the tables of GL 2.1 in integers, and against hardware captures.
#include "pipeline/stages/stencil.h"

#include <catch2/catch.hpp>

#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;
using strata::rasterizer::Lanes;

namespace {

// The operations in integers, from the table of GL 2.1.
int model_op(StencilOp op, int s, int ref) {
    switch (op) {
        case StencilOp::keep: return s;
        case StencilOp::zero: return 0;
        case StencilOp::replace: return ref;
        case StencilOp::incr: return s < 255 ? s + 1 : 255;
        case StencilOp::decr: return s > 0 ? s - 1 : 0;
        case StencilOp::invert: return 255 - s;
        case StencilOp::incr_wrap: return (s + 1) % 256;
        case StencilOp::decr_wrap: return (s + 255) % 256;
    }
    return -1;
}

struct Outcome {
    bool alive, saturated, stencil_failed;
    std::uint32_t stored;
};

// Expected outcome of one fragment, from GL 2.1 4.1.5 and EXT_stencil_two_side.
Outcome model_fragment(const StencilTest& state, bool front, bool depth_pass, bool alive, int stored) {
    if (!alive) return {false, false, false, static_cast<std::uint32_t>(stored)};
    if (!state.enabled) return {depth_pass, false, false, static_cast<std::uint32_t>(stored)};
    const StencilFace& face = state.two_sided && !front ? state.back : state.front;
    const bool passes = model_compare(face.func, face.ref & face.func_mask, stored & face.func_mask);
    const StencilOp op = !passes ? face.fail : depth_pass ? face.pass : face.depth_fail;
    const int wanted = model_op(op, stored, face.ref);
    int result = 0;
    for (int bit = 1; bit < 256; bit *= 2) result += (face.write_mask & bit) != 0 ? wanted & bit : stored & bit;
    const bool at_limit = (op == StencilOp::incr && stored == 255) || (op == StencilOp::decr && stored == 0);
    return {passes && depth_pass, at_limit, !passes, static_cast<std::uint32_t>(result)};
}

StencilFace any_face(Random& random) {
    const auto any_mask = [&] { return one_in(random, 2) ? std::uint8_t{0xff} : any_byte(random); };
    return {any_of(random, CompareFunc::always),
            any_byte(random),
            any_mask(),
            any_mask(),
            any_of(random, StencilOp::decr_wrap),
            any_of(random, StencilOp::decr_wrap),
            any_of(random, StencilOp::decr_wrap)};
}

// The stored value after one fragment passed the stencil test.
std::uint32_t after(StencilOp op, std::uint32_t stored, std::uint8_t ref = 7, std::uint8_t write_mask = 0xff) {
    std::uint32_t depth_pass = ~0u, alive = ~0u;
    const StencilTest state{
        true, false, {CompareFunc::always, ref, 0xff, write_mask, StencilOp::keep, StencilOp::keep, op}, {}};
    stencil_test(state, {nullptr, &depth_pass, &alive, &stored, nullptr, 1});
    return stored;
}

}  // namespace

TEST_CASE("each fragment leaves the stencil value and passes as in the table of GL 2.1 4.1.5") {
    Random random{415};
    Tally tally;
    for (int round = 0; round < 20000; ++round) {
        const StencilTest state{!one_in(random, 8), one_in(random, 2), any_face(random), any_face(random)};
        const auto count = static_cast<std::size_t>(one_in(random, 16) ? 256 : below(random, 20));
        Lanes<std::uint8_t> front{};
        Lanes<std::uint32_t> depth_pass{}, alive{}, stored{}, saturated{};
        std::array<Outcome, 256> expected{};
        int expected_failures = 0;
        for (std::size_t i = 0; i < count; ++i) {
            front[i] = one_in(random, 2) ? 1 : 0;
            depth_pass[i] = one_in(random, 2) ? ~0u : 0u;
            alive[i] = one_in(random, 4) ? 0u : ~0u;
            stored[i] = one_in(random, 3) ? (one_in(random, 2) ? 255 : 0) : any_byte(random);
            expected[i] =
                model_fragment(state, front[i] != 0, depth_pass[i] != 0, alive[i] != 0, static_cast<int>(stored[i]));
            expected_failures += expected[i].stencil_failed ? 1 : 0;
        }
        const int failures = stencil_test(state, {front.data(), depth_pass.data(), alive.data(), stored.data(),
                                                  saturated.data(), static_cast<int>(count)});
        tally.expect(failures == expected_failures,
                     [&] { return fmt::format("round {}: {} stencil failures", round, failures); });
        for (std::size_t i = 0; i < count; ++i) {
            const bool holds = (alive[i] == (expected[i].alive ? ~0u : 0u)) && stored[i] == expected[i].stored &&
                               saturated[i] == (expected[i].saturated ? ~0u : 0u);
            tally.expect(holds, [&] {
                return fmt::format("round {} lane {}: {} not {}", round, i, stored[i], expected[i].stored);
            });
        }
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
    CHECK(tally.cases() >= 100000);
}

TEST_CASE("every operation gives its value for every stored value and mask") {
    int wrong = 0;
    for (int op = 0; op < 8; ++op)
        for (std::uint32_t stored = 0; stored < 256; ++stored)
            for (const std::uint8_t mask :
                 {std::uint8_t{0xff}, std::uint8_t{0x7f}, std::uint8_t{0x00}, std::uint8_t{0xa5}}) {
                const auto wanted =
                    static_cast<std::uint32_t>(model_op(static_cast<StencilOp>(op), static_cast<int>(stored), 7));
                wrong += after(static_cast<StencilOp>(op), stored, 7, mask) ==
                                 (wanted & mask) + (stored & ~std::uint32_t{mask})
                             ? 0
                             : 1;
            }
    CHECK(wrong == 0);
}

// pipeline/reference/chip-fragment.md 4, Stencil_func: pass when 7F FUNC stored.
TEST_CASE("the reference is the left operand as in sixteen hardware captures where LESS passes if stored is above 7F") {
    const auto drawn = [](CompareFunc func) {
        std::string result;
        for (std::uint32_t stored : {0x00u, 0x7eu, 0x7fu, 0x80u, 0xffu}) {
            std::uint32_t depth_pass = ~0u, alive = ~0u;
            stencil_test({true, false, {func, 0x7f}, {}}, {nullptr, &depth_pass, &alive, &stored, nullptr, 1});
            result += alive != 0 ? '1' : '0';
        }
        return result;
    };
    CHECK(drawn(CompareFunc::less) == "00011");
    CHECK(drawn(CompareFunc::lequal) == "00111");
    CHECK(drawn(CompareFunc::greater) == "11000");
    CHECK(drawn(CompareFunc::notequal) == "11011");
}

TEST_CASE("a counter of 255 saturates with INCR and wraps with INCR_WRAP and the overflow is reported") {
    CHECK(after(StencilOp::incr, 255) == 255);
    CHECK(after(StencilOp::incr_wrap, 255) == 0);
    CHECK(after(StencilOp::decr, 0) == 0);
    CHECK(after(StencilOp::decr_wrap, 0) == 255);
    std::uint32_t depth_pass = ~0u, alive = ~0u, stored = 255, saturated = 0;
    const StencilTest count{true, false, {.pass = StencilOp::incr}, {}};
    stencil_test(count, {nullptr, &depth_pass, &alive, &stored, &saturated, 1});
    CHECK(stored == 255);
    CHECK(saturated == ~0u);
}
