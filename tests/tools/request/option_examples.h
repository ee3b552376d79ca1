// tests/tools/request/option_examples.h - values of every option of the table, for the tests of all that is made from
// it.
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tools/request/option_fields.h"

namespace strata::test {

using Texts = std::vector<std::string>;

// Texts of an option: the first ones are valid and in their shortest form, those after "invalid" are not. Choices and
// flags have their words. A new field fails the first test until it is listed.
inline const std::map<std::string, Texts>& option_examples() {
    static const std::map<std::string, Texts> all{
        {"scene", {"0", "7", "invalid", "-1", "x", "1.5"}},
        {"size", {"1x1", "640x480", "16384x16384", "invalid", "0x1", "16385x1", "640", "640x480x2", "+1x1"}},
        {"orbit", {"0,0", "30,20", "-12.5,7.25", "invalid", "30", "30,20,10", "a,b", "inf,0"}},
        {"camera", {"front", "a b.json", "invalid", ""}},
        {"alpha", {"0", "0.25", "1", "glass=0.3", "a=b=0.5,water=1", "invalid", "1.5", "=0.5", "glass", "glass=2"}},
        {"background", {"none", "0.1,0.2,0.3", "1,1,1,0.5", "invalid", "0.1", "0,0,0,0,0", "2,0,0"}},
        {"fog",
         {"linear,1,10", "exp,0.25", "exp2,0.5,1,0.5,0", "invalid", "linear", "linear,1", "linear,2,2", "exp,-1",
          "exp,1,2", "exp2,1,0,0,2", "fog,1"}},
        {"lights",
         {"none", "directional,0,0,-1", "directional,1,-2,0.5/point,1,2,3,0,0.5,1,color=1:0.5:0,range=8",
          "spot,0,1,2,0,0,-1,30,4,1,0,0.25,diffuse=1:1:0,ambient=0.1:0.1:0.1", "invalid", "", "directional",
          "directional,0,0", "point,1,2", "point,1,2,3,4", "spot,0,0,0,0,0,1", "sun,0,0,1", "directional,0,0,1,range=2",
          "point,1,2,3,color=1:1", "point,1,2,3/", "point,color=1:1:1,1,2,3"}},
        {"light-model",
         {"ambient=0.2:0.2:0.2", "ambient=0:0:0", "specular=1:1:1,shininess=32,emission=0:0.5:0,local-viewer,two-sided",
          "separate-specular", "invalid", "", "shininess", "shininess=x", "glossy", "ambient=1:1", "local-viewer=1"}},
        {"compare-epsilon", {"1e-07", "0.5", "2ulp", "invalid", "-1", "2ulps", "16777217ulp", "1.5ulp"}},
        {"vertex-path", {"separate", "separate,fused", "invalid", "", "separate,separate,separate", "none"}},
        {"polygon-offset", {"0,0", "1,1", "-2.5,16777216", "invalid", "1", "1,16777218", "1,2,3"}},
        {"only", {"a", "a,b c"}},
        {"line-width", {"0", "2.5", "65536", "invalid", "-1", "65537", "wide"}},
        {"line-stipple",
         {"1,0xffff", "256,0x0001", "invalid", "1", "0,0x1", "257,0x1", "1,65535", "1,0x", "1,0x10000"}},
        {"point-size", {"0", "0.125", "65536", "invalid", "-0.5", "65537", "1px"}},
        {"depth-range", {"0,0.5", "1,0", "0.25,0.75", "invalid", "0", "0,2", "-0.1,1"}},
        {"scissor", {"0,0,1,1", "240,180,160,120", "invalid", "0,0,0,1", "1,2,3", "-1,0,1,1"}},
        {"termination", {"paper", "any", "ratio:0.001", "fixed:3", "invalid", "ratio:2", "fixed:0", "exactly"}},
        {"max-passes", {"1", "1000", "invalid", "-1", "many"}},
        {"weight",
         {"eq7", "eq8", "eq9", "eq10", "constant", "alpha*exp(-10*z)", "pow(1-z,3)/(0.5+distance)", "invalid", "",
          "eq11", "eq7x", "exp", "exp(z", "z z", "pow(z)", "y", "1e"}},
        {"nodes", {"1", "8", "invalid", "0", "9"}},
        {"pixel-nodes", {"1", "invalid", "-1"}},
        {"frame-nodes", {"1000", "invalid", "-1"}},
        {"moment-bias", {"0", "5e-07", "1", "invalid", "2", "-1"}},
        {"overestimation", {"0", "0.5", "invalid", "1.01"}},
        {"stochastic-samples", {"1", "8", "invalid", "0", "9"}},
        {"stochastic-seed", {"1", "4294967295", "invalid", "4294967296", "-1"}},
        {"sample", {"0", "7", "invalid", "-1"}},
        {"sample-coverage", {"0", "0.5", "1", "invalid", "1.5"}},
        {"sample-mask", {"0", "254", "invalid", "256", "-1"}},
        {"sorted", {"a", "a,b c"}},
        {"sort",
         {"exact", "reverse", "bucket:8", "shuffle:0.5,18446744073709551615", "invalid", "bucket:0", "shuffle:2,1",
          "shuffle:0.5", "sorted"}},
        {"fragment-memory", {"0", "65536", "invalid", "-1", "16X", "18446744073709551616"}},
        {"threads", {"1", "1024", "invalid", "1025"}},
    };
    return all;
}

// The valid and the invalid texts of a field.
inline std::pair<Texts, Texts> texts_of(const tools::OptionField& field) {
    if (field.is_flag) return {{"true", "false"}, {"", "yes", "1"}};
    if (!field.words.empty()) return {field.words, {"", "invalid", field.words.front() + "x"}};
    const auto found = option_examples().find(field.name);
    INFO(field.name << " has no examples in this test");
    REQUIRE(found != option_examples().end());
    const auto divider = std::ranges::find(found->second, "invalid");
    const auto past = divider == found->second.end() ? divider : divider + 1;
    return {{found->second.begin(), divider}, {past, found->second.end()}};
}

}  // namespace strata::test
