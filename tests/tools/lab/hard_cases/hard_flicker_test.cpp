// Tests the flicker measurement on renderers whose flips are known: the exact answer, and the exact answer with a fault
// in every second frame.
#include "tools/lab/hard_cases/moves/hard_flicker.h"

#include <catch2/catch.hpp>
#include <memory>

#include "peeling/registry.h"
#include "tools/lab/hard_cases/hard_exact.h"
#include "tools/lab/hard_cases/moves/hard_moved.h"

namespace {

using namespace strata;
using tools::Flicker;
using tools::PathCase;
using tools::RenderedPixels;
using tools::RenderFunction;

const scenes::HardCase& hard_named(const char* name) { return *scenes::find_hard_case(name); }

RenderFunction look_exactly(const scenes::HardCase& hard) {
    return [&hard](const scenes::Scene& scene, const pipeline::View& view) {
        return RenderedPixels{.pixels = tools::ExactCase{hard, scene, view}.visible_pixels(), .refusal = {}};
    };
}

}  // namespace

TEST_CASE("the exact answer never flips where it does not change and pixels are compared in 63 pairs of frames") {
    const scenes::HardCase& hard = hard_named("crossing-between-rows");
    const Flicker flicker = PathCase{hard}.flicker(look_exactly(hard));
    CHECK(flicker.order == 0);
    CHECK(flicker.coverage == 0);
    // All pixels except some that the line of intersection and the square's diagonal cross.
    CHECK(flicker.compared <= 63 * 1024);
    CHECK(flicker.compared > 63 * 1024 * 9 / 10);
}

TEST_CASE("a renderer that reverses all layers in every second frame flips in order wherever two layers are visible") {
    const scenes::HardCase& hard = hard_named("crossing-between-rows");
    const auto frame = std::make_shared<int>(0);
    const RenderFunction turning = [&hard, frame](const scenes::Scene& scene, const pipeline::View& view) {
        RenderedPixels rendered = look_exactly(hard)(scene, view);
        if (++*frame % 2 != 0) return rendered;
        for (auto& pixel : rendered.pixels)
            for (auto& f : pixel.fragments) f.layer = -f.layer + 9;
        return rendered;
    };
    const PathCase path{hard};
    const Flicker flicker = path.flicker(turning);
    CHECK(flicker.coverage == 0);
    CHECK(flicker.compared == path.flicker(look_exactly(hard)).compared);
    // The camera's shift leaves some pixels at the border with fewer than two fragments.
    CHECK(flicker.order > flicker.compared * 9 / 10);
    // The order by exact depths does not depend on the reported order.
    CHECK(path.flicker_of_exact_depths(turning).order == 0);
}

TEST_CASE("a renderer that loses a triangle in every second frame flips in coverage and not in order") {
    const scenes::HardCase& hard = hard_named("crossing-between-rows");
    const auto frame = std::make_shared<int>(0);
    const RenderFunction losing = [&hard, frame](const scenes::Scene& scene, const pipeline::View& view) {
        RenderedPixels rendered = look_exactly(hard)(scene, view);
        if (++*frame % 2 != 0) return rendered;
        for (auto& pixel : rendered.pixels)
            std::erase_if(pixel.fragments, [](const auto& f) { return f.primitive < 2; });
        return rendered;
    };
    const Flicker flicker = PathCase{hard}.flicker(losing);
    CHECK(flicker.order == 0);
    CHECK(flicker.coverage > flicker.compared * 9 / 10);
}

// Stored depths flicker at a distance of one unit in every format, exact depths do not.
TEST_CASE("stored depths flicker on every path where planes are one unit apart and exact depths never do", "[slow]") {
    const scenes::HardCase& hard = hard_named("planes-1-unit");
    const tools::MovedCaseRenderer renderer{hard};
    const pipeline::DeviceProfile& eight = *pipeline::find_profile("geforce8");
    const peeling::Algorithm& peel = *peeling::find_algorithm("front_to_back");
    const tools::MovedRow row = renderer.run(eight, pipeline::DepthFormat::d24, peel, {});
    CHECK(row.own.order > 0);
    const nlohmann::ordered_json json = flicker_json(row);
    CHECK(json["paths"]["float32"]["order"] == row.own.order);
    CHECK(json["paths"]["float32_plane"]["order"] > row.own.order);
    CHECK(json["paths"]["window_z"].is_null());  // geforce8 does not have this path
    CHECK(json["paths"]["exact_unstored"]["order"] == 0);
    CHECK(row.stability.verdict == tools::StabilityVerdict::stable);
    // Other algorithms have no table of paths.
    const auto other = renderer.run(eight, pipeline::DepthFormat::d24, *peeling::find_algorithm("depth_units"), {});
    CHECK(flicker_json(other)["paths"].is_null());
}

TEST_CASE("five algorithms take part in movements") {
    int moved = 0;
    for (const peeling::Algorithm& algorithm : peeling::algorithms()) moved += tools::is_moved(algorithm) ? 1 : 0;
    CHECK(moved == 5);
}
