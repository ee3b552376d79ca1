// Tests the comparison of a pack with a candidate: a copy of the expected files with one number changed on purpose.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>

#include "peeling/registry.h"
#include "scenes/camera.h"
#include "scenes/packs/pack_scene.h"
#include "tests/support/own_folder.h"
#include "tools/oracle/pack/compare_packs.h"
#include "tools/oracle/pack/golden.h"

using namespace strata;
using namespace strata::oracle;
using Catch::Contains;

namespace {

std::string pack_and_copy(const std::string& folder, const std::vector<std::string>& algorithms,
                          pipeline::DepthFormat depth) {
    Golden golden{.scene = scenes::load_scene("random:triangles=10,seed=5", {}),
                  .profile = *pipeline::find_profile("geforce8_dx101")};
    golden.options.width = golden.options.height = 16;
    golden.options.threads = 1;
    golden.options.depth = depth;
    golden.scene.own_view = scenes::orbit_view(golden.scene.bounds, 30, 20, 1);
    for (const std::string& name : algorithms) golden.algorithms.push_back(peeling::find_algorithm(name));
    write_pack(golden, folder + "/pack");
    std::filesystem::copy(folder + "/pack/expected", folder + "/candidate", std::filesystem::copy_options::recursive);
    return folder + "/pack";
}

void change_last_byte(const std::string& file) {
    std::fstream stream{file, std::ios::in | std::ios::out | std::ios::binary};
    stream.seekg(-1, std::ios::end);
    const char byte = static_cast<char>(stream.get() ^ 1);
    stream.seekp(-1, std::ios::end);
    stream.put(byte);
}

}  // namespace

TEST_CASE("the expected files and the pack itself are accepted as candidates") {
    for (const pipeline::DepthFormat depth : {pipeline::DepthFormat::d24, pipeline::DepthFormat::d32f}) {
        const test::OwnFolder folder;
        const std::string pack = pack_and_copy(
            folder.path(), {"front_to_back", "dual", "coherent_stencil", "stencil_routed_k_buffer"}, depth);
        const auto expected = expected_pictures(pack);
        REQUIRE(expected.size() == 4);
        for (const std::string& candidate : {folder.path() + "/candidate", pack}) {
            const auto found = compare_packs(expected, candidate_pictures(pack, candidate));
            REQUIRE(found.size() == 4);
            for (const PackComparison& c : found) {
                INFO(c.algorithm << to_text({c}));
                CHECK(c.equal);
                CHECK(c.accepted);
                CHECK(!c.passes.empty());
            }
        }
    }
}

TEST_CASE("the first pass that differs is reported with its targets and missing files are reported") {
    const test::OwnFolder folder;
    const std::string pack = pack_and_copy(folder.path(), {"dual", "weighted_average"}, pipeline::DepthFormat::d32f);
    const auto expected = expected_pictures(pack);
    const std::string candidate = folder.path() + "/candidate";
    std::filesystem::remove_all(candidate + "/weighted_average");
    const nlohmann::json manifest = scenes::read_manifest(pack);
    // Changes the second pass that writes a file of its own.
    std::string target;
    std::string changed_file;
    int number = -1;
    for (const auto& pass : manifest["results"][0]["passes"])
        for (const auto& described : pass["targets"]) {
            const std::string own = "expected/dual/pass." + std::string{pass["number"] < 10 ? "00" : "0"} +
                                    std::to_string(pass["number"].get<int>()) + "/" +
                                    described["name"].get<std::string>() + ".npy";
            if (number < 0 && pass["number"] >= 2 && described["file"] == own) {
                number = pass["number"];
                target = described["name"];
                changed_file = own;
                change_last_byte(candidate + own.substr(8));
            }
        }
    REQUIRE(number >= 2);
    change_last_byte(candidate + "/dual/picture.npy");
    const auto found = compare_packs(expected, candidate_pictures(pack, candidate));
    REQUIRE(found.size() == 2);
    CHECK_FALSE(found[1].is_there);
    CHECK_FALSE(found[0].equal);
    REQUIRE(found[0].first);
    CHECK(found[0].first->number == number);
    REQUIRE(found[0].picture);
    CHECK(found[0].picture->differing == 1);
    CHECK_THAT(to_text(found), Contains("dual: different") &&
                                   Contains("the first pass that differs is " + std::to_string(number) + ",") &&
                                   Contains(target + " at 1 pixels") &&
                                   Contains("weighted_average: not compared: the candidate has nothing of it"));
    // Every target of every pass is reported; only the changed file differs.
    std::size_t told = 0, wrong = 0;
    std::set<std::string> equal, unequal;
    for (const auto& pass : manifest["results"][0]["passes"]) {
        const int pass_number = pass["number"].get<int>();
        const auto compared = std::ranges::find(found[0].passes, pass_number, &ComparedPass::number);
        const auto targets = compared != found[0].passes.end() ? compared->targets : std::vector<TargetReport>{};
        for (const auto& described : pass["targets"]) {
            const auto report = std::ranges::find(targets, described["name"].get<std::string>(), &TargetReport::name);
            // A file that a later pass leaves unchanged is compared once, with the pass that wrote it.
            const auto file = described["file"].get<std::string>();
            const bool is_own = file.find(fmt::format("/pass.{:03}/", pass_number)) != std::string::npos;
            REQUIRE((report != targets.end()) == is_own);
            if (!is_own) continue;
            ++told;
            const bool is_changed = file == changed_file;
            wrong += (report->differing == 1) == is_changed ? 0 : 1;
            (is_changed ? unequal : equal).insert(described["name"]);
        }
    }
    CHECK(told > 6);
    CHECK(wrong == 0);
    for (const std::string& name : unequal) equal.erase(name);
    CHECK_THAT(to_text(found),
               Contains("  =: equal; N:M: N pixels differ by at most M codes; in brackets: within the tolerance\n"));
    const std::string text = to_text(found);
    const std::size_t line = text.find("  equal after every pass: ");
    REQUIRE(line != std::string::npos);
    for (const std::string& name : equal) CHECK(text.find(name, line) != std::string::npos);
    const auto document = nlohmann::json::parse(to_json(found));
    CHECK(document[0]["passes"].size() == found[0].passes.size());
    CHECK(document[0]["first_pass"]["number"] == number);
    CHECK(document[0]["picture"]["equal"] == false);
    // A tolerance for that target accepts the passes, and one for another target does not.
    Tolerances tolerances;
    tolerances.color_codes = ~0u;
    tolerances.target_codes = {{target, 0}};
    CHECK(compare_packs(expected, candidate_pictures(pack, candidate), tolerances)[0].first);
    tolerances.target_codes = {{target, ~0u}};
    const auto forgiven = compare_packs(expected, candidate_pictures(pack, candidate), tolerances);
    CHECK_FALSE(forgiven[0].first);
    CHECK_THAT(to_text(forgiven), Contains(" (1:"));
    std::filesystem::remove_all(candidate);
    std::filesystem::create_directories(candidate);
    CHECK_THROWS_WITH(candidate_pictures(pack, candidate), Contains("folder: expected ALGORITHM/picture.npy"));
}
