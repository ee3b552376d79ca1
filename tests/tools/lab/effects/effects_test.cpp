// Tests `strata bench --per-effect` on scenes whose content determines the effects that are needed.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;
using nlohmann::ordered_json;

namespace {

ordered_json plans(const Folder& folder, std::vector<std::string> words) {
    words.insert(words.begin(), {"bench", "--per-effect"});
    words.insert(words.end(), {"--size", "64x48", "--repeat", "1", "--json"});
    const CommandResult ended = run_strata(folder, words);
    INFO(ended.err);
    REQUIRE(ended.status == 0);
    return ordered_json::parse(ended.out);
}

ordered_json row(const ordered_json& plan, const std::string& effect) {
    for (const auto& row : plan.at("effects"))
        if (row.at("effect") == effect) return row;
    return {{"effect", "missing: " + effect}};
}

// One triangle with a MASK material in front of one with a BLEND material.
const char* const two_triangles = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0},{"mesh":1,"translation":[0,0,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]},{"primitives":[{"attributes":{"POSITION":0},"material":1}]}],
"materials":[{"name":"glass","alphaMode":"BLEND","doubleSided":true},{"name":"leaf","alphaMode":"MASK","doubleSided":true}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]})";

}  // namespace

TEST_CASE("the plan names the material that requires MASK in opaque priming or with --alpha in every pass") {
    const Folder folder;
    std::ofstream(folder / "leaf.gltf") << two_triangles;
    const auto plan = plans(folder, {"leaf.gltf", "--no-light"})[0];
    const auto mask = row(plan, "alphaMode MASK"), priming = row(plan, "opaque priming");
    CHECK(mask.at("simulated") == true);
    CHECK(mask["why"].get<std::string>().find("leaf") != std::string::npos);
    CHECK(mask["why"].get<std::string>().find("glass") == std::string::npos);
    CHECK(mask["passes"] == 1);
    CHECK(mask["fragments"] > 0);
    CHECK(mask["fragments"] == priming.at("fragments"));
    CHECK(row(plan, "lighting, at the vertices").at("simulated") == false);

    const auto everything = plans(folder, {"leaf.gltf", "--alpha", "0.5"})[0];
    const auto passes = everything.at("geometry_passes");
    CHECK(row(everything, "alphaMode MASK").at("passes") == passes);
    CHECK(row(everything, "alphaMode MASK").at("fragments") == passes.get<int>() * mask["fragments"].get<int>());
    CHECK(row(everything, "opaque priming").at("simulated") == false);
}

TEST_CASE("the plan says how many lights there are, and whether passes add secondary colours") {
    const Folder folder;
    const auto with = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "teapot");
        return plans(folder, words)[0];
    };
    const auto at_eye = with({});
    CHECK(row(at_eye, "lighting, at the vertices").at("why") == "lit materials: teapot, ground");
    CHECK(row(at_eye, "colour sum").at("simulated") == false);
    const auto lit = with({"--lights", "directional,0,0,-1/point,0,9,0"});
    CHECK(row(lit, "lighting, at the vertices").at("why") == "2 lights on lit materials: teapot, ground");
    CHECK(row(lit, "colour sum").at("simulated") == false);
    const auto shiny = with({"--lights", "directional,0,0,-1", "--light-model", "specular=1:1:1,separate-specular"});
    CHECK(row(shiny, "lighting, at the vertices").at("why") == "1 light on lit materials: teapot, ground");
    CHECK(row(shiny, "colour sum").at("simulated") == true);
    CHECK(row(shiny, "colour sum").at("passes") ==
          row(shiny, "colour interpolation, perspective division").at("passes"));
}

TEST_CASE("the plan has the passes and all tiles of the statistics for every algorithm") {
    const Folder folder;
    const std::vector<std::string> scene{"volume-beam:slices=6", "--algorithm", "all", "--tile", "32"};
    auto words = scene;
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--size", "64x48", "--stats", "-", "--no-audit"});
    const auto rows = ordered_json::parse(run_strata(folder, words).out);
    const auto all = plans(folder, scene);
    REQUIRE(all.size() == rows.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        INFO(all[i].dump());
        CHECK(all[i].at("geometry_passes") == rows[i].at("geometry_passes"));
        if (rows[i]["outcome"] == "refused") continue;
        const auto& tiles = all[i].at("tiles");
        CHECK(tiles["empty"].get<int>() + tiles["opaque_only"].get<int>() + tiles["single"].get<int>() +
                  tiles["layered"].get<int>() ==
              tiles["all"].get<int>());
        CHECK(tiles["all"] == 4);  // 64 x 48 in tiles of 32
        const std::string name = rows[i]["algorithm"];
        CHECK(row(all[i], "stencil test").at("simulated") ==
              (name.starts_with("coherent_") || name.starts_with("stencil_")));
    }
}

TEST_CASE("the plan lists what --effects all simulates and otherwise names the pass's reason") {
    const Folder folder;
    const auto needed = plans(folder, {"volume-beam:slices=2", "--algorithm", "dual"})[0];
    const auto all = plans(folder, {"volume-beam:slices=2", "--algorithm", "dual", "--effects", "all"})[0];
    CHECK(row(needed, "texture coordinates").at("simulated") == false);
    CHECK(row(all, "texture coordinates").at("simulated") == true);
    CHECK(row(all, "texture coordinates")["why"] == "--effects all");
    CHECK(row(needed, "program depth").at("passes") == needed.at("geometry_passes"));
    for (const char* stage : {"alpha test", "stencil test", "depth test"}) {
        CHECK(row(needed, stage).at("simulated") == false);
        CHECK(row(all, stage).at("simulated") == true);
        CHECK(row(all, stage).at("passes") == all.at("geometry_passes"));
    }
}

TEST_CASE("no effect has a negative time however short the run is") {
    const Folder folder;
    const auto all = plans(folder, {"volume-beam:slices=2", "--algorithm", "all"});
    std::size_t timed = 0;
    std::string below;
    for (const auto& plan : all) {
        for (const auto& row : plan.at("effects")) {
            if (!row.at("seconds").is_number()) continue;
            ++timed;
            if (row["seconds"] < 0 && below.empty()) below = row.dump();
        }
    }
    CHECK(timed > 50);
    CHECK(below == "");
}

TEST_CASE("every effect that can be timed has a time whether it is simulated or skipped") {
    const Folder folder;
    const auto plan = plans(folder, {"volume-beam:slices=2", "--algorithm", "front_to_back"})[0];
    for (const char* effect :
         {"colour interpolation, perspective division", "stored depth code", "depth test", "blending",
          "loads of the own pixel", "texture coordinates", "program depth", "alpha test", "stencil test"}) {
        INFO(effect);
        CHECK(row(plan, effect).at("seconds").is_number());
    }
    CHECK(row(plan, "culling").at("seconds").is_null());
}

TEST_CASE("with fewer than four runs no time of an effect and no ratio is significant") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"bench", "volume-beam:slices=2", "--per-effect", "--size", "32x24",
                                                    "--repeat", "3", "--execution", "replay"});
    CHECK(ended.status == 0);
    CHECK(ended.out.find(" times as fast") == std::string::npos);
    CHECK(ended.out.find("no difference beyond the noise (3 runs of each") != std::string::npos);
    CHECK(ended.out.find(" noise  ") != std::string::npos);
}
