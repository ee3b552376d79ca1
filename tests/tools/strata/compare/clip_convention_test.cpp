// Tests the clip depth and the depth order that a profile states as its defaults: frames have them, options and packs
// override them, and the command that is recorded has one spelling. By the digests of packs.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;
using Catch::Contains;

namespace {

// Profiles in a folder of their own, and the manifests of packs that are made there.
class ProfileFolder {
  public:
    ProfileFolder() {
        // Vulkan: z from 0 to w, +y to higher rows, and Direct3D's ties in those rows (devices.md 3.9).
        put("vulkan", R"("clip_depth": "zero_to_one", "origin": "lower_left")");
        put("reversed", R"("depth_order": "greater")");
        // direct3d11 with the ties that --origin lower-left exchanges for Direct3D's own.
        put("other_ties", R"("raster": {"tie_rule": "bottom_left"})");
    }

    nlohmann::json pack(const std::string& name, const std::string& options) const {
        const CommandResult made =
            shell(folder, "strata golden " + options + " --size 24x18 --algorithm dual,front_to_back -q -o " + name);
        INFO(options << ": " << made.err);
        REQUIRE(made.status == 0);
        return nlohmann::json::parse(content_of(folder / (name + "/manifest.json")));
    }

    Folder folder;

  private:
    void put(const std::string& name, const std::string& fields) const {
        std::ofstream{folder / (name + ".json")}
            << R"({"base": "direct3d11", "name": ")" + name + R"(", )" + fields + "}";
    }
};

std::string command_of(const nlohmann::json& manifest) { return manifest["command"].get<std::string>(); }

}  // namespace

TEST_CASE("a scene by a profile of Vulkan's conventions equals the scene with the options given by hand") {
    const ProfileFolder in;
    for (const std::string scene : {"teapot:tessellation=3 --alpha 0.5", "random:triangles=60"}) {
        const std::string suffix = scene.substr(0, 3);
        const auto by_profile = in.pack("profile_" + suffix, scene + " --profile vulkan.json");
        const auto by_hand = in.pack("hand_" + suffix,
                                     scene + " --profile other_ties.json --origin lower-left --clip-depth zero-to-one");
        CHECK(by_profile["results"] == by_hand["results"]);
        CHECK(by_profile["state"] == by_hand["state"]);
        CHECK(by_profile["view"] == by_hand["view"]);
        CHECK(by_profile["state"]["clip_depth"] == "zero_to_one");
        const auto usual = in.pack("usual_" + suffix, scene + " --profile direct3d11");
        CHECK(usual["state"]["clip_depth"] == "minus_one_to_one");
        CHECK(usual["results"] != by_profile["results"]);
    }
}

TEST_CASE("a profile of reversed depth draws as the option does and an option overrides the profile") {
    const ProfileFolder in;
    const std::string scene = "teapot:tessellation=3 --alpha 0.5 ";
    const auto by_profile = in.pack("profile", scene + "--profile reversed.json");
    const auto by_hand = in.pack("hand", scene + "--profile direct3d11 --depth-order greater");
    CHECK(by_profile["state"]["depth_order"] == "greater");
    CHECK(by_profile["results"] == by_hand["results"]);
    const auto usual = in.pack("usual", scene + "--profile direct3d11");
    const auto overridden = in.pack("overridden", scene + "--profile reversed.json --depth-order less");
    CHECK(overridden["results"] == usual["results"]);
    CHECK(overridden["state"] == usual["state"]);
    CHECK(usual["results"] != by_hand["results"]);
    const auto half = in.pack("half", scene + "--profile vulkan.json --clip-depth minus-one-to-one");
    const auto lower = in.pack("lower", scene + "--profile other_ties.json --origin lower-left");
    CHECK(half["results"] == lower["results"]);
}

TEST_CASE("the recorded command omits a clip depth or depth order that the profile has and states any other") {
    const ProfileFolder in;
    auto command = [&, number = 0](const std::string& options) mutable {
        return command_of(in.pack("p" + std::to_string(++number), "planes:count=2 " + options));
    };
    const std::string vulkan = command("--profile vulkan.json");
    CHECK_THAT(vulkan, !Contains("--clip-depth") && !Contains("--depth-order"));
    CHECK(command("--profile vulkan.json --clip-depth zero-to-one --depth-order less") == vulkan);
    CHECK_THAT(command("--profile vulkan.json --clip-depth minus-one-to-one"),
               Contains(" --clip-depth minus-one-to-one"));
    CHECK(command("--profile reversed.json --depth-order greater") == command("--profile reversed.json"));
    CHECK_THAT(command("--profile reversed.json --depth-order less"), Contains(" --depth-order less"));
    CHECK(command("--depth-order less --clip-depth minus-one-to-one") == command(""));
}

TEST_CASE("a pack keeps its own clip depth and depth order under any profile until an option changes them") {
    const ProfileFolder in;
    const std::string by_options = "planes:count=2 --profile direct3d11 --depth-order greater --clip-depth zero-to-one";
    const auto first = in.pack("first", by_options), again = in.pack("again", "first");
    CHECK(again["results"] == first["results"]);
    CHECK_THAT(command_of(again), Contains("--depth-order greater --clip-depth zero-to-one"));
    CHECK(in.pack("elsewhere", "first --profile geforce8")["state"]["depth_order"] == "greater");
    // LESS is the profile's own, but not what the pack would be drawn with, so the command states it.
    const auto less = in.pack("less", "first --depth-order less");
    CHECK(less["state"]["depth_order"] == "less");
    CHECK_THAT(command_of(less), Contains("--depth-order less --clip-depth zero-to-one"));
    const auto vulkan = in.pack("vulkan", "planes:count=2 --profile vulkan.json");
    const auto of_vulkan = in.pack("of_vulkan", "vulkan");
    CHECK(of_vulkan["results"] == vulkan["results"]);
    CHECK_THAT(command_of(of_vulkan), !Contains("--clip-depth"));
    CHECK(in.pack("kept", "first --profile vulkan.json --origin upper-left")["state"] == first["state"]);
    CHECK(run_strata(in.folder, {"golden", "--check", "vulkan"}).out == "vulkan: all files match\n");
}

TEST_CASE("a reversed depth range with greater keeps the projection and draws the layers in their order") {
    const ProfileFolder in;
    const std::string scene = "random:triangles=60 --profile direct3d11 --depth-format d32f";
    const auto usual = in.pack("usual", scene),
               both = in.pack("both", scene + " --depth-range 1,0 --depth-order greater");
    CHECK(both["view"] == usual["view"]);
    CHECK(both["state"]["depth_order"] == "greater");
    for (const int i : {0, 1})
        CHECK(both["results"][i]["picture"]["digest"] == usual["results"][i]["picture"]["digest"]);
    // The pack is drawn again with its own view and state.
    const CommandResult again = shell(in.folder, "strata golden both --algorithm dual,front_to_back -q -o again");
    INFO(again.err);
    REQUIRE(again.status == 0);
    CHECK(nlohmann::json::parse(content_of(in.folder / "again/manifest.json"))["results"] == both["results"]);
    const CommandResult less = shell(in.folder, "strata render teapot --size 8x8 --depth-range 1,0");
    CHECK_THAT(less.err, Contains("or --depth-order greater beside this one"));
}
