// peeling/programs/weight_formula.cpp - the steps of weight_formula.h.
#include "peeling/programs/weight_formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "rasterizer/base/log_exp.h"
#include "rasterizer/base/numerics.h"

namespace strata::peeling {

namespace {

[[nodiscard]] int operands_of(WeightTerm term) noexcept {
    if (term <= WeightTerm::alpha) return 0;
    return term <= WeightTerm::whole_power ? 1 : 2;
}

constexpr float infinity = std::numeric_limits<float>::infinity();

[[nodiscard]] float whole_power(float x, int n) noexcept {
    float product = x;
    for (int k = 1; k < n; ++k) product = product * x;
    return product;
}

[[nodiscard]] float power(float x, float y) noexcept {
    if (!(x >= 0.0f) || std::isnan(y)) return std::numeric_limits<float>::quiet_NaN();
    if (y == 0.0f) return 1.0f;
    if (x == 0.0f) return y > 0.0f ? 0.0f : infinity;
    if (x == infinity) return y > 0.0f ? infinity : 0.0f;
    return exponential(static_cast<double>(y) * natural_log(x));
}

[[nodiscard]] float of_inputs(const WeightStep& step, const WeightInputs& inputs) noexcept {
    switch (step.term) {
        case WeightTerm::depth: return inputs.depth;
        case WeightTerm::distance: return inputs.distance;
        case WeightTerm::alpha: return inputs.alpha;
        default: return step.number;
    }
}

[[nodiscard]] float of_one(const WeightStep& step, float a) noexcept {
    if (step.term == WeightTerm::negated) return -a;
    if (step.term == WeightTerm::whole_power) return whole_power(a, static_cast<int>(step.number));
    return exponential(static_cast<double>(a));
}

[[nodiscard]] float of_two(WeightTerm term, float a, float b) noexcept {
    switch (term) {
        case WeightTerm::sum: return a + b;
        case WeightTerm::difference: return a - b;
        case WeightTerm::product: return a * b;
        case WeightTerm::quotient: return a / b;
        case WeightTerm::power: return power(a, b);
        case WeightTerm::least: return std::min(a, b);
        default: return std::max(a, b);
    }
}

}  // namespace

bool is_complete(const WeightFormula& formula) noexcept {
    int values = 0;
    for (const WeightStep& step : formula.steps) {
        if (step.term > WeightTerm::greatest || values < operands_of(step.term)) return false;
        if (step.term == WeightTerm::whole_power && !(step.number >= 2 && step.number <= most_whole_power))
            return false;
        values += 1 - operands_of(step.term);
        if (values > most_weight_values) return false;
    }
    return values == 1 && formula.steps.size() <= most_weight_steps;
}

float weight_by(const WeightFormula& formula, const WeightInputs& inputs) noexcept {
    std::array<float, most_weight_values> values{};
    std::size_t count = 0;
    for (const WeightStep& step : formula.steps) {
        const int operands = operands_of(step.term);
        if (operands == 0) {
            values[count++] = of_inputs(step, inputs);
        } else if (operands == 1) {
            values[count - 1] = of_one(step, values[count - 1]);
        } else {
            --count;
            values[count - 1] = of_two(step.term, values[count - 1], values[count]);
        }
    }
    return values[0] > 0.0f ? values[0] : 0.0f;
}

}  // namespace strata::peeling
