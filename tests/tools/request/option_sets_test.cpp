// Tests that everything that is made from the table of options agrees: one entry more appears everywhere, and random
// sets of options keep their values through command line, canonical command, pack, names and command line.
#include <catch2/catch.hpp>
#include <random>

#include "peeling/registry.h"
#include "pipeline/device/check.h"
#include "tests/tools/request/option_examples.h"
#include "tools/oracle/pack/state_json.h"
#include "tools/oracle/reduce/defaults.h"
#include "tools/request/complete.h"
#include "tools/request/make_field.h"
#include "tools/strata/manual/manual.h"
#include "tools/strata/options/options.h"
#include "tools/strata/options/shell_words.h"
#include "tools/strata/render/stats.h"

using namespace strata;
using namespace strata::tools;
using Catch::Matchers::Contains;
using peeling::Algorithm;

namespace {

using Words = std::vector<std::string>;

const pipeline::DeviceProfile& device() { return *pipeline::find_profile("geforce8"); }

// The options of `strata render teapot WORDS`, completed for the device.
RunOptions parsed(Words words) {
    RunOptions options;
    CLI::App app;
    add_picture_options(app, options);
    add_execution_options(app, options);
    add_options(app, options, OptionGroup::measures);
    words.insert(words.begin(), "teapot");
    std::ranges::reverse(words);
    app.parse(words);
    options.app = nullptr;  // it ends here
    complete(options);
    complete(options, device());
    return options;
}

std::map<std::string, std::string> texts_if(const PictureRequest& request, bool (*is_wanted)(const OptionField&)) {
    std::map<std::string, std::string> texts;
    for (const OptionField& field : option_fields())
        if (is_wanted(field)) texts[field.name] = field.text(request);
    return texts;
}

std::string state_of(const PictureRequest& request) { return oracle::state_json(request.render, device()).dump(); }

// What a command draws: the state that a pack has of it, and the options that a pack lacks.
std::pair<std::string, std::map<std::string, std::string>> drawn_by(const PictureRequest& request) {
    return {state_of(request), texts_if(request, [](const OptionField& field) {
                return field.group == OptionGroup::reading || field.name == "camera" || field.name == "alpha" ||
                       field.name == "origin";
            })};
}

// A random set of values that go together, of options that the algorithm reads.
PictureRequest random_request(std::mt19937& random, const Algorithm& algorithm) {
    PictureRequest request;
    for (const OptionField& field : option_fields()) {
        const auto [valid, invalid] = test::texts_of(field);
        if (random() % 3 != 0 || !reads(algorithm, field, request)) continue;
        PictureRequest next = request;
        REQUIRE(field.set(next, valid[random() % valid.size()]));
        if (!option_conflict(next) && !light_conflict(next.render, pipeline::ColorSpace::encoded)) request = next;
    }
    if (request.sample && pipeline::check_multisampling(device(), request.sampling.samples)) request.sample.reset();
    return request;
}

// The words behind `strata render teapot --algorithm NAME`.
Words canonical_words(const RunOptions& options, const Algorithm& algorithm) {
    Words words = shell_words(canonical_command("render", options, algorithm)).value();
    words.erase(words.begin(), words.begin() + 3);
    return words;
}

// An option that no format names: the field is there, but not in the table.
OptionField another_option() {
    return flag<&PictureRequest::render, &peeling::RenderOptions::keep_samples>(OptionGroup::targets, "another-option",
                                                                                "an option that a test adds");
}

}  // namespace

TEST_CASE("an option that is added to the table alone is found in everything that is made from it") {
    const AddedOption added{another_option()};
    const OptionField& field = *find_option("another_option");
    const RunOptions options = parsed({"--another-option"});
    CHECK(options.render.keep_samples);
    CHECK_THAT(canonical_command("render", options, *peeling::find_algorithm("dual")), Contains(" --another-option"));
    CHECK(words_of(options) == Words{"--another-option"});

    RunOptions unused;
    CLI::App root;
    CLI::App* const command = root.add_subcommand("render", "");
    add_picture_options(*command, unused);
    CHECK_THAT(completions(root), Contains("--another-option"));
    CHECK_THAT(help_of(*command, HelpDetail::all), Contains("an option that a test adds"));

    const auto state = oracle::state_json(options.render, device());
    CHECK(state["options"] == nlohmann::ordered_json{{"another_option", "true"}});
    CHECK(oracle::read_state({{"state", state}}, "pack", device()).keep_samples);

    oracle::Golden golden{.profile = device(), .options = options.render};
    const auto simpler = oracle::simplifications();
    const auto found = std::ranges::find(simpler, "--another-option", &oracle::Simplification::name);
    REQUIRE(found != simpler.end());
    CHECK(found->make(golden));
    CHECK_FALSE(golden.options.keep_samples);
    CHECK_FALSE(found->make(golden));

    const RunSummary summary{peeling::find_algorithm("dual"), {}, "", ""};
    CHECK(to_row(summary, {"geforce8", options})["options"]["another_option"] == "true");
    CHECK(field.option() == "--another-option");
}

TEST_CASE("without an option more packs have no object of options and name what they cannot read") {
    auto state = oracle::state_json(parsed({}).render, device());
    CHECK_FALSE(state.contains("options"));
    const auto read = [&](const nlohmann::ordered_json& options) {
        state["options"] = options;
        return oracle::read_state({{"state", state}}, "m", device());
    };
    CHECK_THROWS_WITH(read({{"another_option", "true"}}), Contains("m: /state/options: option: expected the name"));
    CHECK_THROWS_WITH(read({{"threads", "1"}}), Contains("found 'threads'"));
    CHECK_THROWS_WITH(read({{"max_passes", "x"}}), Contains("max_passes: expected a whole number from 0, found 'x'"));
    CHECK_THROWS_WITH(read({{"max_passes", 3}}), Contains("max_passes: expected a string, found 3"));
    CHECK_THROWS_WITH(read("x"), Contains("expected an object"));
    CHECK(read({{"max_passes", "3"}}).max_passes == 3);
}

TEST_CASE("random sets of options draw the same from command line and canonical command and pack and names") {
    std::mt19937 random(56);
    const auto algorithms = peeling::algorithms();
    int with_samples = 0;
    for (int round = 0; round < 3000; ++round) {
        const Algorithm& algorithm = algorithms[random() % algorithms.size()];
        const PictureRequest asked = random_request(random, algorithm);
        Words words = words_of(asked);
        CAPTURE(words);
        words.insert(words.end(), {"--algorithm", algorithm.name});
        const RunOptions first = parsed(words);
        with_samples += first.render.sampling.samples > 1 ? 1 : 0;

        const RunOptions again = parsed(canonical_words(first, algorithm));
        REQUIRE(drawn_by(again) == drawn_by(first));
        REQUIRE(canonical_words(again, algorithm) == canonical_words(first, algorithm));

        const auto state = oracle::state_json(first.render, device());
        PictureRequest of_pack = request_of(oracle::read_state({{"state", state}}, "pack", device()));
        complete(of_pack, device());
        REQUIRE(state_of(of_pack) == state.dump());

        PictureRequest named;
        for (const OptionField& field : option_fields())
            if (!field.is_default(first)) set_option(named, field.key(), field.text(first), "test");
        complete(named, device());
        REQUIRE(drawn_by(named) == drawn_by(first));
        Words last = words_of(named);
        last.insert(last.end(), {"--algorithm", algorithm.name});
        REQUIRE(drawn_by(parsed(last)) == drawn_by(first));
    }
    CHECK(with_samples > 300);
}
