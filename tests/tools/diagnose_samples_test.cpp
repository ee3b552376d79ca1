// Tests that `strata diagnose --samples` names each mistake of multisampling that `strata render` can draw.
#include <catch2/catch.hpp>

#include "tests/tools/program.h"

namespace {

using namespace strata::test;

// What diagnose says of a picture of the teapot that render drew with these options.
[[nodiscard]] CommandResult diagnosed_samples(const Folder& folder, std::vector<std::string> drawn_with) {
    const std::vector<std::string> scene{"teapot", "--alpha",     "0.5",          "--profile",
                                         "ideal",  "--algorithm", "front_to_back"};
    std::vector<std::string> render{"render"};
    render.insert(render.end(), scene.begin(), scene.end());
    render.insert(render.end(), {"--size", "48x36", "--no-audit", "-q", "-o", "port.exr"});
    render.insert(render.end(), drawn_with.begin(), drawn_with.end());
    REQUIRE(run_strata(folder, render).status == 0);
    std::vector<std::string> diagnose{"diagnose"};
    diagnose.insert(diagnose.end(), scene.begin(), scene.end());
    diagnose.insert(diagnose.end(), {"port.exr", "--samples", "4"});
    return run_strata(folder, diagnose);
}

}  // namespace

TEST_CASE("diagnose names the mistake of multisampling that made a picture") {
    const Folder folder;
    const CommandResult right = diagnosed_samples(folder, {"--samples", "4"});
    CHECK(right.status == 0);
    CHECK(right.out == "right: all 1728 pixels\n");
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
        CHECK(found.out.find("\n" + name + ": the port ") != std::string::npos);
    }
}

TEST_CASE("diagnose says edges only of a picture that is wrong where samples differ") {
    const Folder folder;
    const CommandResult edges = diagnosed_samples(folder, {});
    INFO(edges.out);
    CHECK(edges.out.find(" pixels, edges only\n") != std::string::npos);
    CHECK(diagnosed_samples(folder, {"--samples", "4", "--shading", "pixel"}).out.find("edges only") ==
          std::string::npos);
}
