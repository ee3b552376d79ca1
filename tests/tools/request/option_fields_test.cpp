// Tests the table of options: texts and values of every field, and the command line that is made from it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <set>

#include "tests/tools/request/option_examples.h"

using strata::tools::OptionField;
using strata::tools::PictureRequest;
using namespace strata::test;

namespace {

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
