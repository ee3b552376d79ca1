// Tests `strata compare SCENE PICTURE` with pictures that the command itself renders, one of them by a peel that is
// stopped too early. The exit statuses are those of tools/docs/commands.md.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("compare with a scene accepts a correct picture in any format and order of blending with exit status 0") {
    const Folder folder;
    REQUIRE(
        shell(
            folder,
            "strata render teapot --size 48x36 --background 0.2,0.3,0.5 --algorithm front_to_back,dual -q -o a.png && "
            "strata render teapot --size 48x36 --background 0.2,0.3,0.5 --color-format rgba16f -q -o b.exr")
            .status == 0);
    for (const std::string picture : {"a.dual.png", "a.front_to_back.png", "b.exr"}) {
        const CommandResult found = run_strata(folder, {"compare", "teapot", picture, "--background", "0.2,0.3,0.5"});
        INFO(picture << found.out << found.err);
        CHECK(found.status == 0);
        const bool has_lost_ties = picture == "a.front_to_back.png";  // as its own picture has
        CHECK(found.out.starts_with(has_lost_ties ? "right: equal to the picture of front_to_back at all 1728 pixels\n"
                                                  : "right: structure exact at all 1728 pixels; rounding at most "));
    }
}

TEST_CASE("a screenshot over a transparent background is right with straight colours and its alpha is compared") {
    const Folder folder;
    REQUIRE(shell(folder, "strata render teapot --size 24x18 --background none -q -o a.png").status == 0);
    const CommandResult right = run_strata(folder, {"compare", "teapot", "a.png", "--background", "none"});
    INFO(right.out << right.err);
    CHECK(right.status == 0);
    CHECK(right.out.find("\n  alpha is right at all pixels\n") != std::string::npos);
    CHECK(right.out.find("\n  colours are read as straight and multiplied by their alpha, ") != std::string::npos);
    const CommandResult other = run_strata(folder, {"compare", "teapot", "a.png", "--report", "page.html"});
    CHECK(other.status == 1);
    CHECK(other.out.starts_with("wrong: alpha is wrong at 432 of 432 pixels; "));
    CHECK(other.out.find("alpha is right over a background of alpha 0: --background ") != std::string::npos);
    CHECK(content_of(folder / "page.html").find("432 pixels: alpha alone is wrong") != std::string::npos);
    CHECK(run_strata(folder, {"compare", "teapot", "a.png", "--channels", "rgb"}).status == 0);
    const CommandResult json = run_strata(folder, {"compare", "teapot", "a.png", "--json"});
    const auto document = nlohmann::json::parse(json.out);
    CHECK(document["alpha"]["mistake"] == "other_background");
    CHECK(document["colors"] == "straight");
    const CommandResult pixel = run_strata(folder, {"explain", "teapot", "--candidate", "a.png", "--pixel", "0,0"});
    CHECK(pixel.status == 1);
    CHECK(pixel.out.find("; the candidate 0.00\n") != std::string::npos);
}

TEST_CASE("compare with a scene names the mistake of a peel that stops early and exits with status 1", "[long]") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render teapot --size 48x36 --algorithm front_to_back --max-passes 2 -q -o a.png && "
                  "strata golden teapot --size 48x36 --algorithm front_to_back -q -o pack")
                .status == 0);
    const CommandResult text = run_strata(folder, {"compare", "teapot", "a.png"});
    CHECK(text.status == 1);
    CHECK(text.out.starts_with("wrong: "));
    CHECK(text.out.find("only the nearest 2 layers of up to ") != std::string::npos);
    // A pack's state replaces the options.
    const CommandResult json = run_strata(folder, {"compare", "pack", "a.png", "--json"});
    CHECK(json.status == 1);
    const auto document = nlohmann::json::parse(json.out);
    CHECK(document["verdict"] == "wrong");
    CHECK(document["explanations"][0]["mistakes"][0]["kind"] == "nearest_alone");
    CHECK(document["explanations"][0]["mistakes"][0]["n"] == 2);
}

TEST_CASE("a picture that is correct under another profile is accepted and that profile is named", "[long]") {
    const Folder folder;
    const std::string scene = "random:seed=3,triangles=80";
    const std::string draw = "strata render " + scene + " --size 48x36 --profile softpipe --color-format rgba32f -q ";
    REQUIRE(shell(folder, draw + "-o a.exr && " + draw + "--mistake alpha_squared -o b.exr").status == 0);
    const CommandResult right = run_strata(folder, {"compare", scene, "a.exr", "--report", "page.html"});
    INFO(right.out << right.err);
    CHECK(right.status == 0);
    CHECK(right.out.starts_with("right: structure exact at 1704 of 1728 pixels, 24 excused: 24 where fragments of "));
    CHECK(right.out.find("\n  by the rules of profile softpipe; by those of geforce8 it would be wrong at ") !=
          std::string::npos);
    CHECK(content_of(folder / "page.html").find("by the rules of profile softpipe") != std::string::npos);
    const CommandResult json = run_strata(folder, {"compare", scene, "a.exr", "--json"});
    CHECK(nlohmann::json::parse(json.out)["profile"] == "softpipe");
    CHECK(run_strata(folder, {"compare", scene, "b.exr"}).status == 1);
}

TEST_CASE("floats that sum codes of another profile are correct by its rules at any distance from the exact result") {
    const Folder folder;
    const std::string draw =
        "strata render random:seed=7 --size 48x36 --profile llvmpipe_sse --algorithm coherent_stencil "
        "--color-format rgba8 --result-format rgba32f -q -o a.exr";
    REQUIRE(shell(folder, draw).status == 0);
    const CommandResult found = run_strata(folder, {"compare", "random:seed=7", "a.exr"});
    INFO(found.out << found.err);
    CHECK(found.status == 0);
    CHECK(found.out.find("\n  by the rules of profile llvmpipe_sse; ") != std::string::npos);
}

// SwiftShader's own setup explains a pixel at the edge of an opaque surface, and other snapping the colours of three.
TEST_CASE("a pixel at an edge that another profile covers is correct next to others that other snapping explains") {
    const Folder folder;
    const std::string scene = "showroom --orbit 80,10 --background 0.2,0.3,0.5";
    const std::string draw = "strata render " + scene +
                             " --size 48x36 --profile swiftshader --algorithm batched --color-format rgba8 "
                             "--result-format rgba32f -q -o a.exr";
    REQUIRE(shell(folder, draw).status == 0);
    const CommandResult right = shell(folder, "strata compare " + scene + " a.exr");
    INFO(right.out << right.err);
    CHECK(right.status == 0);
    CHECK(right.out.find("\n  by the rules of profile swiftshader; ") != std::string::npos);
}

TEST_CASE("explain --candidate reports which layers a port composited at a pixel") {
    const Folder folder;
    REQUIRE(shell(folder, "strata render teapot --size 24x18 --algorithm front_to_back --max-passes 2 -q -o a.png")
                .status == 0);
    const CommandResult compared =
        run_strata(folder, {"compare", "teapot", "a.png", "--json", "--report", "page.html"});
    const auto first = nlohmann::json::parse(compared.out)["first_wrong"][0];
    const std::string pixel = first[0].dump() + "," + first[1].dump();
    const CommandResult text = run_strata(folder, {"explain", "teapot", "--candidate", "a.png", "--pixel", pixel});
    CHECK(text.status == 1);
    CHECK(text.out.starts_with("pixel " + pixel + ": wrong; "));
    CHECK(text.out.find("it comes out so if only the nearest 2 layers of up to ") != std::string::npos);
    const CommandResult right =
        run_strata(folder, {"explain", "teapot", "--candidate", "a.png", "--pixel", "0,0", "--json"});
    CHECK(right.status == 0);
    CHECK(nlohmann::json::parse(right.out)["edits"].empty());
    // The counts in the page's legend are those of its map.
    const std::string page = content_of(folder / "page.html");
    CHECK(page.find("What each wrong pixel composited") != std::string::npos);
    CHECK(page.find("pixels: only the nearest 2 layers of up to ") != std::string::npos);
    const CommandResult outside = run_strata(folder, {"explain", "teapot", "--candidate", "a.png", "--pixel", "24,0"});
    CHECK(outside.status == 2);
    CHECK(outside.err.find("expected a pixel from 0,0 to 23,17, found 24,0") != std::string::npos);
}

TEST_CASE("compare --exact holds a picture of a scene or a pack to every bit", "[long]") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render teapot --size 32x24 --algorithm dual,front_to_back -q -o a.png && "
                  "strata golden teapot --size 32x24 --algorithm dual -q -o pack")
                .status == 0);
    CHECK(run_strata(folder, {"compare", "teapot", "a.dual.png", "--exact"}).out == "equal\n");
    const CommandResult other = run_strata(folder, {"compare", "teapot", "a.front_to_back.png", "--exact"});
    CHECK(other.status == 1);
    CHECK(other.out.starts_with("different: "));
    CHECK(run_strata(folder, {"compare", "teapot", "a.front_to_back.png", "--exact", "--algorithm", "front_to_back"})
              .status == 0);
    CHECK(run_strata(folder, {"compare", "pack", "a.dual.png", "--exact"}).status == 0);
    CHECK(run_strata(folder, {"compare", "pack", "a.front_to_back.png", "--exact"}).status == 1);
    CHECK(run_strata(folder, {"compare", "pack", "a.front_to_back.png"}).status == 0);
}

TEST_CASE("a picture of an approximate algorithm is compared with the algorithm's own picture") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render teapot --size 24x18 --algorithm weighted_average,dual -q -o a.exr && "
                  "strata golden teapot --size 24x18 --algorithm weighted_average -q -o pack")
                .status == 0);
    const std::string right = "a.weighted_average.exr", other = "a.dual.exr";
    const CommandResult found = run_strata(folder, {"compare", "teapot", right, "--algorithm", "weighted_average"});
    CHECK(found.status == 0);
    const std::string equal = "right: equal to the picture of weighted_average at all 432 pixels\n";
    CHECK(found.out == equal);
    CHECK(run_strata(folder, {"compare", "pack", right}).out == equal);
    const CommandResult wrong = run_strata(folder, {"compare", "teapot", other, "--algorithm", "weighted_average"});
    CHECK(wrong.status == 1);
    CHECK(wrong.out == "wrong: the picture is right for the scene, but not that of weighted_average\n");
    CHECK(run_strata(folder, {"compare", "teapot", other, "--algorithm", "dual"}).out.starts_with("right: "));
}

TEST_CASE("options that describe a scene are rejected when the reference is a picture") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"compare", "a.png", "b.png", "--profile", "llvmpipe"});
    CHECK(ended.status == 2);
    CHECK(ended.err == "strata: --profile has no effect if the reference is a picture\n");
}
