// peeling/programs/weight_formula.h - the weight of a fragment by a formula of its depth, its distance and its alpha.
//
// Rule     The steps work on a stack of binary32 values, and each rounds its result once: sums, products and quotients
//          as IEEE 754 does, `exponential` and `power` from a series in binary64 (rasterizer/base/log_exp.h). A power
//          with a whole exponent from 2 to 8 that is written as a number is a product from the left. power(x, y) of x >
//          0 is exp(y log x); of 0 it is 0, 1 or infinity for y > 0, = 0, < 0; of x < 0 it is no number. `least` is b
//          if b < a, else a; `greatest` is b if b > a, else a. A result that is negative or no number is the weight 0.
// Source   peeling/reference/algorithms.md 18.3.
// Tests    tests/peeling/programs/weight_formula_test.cpp; the text: tests/tools/request/weight_words_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strata::peeling {

// The operands of a step with two are below it on the stack, the first one deeper.
enum class WeightTerm : std::uint8_t {
    number,
    depth,
    distance,
    alpha,
    negated,
    exponential,
    whole_power,  // of `number`
    sum,
    difference,
    product,
    quotient,
    power,
    least,
    greatest
};

struct WeightStep {
    WeightTerm term{};
    float number = 0;
    friend bool operator==(const WeightStep&, const WeightStep&) = default;
};

struct WeightFormula {
    std::string text;  // as it was given, without spaces
    std::vector<WeightStep> steps;
    friend bool operator==(const WeightFormula&, const WeightFormula&) = default;
};

inline constexpr int most_weight_steps = 64, most_weight_values = 8, most_whole_power = 8;

// True if the steps find their operands, leave one value, and stay within the bounds above.
[[nodiscard]] bool is_complete(const WeightFormula& formula) noexcept;

// `depth` is the window depth, 0 near and 1 far; `distance` is that from the eye along its axis.
struct WeightInputs {
    float depth = 0, distance = 0, alpha = 0;
};

// Precondition: is_complete(formula).
[[nodiscard]] float weight_by(const WeightFormula& formula, const WeightInputs& inputs) noexcept;

}  // namespace strata::peeling
