// Tests the cells of an invariance plan: near and far planes against those of the projection matrix, and hypotheses
// against the list of the profile.
#include "tools/lab/invariance/invariance_cell.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <set>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/rules/hypotheses.h"
#include "scenes/camera.h"
#include "tests/tools/program.h"

namespace {

using namespace strata::tools;

Cell small_cell() {
    Cell cell;
    cell.scene = "planes:count=2,cells=1";
    cell.profile = "ideal";
    cell.width = 16;
    cell.height = 8;
    cell.algorithm = strata::peeling::find_algorithm("front_to_back");
    cell.write = cell.compare = strata::rasterizer::DepthPath::float32;
    return cell;
}

CellRunner runner() {
    strata::peeling::RenderOptions resources;
    resources.threads = 1;
    return {{}, resources};
}

// Near and far plane of the projection matrix.
std::pair<double, double> planes_of(const CellView& view) {
    const auto& m = view.view.projection;
    return {m[3][2] / (m[2][2] - 1), m[3][2] / (m[2][2] + 1)};
}

}  // namespace

TEST_CASE("the depth range of a cell is the orbit's or the orbit's far plane with a ratio or two given planes") {
    CellRunner cells = runner();
    Cell cell = small_cell();
    const CellView orbit = cells.view(cell);
    CHECK(orbit.far / orbit.near == Approx(3.6 / 1.4));
    cell.range = {.ratio = 1000};
    const CellView wide = cells.view(cell);
    CHECK(wide.far == orbit.far);
    CHECK(wide.near == Approx(orbit.far / 1000));
    cell.range = {.near = 0.5, .far = 77};
    const CellView own = cells.view(cell);
    CHECK((own.near == 0.5 && own.far == 77));
    for (const CellView& view : {orbit, wide, own}) {
        CHECK(planes_of(view).first == Approx(view.near).epsilon(1e-9));
        CHECK(planes_of(view).second == Approx(view.far).epsilon(1e-9));
        CHECK(view.view.view == orbit.view.view);                                     // the eye does not move
        CHECK(view.view.projection[1][1] / view.view.projection[0][0] == Approx(2));  // 16 x 8
    }
    cell.azimuth += 90;
    CHECK(cells.view(cell).view.view != orbit.view.view);
}

TEST_CASE("a cell uses the scene's own view unless an orbit is named and the planes of that view cannot be changed") {
    CellRunner cells = runner();
    Cell cell = small_cell();
    cell.scene = "hard:case=planes-1-unit";
    // The case's corners are clip coordinates, so the view is the identity.
    const CellView own = cells.view(cell);
    CHECK(own.is_own);
    CHECK(own.view.view == strata::identity);
    CHECK(own.view.projection == strata::identity);
    // Two planes cover the whole frame.
    const CellResult seen = cells.run(cell);
    CHECK(seen.measured.errors.layers == 2 * 16 * 8);
    cell.range = {.ratio = 1000};
    CHECK_THROWS_WITH(cells.check(cell),
                      "hard:case=planes-1-unit: near_far: expected orbit, for the scene's own view and a camera have "
                      "planes of their own "
                      "(--orbit gives another view), found ratio:1000");
    cell.takes_own_view = false;
    CHECK_NOTHROW(cells.check(cell));
    CHECK_FALSE(cells.view(cell).is_own);
    CHECK(cells.view(cell).far > 0);
}

TEST_CASE("a pack's own view is converted from the pack's clip space and depth order to those of the cells") {
    using strata::test::run_strata;
    const strata::test::Folder folder;
    const auto pack = [&](const std::string& name, const std::vector<std::string>& convention) {
        std::vector<std::string> words{"golden",
                                       "planes:count=2,cells=1",
                                       "--size",
                                       "16x16",
                                       "--algorithm",
                                       "front_to_back",
                                       "--depth-format",
                                       "d32f",
                                       "--profile",
                                       "ideal",
                                       "-o",
                                       name};
        words.insert(words.end(), convention.begin(), convention.end());
        REQUIRE(run_strata(folder, words).status == 0);
        return folder / name;
    };
    const std::vector<std::vector<std::string>> conventions{
        {},
        {"--clip-depth", "zero-to-one"},
        {"--depth-order", "greater"},
        {"--clip-depth", "zero-to-one", "--depth-order", "greater"}};
    std::vector<CellView> views;
    std::vector<std::uint64_t> layers;
    for (const auto& convention : conventions) {
        CellRunner cells = runner();
        Cell cell = small_cell();
        cell.height = cell.width;
        cell.scene = pack("pack" + std::to_string(views.size()), convention);
        views.push_back(cells.view(cell));
        layers.push_back(cells.run(cell).measured.errors.layers);
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        INFO(i);
        CHECK(views[i].is_own);
        CHECK(planes_of(views[i]).first == Approx(planes_of(views[0]).first).epsilon(1e-5));
        CHECK(planes_of(views[i]).second == Approx(planes_of(views[0]).second).epsilon(1e-4));
        CHECK(layers[i] == layers[0]);
    }
    CHECK(layers[0] > 0);
}

TEST_CASE("a cell uses the profile's subpixel grid unless it names one") {
    CellRunner cells = runner();
    for (const char* profile : {"geforce3", "ideal"})
        for (const int bits : {0, 4, 8, 12}) {
            Cell cell = small_cell();
            cell.profile = profile;
            cell.subpixel_bits = bits;
            const int own = strata::pipeline::find_profile(profile)->raster.subpixel_bits;
            CHECK(cells.view(cell).subpixel_bits == (bits == 0 ? own : bits));
        }
}

TEST_CASE("the hypothesis all expands to the profile and each of its open constants once in the order of the list") {
    CellRunner cells = runner();
    Cell open = small_cell(), plain = small_cell();
    open.profile = "geforce3";
    open.hypothesis = "all";
    plain.max_passes = 3;
    const auto expanded = cells.expanded({open, plain});
    const auto named = strata::rasterizer::depth_hypotheses(strata::pipeline::find_profile("geforce3")->raster);
    REQUIRE(named.size() > 3);
    REQUIRE(expanded.size() == named.size() + 1);
    std::set<std::string> distinct;
    for (std::size_t i = 0; i < named.size(); ++i) {
        CHECK(expanded[i].hypothesis == (i == 0 ? "profile" : named[i].name));
        CHECK(distinct.insert(expanded[i].hypothesis).second);
        CHECK_NOTHROW(cells.check(expanded[i]));
        Cell same = expanded[i];
        same.hypothesis = "all";
        CHECK(same == open);
    }
    CHECK(expanded.back() == plain);
}

TEST_CASE("an unknown scene or profile or hypothesis is rejected before anything runs") {
    CellRunner cells = runner();
    const auto said = [&](auto&& change) {
        Cell cell = small_cell();
        change(cell);
        try {
            cells.check(cell);
        } catch (const strata::InputError& error) {
            return std::string{error.what()};
        }
        return std::string{};
    };
    CHECK(said([](Cell&) {}) == "");
    CHECK_THAT(said([](Cell& c) { c.scene = "planse"; }), Catch::EndsWith("(did you mean 'planes'?)"));
    CHECK_THAT(said([](Cell& c) { c.profile = "idael"; }), Catch::EndsWith("(did you mean 'ideal'?)"));
    CHECK_THAT(said([](Cell& c) { c.profile = "geforce3", c.hypothesis = "depth_ronding=x"; }),
               Catch::StartsWith("geforce3: hypothesis: expected profile, all, "));
}

TEST_CASE("equal depth paths make no error and what the device lacks is reported as the cell's rejection") {
    CellRunner cells = runner();
    const CellResult same = cells.run(small_cell());
    CHECK(same.refusal.empty());
    CHECK(same.measured.paths.fragments > 0);
    CHECK(same.measured.paths.differing == 0);
    CHECK(same.measured.errors.total() == 0);
    CHECK(same.measured.errors.layers_max == 2);
    CHECK((same.measured.peeled && same.measured.ended));
    Cell refused = small_cell();
    refused.profile = "geforce3";
    refused.format = strata::pipeline::DepthFormat::d32f;
    CHECK_THAT(cells.run(refused).refusal, Catch::Contains("geforce3"));
}

TEST_CASE("every part of a remedy changes the measurement where the depth paths differ") {
    CellRunner cells = runner();
    Cell cell = small_cell();
    cell.scene = "planes:count=3,cells=2,gap=64";
    cell.width = cell.height = 24;
    cell.write = strata::rasterizer::DepthPath::float32_plane;
    cell.compare = strata::rasterizer::DepthPath::exact;
    const auto measured = [&](const Remedy& remedy) {
        Cell with = cell;
        with.remedy = remedy;
        return cells.run(with).measured;
    };
    const auto none = measured({});
    REQUIRE(none.errors.total() > 0);
    Remedy ulps;
    ulps.epsilon.ulps = 1 << 20;
    CHECK(measured(ulps).errors.duplicated == 0);
    CHECK(measured(ulps).errors.lost > none.errors.lost);  // closer layers become one
    Remedy bias, slope, replaced;
    bias.bias_constant = 4096;
    slope.bias_slope = 64;
    replaced.depth_replace = true;
    CHECK(measured(replaced).paths.where != none.paths.where);
    cell.profile = "geforce3";  // geforce3 applies no offset to the compared depth
    cell.algorithm = strata::peeling::find_algorithm("shadow_map");
    cell.write = strata::rasterizer::DepthPath::window_z;
    cell.compare = strata::rasterizer::DepthPath::perspective_rq;
    const auto unbiased = measured({});
    CHECK(measured(bias).errors.lost != unbiased.errors.lost);
    CHECK(measured(slope).errors.lost != unbiased.errors.lost);
}

TEST_CASE("a cell with a camera has the view of render --camera and cannot have an orbit or planes or degrees") {
    const strata::test::Folder folder;
    std::ofstream(folder / "top.json")
        << R"({"eye":[0,5,0.1],"center":[0,0,0],"up":[0,0,-1],"fovy_degrees":40,"near":1,"far":9})";
    CellRunner cells = runner();
    Cell cell = small_cell();
    cell.camera = folder / "top.json";
    CHECK_NOTHROW(cells.check(cell));
    const CellView view = cells.view(cell);
    CHECK(view.is_own);
    const auto wanted = strata::scenes::load_camera(folder / "top.json", double(cell.width) / cell.height);
    CHECK(view.view.view == wanted.view);
    CHECK(view.view.projection == wanted.projection);
    cell.range = {.ratio = 1000};
    CHECK_THROWS_WITH(cells.check(cell), Catch::Contains("near_far: expected orbit"));
    cell.range = {};
    cell.takes_own_view = false;
    CHECK_THROWS_WITH(cells.check(cell),
                      "planes:count=2,cells=1: camera: expected either a camera or an orbit, found both");
    cell.takes_own_view = true;
    cell.camera = "nowhere.json";
    CHECK_THROWS(cells.check(cell));
}
