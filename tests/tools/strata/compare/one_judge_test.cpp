// Tests that `strata compare` and `strata diagnose` give one state and one first sentence, on pictures whose truth the
// command that made them states.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

struct Made {
    std::string scene, options, mistake;  // "": right
};

std::string command(const std::string& verb, const Made& made, const std::string& rest) {
    return "strata " + verb + " " + made.scene + " " + rest + " --background 0.2,0.3,0.5 " + made.options;
}

}  // namespace

TEST_CASE("compare and diagnose give one state and one first sentence", "[long]") {
    const Folder folder;
    for (const Made& made : {
             Made{"showroom", "--algorithm dual", ""},
             Made{"showroom", "--algorithm dual", "culls_front"},
             Made{"showroom", "--algorithm dual", "opaque_peeled"},
             Made{"showroom", "--algorithm front_to_back", "one_pass_too_few"},
             Made{"showroom", "--algorithm weighted_sum", ""},
             Made{"showroom", "--algorithm weighted_sum", "background_lost"},
             Made{"random:seed=7,triangles=400", "--algorithm linked_list --profile ideal", ""},
             Made{"random:seed=7,triangles=400", "--algorithm linked_list --profile ideal", "list_skips_equal_depths"},
             Made{"random:seed=7,triangles=60", "--algorithm front_to_back --samples 4", ""},
             Made{"random:seed=7,triangles=60", "--algorithm front_to_back --samples 4", "no_samples"},
         }) {
        const std::string mistake = made.mistake.empty() ? "" : " --mistake " + made.mistake;
        REQUIRE(shell(folder, command("render", made, "--size 32x32 -q --no-audit -o port.png" + mistake)).status == 0);
        const CommandResult compared = shell(folder, command("compare", made, "port.png --json"));
        const CommandResult diagnosed = shell(folder, command("diagnose", made, "port.png --json"));
        INFO(made.options << mistake << ": " << compared.err << diagnosed.err);
        CHECK(compared.status == (made.mistake.empty() ? 0 : 1));
        CHECK(diagnosed.status == compared.status);
        const auto by_compare = nlohmann::json::parse(compared.out), by_diagnose = nlohmann::json::parse(diagnosed.out);
        CHECK(by_compare["state"] == by_diagnose["state"]);
        CHECK(by_compare["sentence"] == by_diagnose["sentence"]);
        const CommandResult said = shell(folder, command("diagnose", made, "port.png"));
        CHECK(lines_of(said.out).at(0) == by_compare["sentence"]);
    }
}
