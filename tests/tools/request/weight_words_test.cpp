// Tests the text of a weight's formula: its value at one fragment against values that are exact in binary, what is
// refused, and its way through the table of options.
#include "tools/request/weight_words.h"

#include <catch2/catch.hpp>
#include <string>

#include "tools/request/option_fields.h"

using namespace strata;
using tools::to_weight_formula;

namespace {

// At depth 0.25, distance 3 and alpha 0.5; -1 if the text is refused.
float value_of(const std::string& text) {
    const auto formula = to_weight_formula(text);
    return formula ? peeling::weight_by(*formula, {.depth = 0.25f, .distance = 3, .alpha = 0.5f}) : -1.0f;
}

}  // namespace

TEST_CASE("a formula of a weight groups as arithmetic does") {
    struct Case {
        const char* text;
        float value;
    };
    for (const auto& [text, value] : {Case{"1", 1},
                                      {"z", 0.25f},
                                      {"distance", 3},
                                      {"alpha", 0.5f},
                                      {"1-0.25-0.5", 0.25f},
                                      {"8/4/2", 1},
                                      {"1+2*3", 7},
                                      {"(1+2)*3", 9},
                                      {"2*-3+7", 1},
                                      {"-z+1", 0.75f},
                                      {"--2", 2},
                                      {"7-2*3", 1},
                                      {"1/2*4", 2},
                                      {"pow(1-z,2)", 0.5625f},
                                      {"pow(distance,3)", 27},
                                      {"pow(z,0.5)", 0.5f},
                                      {"pow(2,-1)", 0.5f},
                                      {"pow(2,distance)", 8},
                                      {"exp(0)", 1},
                                      {"min(z,alpha)", 0.25f},
                                      {"max(z,alpha)", 0.5f},
                                      {"clamp(distance,0.5,2)", 2},
                                      {"clamp(z,0.5,2)", 0.5f},
                                      {"clamp(1,0.5,2)", 1},
                                      {" 1e1 * 2.5E-1 ", 2.5f},
                                      {"alpha * max(0.5, 8 * pow(1 - z, 3))", 1.6875f},
                                      {"z-1", 0},
                                      {"1/(z-z)*0", 0}}) {
        INFO(text);
        CHECK(value_of(text) == value);
    }
}

TEST_CASE("what is no formula of a weight is refused") {
    for (const char* text : {"",   "+1",   "1+",    "(1",       "1)",     "z z",        "2z",         "y",
                             "Z",  "exp",  "exp()", "exp(1,2)", "min(1)", "max(1,2,3)", "clamp(1,2)", "pow(1)",
                             "1e", "1..2", "1e99",  "inf",      "nan",    "0x1",        "z^2",        ","}) {
        INFO(text);
        CHECK(value_of(text) == -1);
    }
    std::string long_text = "1";
    for (int i = 0; i < 31; ++i) long_text += "+1";
    CHECK(value_of(long_text) == 32);
    CHECK(value_of(long_text + "+1") == -1);  // 65 steps
    CHECK(value_of(std::string(100000, '(')) == -1);
    CHECK(value_of("1+(1+(1+(1+(1+(1+(1+1))))))") == 8);
    CHECK(value_of("1+(1+(1+(1+(1+(1+(1+(1+1)))))))") == -1);  // nine values at once
}

TEST_CASE("the option weight takes an equation's name or a formula, and the last one counts") {
    const tools::OptionField& weight = *tools::find_option("weight");
    tools::PictureRequest request;
    CHECK(weight.is_default(request));
    CHECK(weight.set(request, "exp( -10 * z )"));
    CHECK(weight.text(request) == "exp(-10*z)");
    CHECK_FALSE(weight.set(request, "exp(-10*z"));
    CHECK(weight.text(request) == "exp(-10*z)");
    CHECK(weight.set(request, "eq7"));
    CHECK(weight.text(request) == "eq7");
    CHECK_FALSE(request.render.algorithm.weight_formula);
    CHECK_THROWS_WITH(tools::set_option(request, "weight", "eq11", "options"),
                      "options: weight: expected eq7, eq8, eq9, eq10 or constant, or a formula of z, distance, alpha, "
                      "numbers, + - * / ( ), exp, min, max, pow and clamp, found 'eq11'");
}
