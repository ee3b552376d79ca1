// Tests that edges which are moved in one direction are a mistake, and edges that are snapped otherwise are not.
#include "tools/oracle/verdict/shifted_edges.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/opened_scene.h"
#include "tools/oracle/verdict/picture_verdict.h"
#include "tools/oracle/verdict/report.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

OpenedScene unlit_teapot() {
    OpenedScene opened{"teapot", 160, 120};
    for (pipeline::Material& material : opened.scene.list.materials) material.unlit = true;
    return opened;
}

OpenedScene moved_by(double right, double up) {
    OpenedScene opened = unlit_teapot();
    const double x = 2 * right / opened.options.width, y = 2 * up / opened.options.height;
    for (int c = 0; c < 4; ++c) {
        opened.view.projection[c][0] += x * opened.view.projection[c][3];
        opened.view.projection[c][1] += y * opened.view.projection[c][3];
    }
    return opened;
}

PictureVerdict verdict_on(const OpenedScene& drawn) {
    static const OpenedScene opened = unlit_teapot();
    const oracle::TargetImage picture = *drawn.picture("front_to_back", pipeline::Format::rgba8);
    return judge_picture(opened.input(), {.colors = picture});
}

}  // namespace

TEST_CASE("a picture whose edges are all moved in one direction is wrong and the direction is said") {
    const struct {
        double right, up;
        const char* words;
    } moves[] = {{1, 1, "right and up"}, {1, -1, "right and down"}, {-1, 1, "left and up"}, {-1, -1, "left and down"}};
    for (const auto& move : moves) {
        const PictureVerdict found = verdict_on(moved_by(move.right / 20, move.up / 20));
        const std::string line = first_line(found.found, {});
        INFO(move.words << ": " << line);
        CHECK(found.state() == State::wrong);
        CHECK(line.find("at edges are covered as if everything were moved " + std::string(move.words) +
                        " by a fraction of a pixel") != std::string::npos);
    }
}

TEST_CASE("edges of a rasterizer with other snapping have no direction") {
    OpenedScene coarse = unlit_teapot();
    coarse.profile.raster.subpixel_bits = 4;
    const PictureVerdict found = verdict_on(coarse);
    INFO(first_line(found.found, {}));
    CHECK(found.found.right.at_edges >= 10);
    CHECK(found.found.finding.empty());
}
