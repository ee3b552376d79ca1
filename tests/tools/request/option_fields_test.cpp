// Tests the table of options: texts and values of every field, and the command line that is made from it.
#include "tools/request/option_fields.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <set>

using strata::tools::OptionField;
using strata::tools::PictureRequest;

namespace {

using Texts = std::vector<std::string>;

// Texts of an option: the first ones are valid and in their shortest form, those after "invalid" are not. Choices and
// flags have their words. A new field fails the first test until it is listed.
const std::map<std::string, Texts>& examples() {
    static const std::map<std::string, Texts> all{
        {"scene", {"0", "7", "invalid", "-1", "x", "1.5"}},
        {"size", {"1x1", "640x480", "16384x16384", "invalid", "0x1", "16385x1", "640", "640x480x2", "+1x1"}},
        {"orbit", {"0,0", "30,20", "-12.5,7.25", "invalid", "30", "30,20,10", "a,b", "inf,0"}},
        {"camera", {"front", "a b.json", "invalid", ""}},
        {"alpha", {"0", "0.25", "1", "glass=0.3", "a=b=0.5,water=1", "invalid", "1.5", "=0.5", "glass", "glass=2"}},
        {"background", {"none", "0.1,0.2,0.3", "1,1,1,0.5", "invalid", "0.1", "0,0,0,0,0", "2,0,0"}},
        {"compare-epsilon", {"1e-07", "0.5", "2ulp", "invalid", "-1", "2ulps", "16777217ulp", "1.5ulp"}},
        {"vertex-path", {"separate", "separate,fused", "invalid", "", "separate,separate,separate", "none"}},
        {"polygon-offset", {"0,0", "1,1", "-2.5,16777216", "invalid", "1", "1,16777218", "1,2,3"}},
        {"depth-range", {"0,0.5", "1,0", "0.25,0.75", "invalid", "0", "0,2", "-0.1,1"}},
        {"scissor", {"0,0,1,1", "240,180,160,120", "invalid", "0,0,0,1", "1,2,3", "-1,0,1,1"}},
        {"termination", {"paper", "any", "ratio:0.001", "fixed:3", "invalid", "ratio:2", "fixed:0", "exactly"}},
        {"max-passes", {"1", "1000", "invalid", "-1", "many"}},
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
std::pair<Texts, Texts> texts_of(const OptionField& field) {
    if (field.is_flag) return {{"true", "false"}, {"", "yes", "1"}};
    if (!field.words.empty()) return {field.words, {"", "invalid", field.words.front() + "x"}};
    const auto found = examples().find(field.name);
    INFO(field.name << " has no examples in this test");
    REQUIRE(found != examples().end());
    const auto divider = std::ranges::find(found->second, "invalid");
    const auto past = divider == found->second.end() ? divider : divider + 1;
    return {{found->second.begin(), divider}, {past, found->second.end()}};
}

// The texts of all fields.
std::map<std::string, std::string> all_texts(const PictureRequest& request) {
    std::map<std::string, std::string> texts;
    for (const OptionField& field : strata::tools::option_fields()) texts[field.name] = field.text(request);
    return texts;
}

}  // namespace

TEST_CASE("each option writes the text that it has read and changes no other option and rejects what is no value") {
    std::set<std::string> names;
    for (const OptionField& field : strata::tools::option_fields()) {
        INFO(field.name);
        CHECK(names.insert(field.name).second);
        CHECK(!field.help.empty());
        const auto [valid, invalid] = texts_of(field);
        for (const std::string& text : valid) {
            INFO(text);
            PictureRequest request;
            auto expected = all_texts(request);
            CHECK(field.set(request, text));
            expected[field.name] = text;
            CHECK(all_texts(request) == expected);
        }
        for (const std::string& text : invalid) {
            INFO(text);
            PictureRequest request;
            CHECK_FALSE(field.set(request, text));
            CHECK(all_texts(request) == all_texts({}));
        }
        if (const std::string plain = field.text({}); !plain.empty()) {  // the default is a value
            PictureRequest request;
            CHECK(field.set(request, plain));
            CHECK(field.is_default(request));
        }
    }
}

TEST_CASE("an option is found by its name with either kind of dash") {
    REQUIRE(strata::tools::find_option("depth_format") != nullptr);
    CHECK(strata::tools::find_option("depth_format") == strata::tools::find_option("depth-format"));
    CHECK(strata::tools::find_option("depth_format")->option() == "--depth-format");
    CHECK(strata::tools::find_option("light")->option() == "--no-light");
    CHECK(strata::tools::find_option("depthformat") == nullptr);
}

TEST_CASE("random sets of options are read back from the words of a command line") {
    std::mt19937 random(7);
    const auto fields = strata::tools::option_fields();
    for (int round = 0; round < 2000; ++round) {
        PictureRequest request;
        for (const OptionField& field : fields) {
            const auto [valid, invalid] = texts_of(field);
            if (random() % 3 == 0) REQUIRE(field.set(request, valid[random() % valid.size()]));
        }
        PictureRequest again;
        for (const OptionField& field : fields) {
            // The words of the whole group, of which this field's are used.
            const Texts words = strata::tools::words_of(request, field.group);
            const auto found = std::ranges::find(words, field.option());
            if (found == words.end()) continue;
            REQUIRE(field.set(again, field.is_flag ? (field.is_on_by_default() ? "false" : "true") : *(found + 1)));
        }
        REQUIRE(all_texts(again) == all_texts(request));
    }
}
