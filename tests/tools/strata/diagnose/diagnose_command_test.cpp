// Tests `strata diagnose` on pictures that `render --mistake` made: the mistake of that option must be found.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("diagnose names the mistake given to render with status 1 and accepts a correct picture with status 0",
          "[long]") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render showroom --size 64x64 -o right.png && "
                  "strata render showroom --size 64x64 --mistake culls_front -o wrong.exr && "
                  "strata render showroom --size 64x64 --mistake culls_front,red_for_blue -o worse.png")
                .status == 0);
    const CommandResult right = run_strata(folder, {"diagnose", "showroom", "right.png"});
    CHECK(right.status == 0);
    CHECK(right.out.starts_with("right: "));
    const CommandResult wrong = run_strata(folder, {"diagnose", "showroom", "wrong.exr"});
    CHECK(wrong.status == 1);
    CHECK(wrong.out.starts_with(
        "wrong: every pixel is that of: front faces culled instead of back faces (culls_front)\n"));
    const CommandResult worse = run_strata(folder, {"diagnose", "showroom", "worse.png", "--json"});
    CHECK(worse.status == 1);
    const nlohmann::json document = nlohmann::json::parse(worse.out);
    CHECK(document["verdict"] == "two_mistakes");
    CHECK(document["findings"][0]["mistakes"] == nlohmann::json({"culls_front", "red_for_blue"}));
}

TEST_CASE("the page of diagnose states the verdict and lists the other hypotheses in a table") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render showroom --size 64x64 --mistake culls_front -q -o wrong.png;"
                  "strata diagnose showroom wrong.png --report page.html > said.txt")
                .status == 1);
    const std::string page = content_of(folder / "page.html");
    CHECK(page.find("<p class=\"lead\">wrong: every pixel is that of: front faces culled") != std::string::npos);
    CHECK(page.find("<td>front faces culled instead of back faces (culls_front)</td><td>4096</td>") !=
          std::string::npos);
    CHECK(page.find("the next best") == std::string::npos);
    CHECK(page.find("contradicted by") == std::string::npos);
    CHECK(page.find("<li>tried: ") != std::string::npos);
}

TEST_CASE("diagnose takes the state of a scene from a pack and the candidate from a folder") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata golden showroom --size 32x32 --background 0.2,0.3,0.5 --algorithm weighted_sum -o pack && "
                  "strata render pack --algorithm weighted_sum --mistake background_lost -o wrong.png")
                .status == 0);
    CHECK(run_strata(folder, {"diagnose", "pack", "pack"}).status == 0);
    const CommandResult wrong = run_strata(folder, {"diagnose", "pack", "wrong.png"});
    CHECK(wrong.status == 1);
    CHECK(wrong.out.find("(background_lost)") != std::string::npos);
    CHECK(run_strata(folder, {"diagnose", "pack", "pack/scene"}).err ==
          "strata: pack/scene: files: expected a picture of weighted_sum, weighted_sum/picture.npy, found none\n");
}

TEST_CASE("diagnose takes a folder of packs and names the mistake that explains all of their pictures") {
    const Folder folder;
    REQUIRE(
        shell(folder,
              "mkdir set made && "
              "strata golden showroom --size 24x24 --background 0.2,0.3,0.5 --algorithm weighted_sum -o set/room && "
              "strata golden planes:count=3 --size 16x16 --algorithm weighted_average -o set/planes && "
              "strata golden teapot --size 16x16 --algorithm weighted_sum -o set/left_out && "
              "strata render set/room --algorithm weighted_sum --mistake alpha_squared -o made/room.png && "
              "strata render set/planes --algorithm weighted_average --mistake alpha_squared -o made/planes.exr")
            .status == 0);
    const CommandResult all = run_strata(folder, {"diagnose", "set", "made"});
    INFO(all.out << all.err);
    CHECK(all.status == 1);
    CHECK(all.out.starts_with("all 2 scenes are those of: alpha multiplied by itself (alpha_squared)\n  planes: "));
    const nlohmann::json document =
        nlohmann::json::parse(run_strata(folder, {"diagnose", "set", "made", "--json"}).out);
    CHECK(document["verdict"] == "one_mistake");
    CHECK(document["scenes"].size() == 2);
    CHECK(document["findings"][0]["fits"] == nlohmann::json({true, true}));
    CHECK(run_strata(folder, {"diagnose", "set", "set/room"}).err ==
          "strata: set/room: has no picture or folder with the name of a pack, such as left_out\n");
}

TEST_CASE("diagnose of a picture that was made by another command says in what the commands differ", "[long]") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render showroom --size 32x32 --background 1,1,1 --alpha 0.5 -o mine.png && "
                  "strata render showroom --size 32x32 --profile geforce8_dx101 --orbit 10,20 -o other.exr && "
                  "strata render showroom --size 32x32 -o right.png")
                .status == 0);
    const CommandResult mine = run_strata(folder, {"diagnose", "showroom", "mine.png"});
    CHECK(mine.status == 1);
    CHECK(mine.err ==
          "strata: warning: mine.png: made by a command with --alpha 0.5 (here: none), --background 1,1,1 (here: "
          "none); give diagnose the same, or compare other pictures\n");
    CHECK(run_strata(folder, {"diagnose", "showroom", "mine.png", "-q"}).err == "");
    CHECK(run_strata(folder, {"diagnose", "showroom", "mine.png", "--alpha", "0.5", "--background", "1,1,1"}).status ==
          0);
    const CommandResult other = run_strata(folder, {"diagnose", "showroom", "other.exr", "--no-light", "--json"});
    CHECK(other.err.find("with --orbit 10,20 (here: none), --profile geforce8_dx101 (here: geforce8), no --no-light "
                         "(here: given); ") != std::string::npos);
    CHECK(nlohmann::json::parse(other.out)["verdict"] == "unknown_mistake");
    CHECK(run_strata(folder, {"diagnose", "showroom", "right.png"}).err == "");
}

TEST_CASE("message options are accepted with a folder of packs and with a suite") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "mkdir set made && strata golden planes:count=2 --size 8x8 --algorithm weighted_sum -o set/planes && "
                  "strata render set/planes --algorithm weighted_sum -o made/planes.png")
                .status == 0);
    for (const std::string option : {"-q", "--quiet", "-v", "--color=never"}) {
        const CommandResult ended = run_strata(folder, {"diagnose", "set", "made", option});
        CHECK(ended.status == 0);
        CHECK(ended.out.starts_with("all 1 scenes are those of: a correct implementation"));
        const CommandResult suite = run_strata(folder, {"golden", "--suite", "no_such_scene", option, "-o", "suite"});
        CHECK(suite.err.find("no_such_scene") != std::string::npos);
    }
}

TEST_CASE("reduce writes a small pack on which the command still fails") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"golden", "showroom", "--size", "32x32", "--algorithm", "front_to_back", "-o", "pack"})
                .status == 0);
    const std::string command = "strata render {pack} --algorithm front_to_back --mistake last_of_equals -o {picture}";
    const CommandResult reduced = shell(folder, "strata reduce pack '" + command + "' -o small");
    INFO(reduced.out << reduced.err);
    REQUIRE(reduced.status == 0);
    CHECK(reduced.out.starts_with("2 triangles in a frame of 1x1 still differ in 1 pixel: 2 of "));
    CHECK(run_strata(folder, {"golden", "--check", "small"}).status == 0);
    REQUIRE(
        shell(folder, "strata render small --algorithm front_to_back --mistake last_of_equals -o wrong.png").status ==
        0);
    CHECK(run_strata(folder, {"diagnose", "small", "wrong.png"}).status == 1);
    const CommandResult right =
        shell(folder, "strata reduce pack 'strata render {pack} --algorithm front_to_back -o {picture}' -o none");
    CHECK(right.status == 1);
    CHECK(right.out == "right: the command draws pack as it should be; there is nothing to reduce\n");
    CHECK_FALSE(std::filesystem::exists(folder / "none"));
}

TEST_CASE("an unknown or impossible mistake and a command without output are rejected with an error message") {
    const Folder folder;
    CHECK(run_strata(folder, {"render", "planes", "--mistake", "culls_frnt", "-o", "a.png"}).err ==
          "strata: --mistake: expected names of mistakes (strata diagnose --list shows them), found 'culls_frnt' (did "
          "you mean "
          "'culls_front'?)\n");
    CHECK(run_strata(folder, {"render", "planes", "--size", "8x8", "--mistake", "texture_lost", "-o", "a.png"}).err ==
          "strata: --mistake: expected a mistake that can occur with this scene, algorithm and profile, found "
          "'texture_lost'\n");
    CHECK(run_strata(folder, {"reduce", "pack", "true", "-o", "small"}).err ==
          "strata: PACK: expected a pack's folder, which `strata golden pack -o PACK` writes, found 'pack'\n");
    REQUIRE(run_strata(folder, {"golden", "planes", "--size", "8x8", "--algorithm", "dual", "-o", "pack"}).status == 0);
    CHECK(run_strata(folder, {"reduce", "pack", "true", "-o", "small"}).err ==
          "strata: COMMAND: expected {pack} in it, found 'true'\n");
    CHECK_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST_CASE("mistakes lists the catalogue and the suite and the suite's commands run") {
    const Folder folder;
    const nlohmann::json list = nlohmann::json::parse(run_strata(folder, {"diagnose", "--list", "--json"}).out);
    CHECK(list.size() >= 40);
    const nlohmann::json suite =
        nlohmann::json::parse(run_strata(folder, {"diagnose", "--list", "--suite", "--json"}).out);
    for (const nlohmann::json& scene : suite) {
        INFO(scene["command"]);
        CHECK(shell(folder, scene["command"].get<std::string>() + " --no-audit").status == 0);
    }
}
