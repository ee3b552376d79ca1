// Tests that `strata diagnose --samples` names mistakes in pictures of several samples per pixel: those that options of
// `strata render` can draw, and steps of a peel.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"
#include "tests/tools/strata/diagnose/named.h"

namespace {

using namespace strata::test;

// What diagnose says of a picture of the teapot that render drew with these options.
[[nodiscard]] CommandResult diagnosed_samples(const Folder& folder, std::vector<std::string> drawn_with) {
    const std::vector<std::string> scene{"teapot",        "--alpha",        "0.5",  "--profile", "ideal", "--algorithm",
                                         "front_to_back", "--color-format", "rgba8"};
    std::vector<std::string> render{"render"};
    render.insert(render.end(), scene.begin(), scene.end());
    render.insert(render.end(), {"--size", "32x24", "--no-audit", "-q", "-o", "port.png"});
    render.insert(render.end(), drawn_with.begin(), drawn_with.end());
    REQUIRE(run_strata(folder, render).status == 0);
    std::vector<std::string> diagnose{"diagnose"};
    diagnose.insert(diagnose.end(), scene.begin(), scene.end());
    diagnose.insert(diagnose.end(), {"port.png", "--samples", "4"});
    return run_strata(folder, diagnose);
}

}  // namespace

TEST_CASE("diagnose names the mistake of multisampling that made a picture") {
    const Folder folder;
    const CommandResult right = diagnosed_samples(folder, {"--samples", "4"});
    CHECK(right.status == 0);
    CHECK(right.out.starts_with("right: "));
    const std::vector<std::pair<std::string, std::vector<std::string>>> mistakes{
        {"no_samples", {}},
        {"resolve_before_compositing", {"--samples", "4", "--composite-sample", "resolved"}},
        {"sample_0_for_all", {"--samples", "4", "--load-sample", "0", "--composite-sample", "0"}},
        {"peel_loads_resolved", {"--samples", "4", "--load-sample", "resolved"}},
        {"alpha_to_coverage_on", {"--samples", "4", "--alpha-to-coverage"}},
        {"pixel_shading", {"--samples", "4", "--shading", "pixel"}},
        {"pixel_shading_loads_sample_0", {"--samples", "4", "--shading", "pixel", "--load-sample", "0"}}};
    for (const auto& [name, drawn_with] : mistakes) {
        const CommandResult found = diagnosed_samples(folder, drawn_with);
        INFO(found.out << found.err);
        CHECK(found.status == 1);
        CHECK(found.out.substr(0, found.out.find('\n')).ends_with("(" + name + ")"));
    }
}

TEST_CASE("diagnose names a step of the peel in a resolved picture and two mistakes at once") {
    const Folder folder;
    const std::vector<std::string> samples{"--samples", "4", "--mistake"};
    for (const std::string names : {"ping_pong_not_swapped", "over_for_under", "no_samples,flipped_rows"}) {
        std::vector<std::string> drawn_with = samples;
        drawn_with.push_back(names);
        const CommandResult found = diagnosed_samples(folder, drawn_with);
        INFO(names << ": " << found.out << found.err);
        CHECK(found.status == 1);
        CHECK(found.out.starts_with("wrong: "));
        CHECK(named_emulation(found).find("(" + names.substr(0, names.find(',')) + ")") != std::string::npos);
    }
}

TEST_CASE("a peel without an end that a port stops is named with the port's limit of passes and a hint asks for it") {
    const Folder folder;
    const std::string scene = "random:seed=3,triangles=60 --size 32x24 --samples 4 --algorithm front_to_back ";
    REQUIRE(shell(folder, "strata render " + scene +
                              "--shading pixel --load-sample 0 --max-passes 40 --no-audit -q -o port.png")
                .status == 0);
    const CommandResult unknown = shell(folder, "strata diagnose " + scene + "port.png");
    INFO(unknown.out << unknown.err);
    CHECK(unknown.out.starts_with("wrong: 39 of 768 pixels are not the mean of right samples"));
    CHECK(named_emulation(unknown) == "");
    CHECK(unknown.out.find("--limit N states it\n") != std::string::npos);
    const CommandResult found = shell(folder, "strata diagnose " + scene + "port.png --limit 40");
    INFO(found.out << found.err);
    CHECK(found.out.substr(0, found.out.find('\n')).ends_with("(pixel_shading_loads_sample_0)"));
    CHECK(found.out.find("--limit N") == std::string::npos);
}

TEST_CASE("a resolved picture that no emulation equals is right by its layers if it is the mean of right samples") {
    const Folder folder;
    REQUIRE(
        shell(
            folder,
            "strata render teapot --alpha 0.5 --size 24x18 --samples 4 --profile llvmpipe --algorithm dual --no-audit "
            "-q -o port.png")
            .status == 0);
    const CommandResult found =
        run_strata(folder, {"diagnose", "teapot", "--alpha", "0.5", "port.png", "--samples", "4", "--profile", "ideal",
                            "--algorithm", "front_to_back", "--json"});
    INFO(found.out << found.err);
    CHECK(found.status == 0);
    const auto document = nlohmann::json::parse(found.out);
    REQUIRE(document["verdict"] == "right_structure");
    CHECK(document["structure"]["verdict"] == "right");
}

TEST_CASE("diagnose says edges only of a picture that is wrong where samples differ") {
    const Folder folder;
    const CommandResult edges = diagnosed_samples(folder, {});
    INFO(edges.out);
    CHECK(edges.out.find("\n  edges only: at all ") != std::string::npos);
    CHECK(diagnosed_samples(folder, {"--samples", "4", "--shading", "pixel"}).out.find("edges only") ==
          std::string::npos);
}
