// Tests the lists of algorithms, scenes and profiles against their own JSON. The expected links and letters are written
// by hand.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

nlohmann::json listed(const Folder& folder, std::vector<std::string> words) {
    words.insert(words.begin(), "list");
    words.emplace_back("--json");
    return nlohmann::json::parse(run_strata(folder, words).out);
}

}  // namespace

TEST_CASE("one algorithm or scene given by name is listed alone as in the full list") {
    const Folder folder;
    for (const std::string what : {"algorithms", "scenes"}) {
        const nlohmann::json all = listed(folder, {what});
        REQUIRE(all.size() > 5);
        for (const auto& one : all) CHECK(listed(folder, {what, one.at("name")}) == nlohmann::json::array({one}));
    }
}

TEST_CASE("every algorithm of the three papers has a link to its paper") {
    const Folder folder;
    const std::string text = run_strata(folder, {"list", "algorithms"}).out;
    std::set<std::string> links;
    for (const auto& algorithm : listed(folder, {"algorithms"})) {
        const std::string paper = algorithm.at("paper"), link = algorithm.at("link");
        const bool is_ours = paper.starts_with("Everitt 2001") || paper.starts_with("Bavoil and Myers 2008") ||
                             paper.starts_with("Carr");
        INFO(paper);
        CHECK(link.starts_with("https://") == is_ours);
        if (!link.empty()) links.insert(link);
        if (!link.empty()) CHECK(text.find(paper + ": " + link) != std::string::npos);
    }
    CHECK(links.size() == 3);
    CHECK(links.contains("https://doi.org/10.2312/EGGH/EGGH08/033-040"));
}

TEST_CASE("every algorithm is listed in one group by its number of passes and whether it is exact") {
    const Folder folder;
    const std::string text = run_strata(folder, {"list", "algorithms"}).out;
    const std::set<std::string> fixed{"unsorted",         "painter",          "weighted_average",
                                      "weighted_sum",     "weighted_blended", "weighted_blended_shared",
                                      "multi_layer",      "adaptive",         "linked_list",
                                      "atomic_loop",      "moments",          "hybrid_transparency",
                                      "stochastic",       "bucket_peel",      "k_buffer",
                                      "moments_quantized"};
    for (const auto& algorithm : listed(folder, {"algorithms"})) {
        const std::string name = algorithm.at("name"), group = algorithm.at("group");
        const bool is_exact = algorithm.at("exact");
        INFO(name);
        CHECK(group == (name == "a_buffer"     ? "oracle"
                        : fixed.contains(name) ? "fixed_passes"
                        : is_exact             ? "exact_peel"
                                               : "conditional"));
        CHECK(text.find("\n" + name + " ") != std::string::npos);
    }
    for (const char* heading : {"A fixed number of passes", "Exact, with as many passes", "no device runs it"})
        CHECK(text.find(heading) != std::string::npos);
}

TEST_CASE("the letters of a profile's sources are explained where they are printed") {
    const Folder folder;
    const std::string text = run_strata(folder, {"list", "profiles", "geforce3"}).out;
    for (const char* letter : {"[S]", "[M]", "[A]"}) {
        CHECK(text.find(" " + std::string(letter) + " ") != std::string::npos);
        CHECK(text.find(std::string(letter) + ": ") != std::string::npos);
    }
}

TEST_CASE("a texture without a name is listed as unnamed") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"render", "planes:count=1", "--size", "4x2", "-q", "-o", "image.png"}).status == 0);
    std::ofstream(folder / "a.gltf")
        << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"bufferView":1,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":1,"byteLength":)"
        << std::filesystem::file_size(folder / "image.png") << R"(}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"},{"byteLength":)"
        << std::filesystem::file_size(folder / "image.png") << R"(,"uri":"image.png"}]})";
    const CommandResult ended = run_strata(folder, {"scene", "a.gltf"});
    INFO(ended.err);
    CHECK(ended.out.find("unnamed 4x2") != std::string::npos);
}
