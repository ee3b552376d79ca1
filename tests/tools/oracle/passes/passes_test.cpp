// Tests the passes of algorithms: depths against each pixel's fragments sorted by depth, and numbers of passes against
// a run without an observer.
#include "tools/oracle/passes/passes.h"

#include <bit>
#include <catch2/catch.hpp>
#include <set>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "scenes/camera.h"
#include "scenes/scene.h"
#include "tests/tools/oracle/picture/own_file.h"
#include "tools/oracle/passes/contact_sheet.h"
#include "tools/oracle/picture/picture.h"

using namespace strata;
using namespace strata::oracle;

namespace {

struct Loaded {
    scenes::Scene scene;
    pipeline::View view;
    peeling::RenderOptions options;
};

Loaded small_scene(const char* name) {
    Loaded loaded{scenes::load_scene(name, {}), {}, {}};
    loaded.options.width = 24;
    loaded.options.height = 16;
    loaded.options.threads = 1;
    loaded.view = scenes::orbit_view(loaded.scene.bounds, 30, 20, 1.5);
    return loaded;
}

std::vector<PassReport> passes_of(const Loaded& l, const char* profile, const std::string& algorithm) {
    std::vector<PassReport> all;
    passes({l.scene.list, l.view, *pipeline::find_profile(profile), l.options}, *peeling::find_algorithm(algorithm),
           [&](PassReport&& pass) { all.push_back(std::move(pass)); });
    return all;
}

const pipeline::Image& image_of(const PassReport& pass, const std::string& name) {
    for (const NamedImage& target : pass.targets)
        if (target.name == name) return target.image;
    FAIL("no target " << name);
    throw 0;
}

}  // namespace

TEST_CASE("every algorithm reports as many passes as it counts with every target and its picture last") {
    const Loaded l = small_scene("teapot");
    int ran = 0;
    for (const peeling::Algorithm& algorithm : peeling::algorithms()) {
        peeling::Renderer renderer{l.scene.list, l.view, *pipeline::find_profile("ideal"), l.options};
        const peeling::RenderResult usual = renderer.render(algorithm);
        if (usual.outcome == peeling::Outcome::refused) {
            CHECK_THROWS_AS(passes_of(l, "ideal", algorithm.name), pipeline::Refused);
            continue;
        }
        ++ran;
        INFO(algorithm.name);
        const auto all = passes_of(l, "ideal", algorithm.name);
        int geometry = 0, screen = 0;
        std::set<std::string> unnamed;
        for (const PassReport& pass : all) {
            geometry += pass.kind == ReportedPassKind::geometry ? 1 : 0;
            screen += pass.kind == ReportedPassKind::full_screen ? 1 : 0;
            for (const NamedImage& target : pass.targets)
                if (target.name.starts_with("target.")) unnamed.insert(target.name);
        }
        CHECK(geometry == usual.frame.passes.geometry);
        CHECK(screen == usual.frame.passes.full_screen);
        CHECK(unnamed.empty());
        CHECK(all.back().kind == ReportedPassKind::published);
        CHECK(all.back().targets.at(0).image == usual.frame.color);
    }
    CHECK(ran >= 15);
}

TEST_CASE("after pass k of a dual peel the min-max depths are the k-th nearest and the k-th farthest of each pixel") {
    const Loaded l = small_scene("random");
    const auto all = passes_of(l, "geforce8", "dual");
    peeling::Renderer renderer{l.scene.list, l.view, *pipeline::find_profile("geforce8"), l.options};
    const auto fragments = renderer.fragments(*peeling::find_algorithm("dual"));
    std::vector<std::set<float>> depths(24 * 16);
    for (const auto& fragment : fragments.all)
        if (fragment.shader_z < std::bit_cast<float>(fragments.opaque[fragment.pixel]))
            depths[fragment.pixel].insert(fragment.shader_z);
    std::size_t peeled = 0, wrong = 0, most = 0;
    for (const PassReport& pass : all) {
        if (pass.kind != ReportedPassKind::geometry) continue;
        const pipeline::Image& min_max = image_of(pass, pass.writes.at(0));
        for (std::size_t p = 0; p < depths.size(); ++p) {
            std::vector<float> left(depths[p].begin(), depths[p].end());
            most = std::max(most, left.size());
            const bool some = left.size() > 2 * peeled;
            const float near = some ? left[peeled] : 1.0f, far = some ? left[left.size() - 1 - peeled] : -1.0f;
            if (std::bit_cast<float>(min_max.codes[2 * p]) != -near ||
                std::bit_cast<float>(min_max.codes[2 * p + 1]) != far)
                ++wrong;
        }
        ++peeled;
    }
    CHECK(most > 6);
    CHECK(wrong == 0);
    CHECK(peeled == static_cast<std::size_t>(peeling::find_algorithm("dual")->geometry_passes(static_cast<int>(most))));
}

TEST_CASE("a query is reported with the pass that it follows and the last query ends the loop") {
    const auto all = passes_of(small_scene("teapot"), "geforce8", "front_to_back");
    std::vector<Query> queries;
    for (const PassReport& pass : all) queries.insert(queries.end(), pass.queries.begin(), pass.queries.end());
    REQUIRE(queries.size() >= 2);
    CHECK(queries.back().count == 0);
    CHECK_FALSE(queries.back().goes_on);
    CHECK(queries.front().goes_on);
    for (std::size_t i = 1; i < queries.size(); ++i) CHECK(queries[i].count <= queries[i - 1].count);
    CHECK(all[0].before ==
          std::vector<std::string>{"clear accumulated", "clear layer", "copy opaque_depth to nearest.1"});
}

TEST_CASE("targets of every format are read back from their file code by code") {
    using pipeline::Format;
    std::vector<NamedImage> targets;
    for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f, Format::r16f, Format::r32f,
                                Format::rg32f, Format::d16, Format::d24, Format::d32f, Format::s8}) {
        pipeline::Image image{format, 3, 2};
        std::uint32_t code = 7;
        for (std::uint32_t& stored : image.codes) {
            code = code * 1664525u + 1013904223u;
            const auto bits = pipeline::info(format);
            const unsigned shift = bits.type == pipeline::ChannelType::half || format == Format::d16      ? 17
                                   : bits.type == pipeline::ChannelType::single || format == Format::d32f ? 2
                                   : format == Format::d24                                                ? 8
                                                                                                          : 24;
            stored = code >> shift;
        }
        targets.push_back({std::string(pipeline::info(format).name), std::move(image)});
    }
    const test::OwnFile file{".exr"};
    write_targets(file.path(), targets);
    const Picture picture = read_picture(file.path());
    REQUIRE(picture.targets.size() == targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        CHECK(picture.targets[i].part == targets[i].name);
        CHECK(std::ranges::equal(picture.targets[i].codes, targets[i].image.codes));
    }
}

TEST_CASE("a contact sheet has every target after every pass") {
    const Loaded l = small_scene("teapot");
    ContactSheet sheet;
    std::size_t rows = 0;
    std::set<std::string> columns;
    for (const PassReport& pass : passes_of(l, "geforce8", "dual")) {
        sheet.add(pass);
        ++rows;
        for (const NamedImage& target : pass.targets) columns.insert(target.name);
    }
    const pipeline::Image image = sheet.image();
    // Pixels of a frame of 24 x 16 are enlarged to squares of 4 x 4.
    CHECK(image.width == 128 + (4 * 24 + 4) * static_cast<int>(columns.size()));
    CHECK(image.height == 16 + (4 * 16 + 4) * static_cast<int>(rows));
}
