// Tests that a depth bias which exchanges all close layers in one direction is a mistake, and that depths of another
// precision, which exchange some of them, are none.
#include "tools/oracle/verdict/exchanged_depths.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/verdict/picture_verdict.h"
#include "tools/oracle/verdict/report.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

// Plane n is a grid of 8 + n by 8 + n squares.
int plane_of(const pipeline::CapturedFragment& f) { return f.primitive < 128 ? 0 : f.primitive < 128 + 162 ? 1 : 2; }

// Planes 1 code of 16 bits apart.
OpenedScene close_planes(int count) {
    OpenedScene opened{"planes:count=" + std::to_string(count) + ",gap=32", 48, 36};
    opened.profile = *pipeline::find_profile("llvmpipe");
    opened.options.depth = pipeline::DepthFormat::d16;
    for (pipeline::Mesh& mesh : opened.scene.list.meshes)
        for (Rgba& color : mesh.colors) color[3] = 0.5f;
    return opened;
}

// A port whose depths are off by so many codes.
using Off = std::function<int(const pipeline::CapturedFragment&)>;
ChangeList with_depths_off_by(const Off& off) {
    return [off](PortList& l) {
        for (auto& f : l.visible) f.code += static_cast<std::uint32_t>(off(f));
        std::ranges::stable_sort(l.visible, {}, &pipeline::CapturedFragment::code);
    };
}

// -1, 0 or 1, the same for the same number.
int noise(std::uint32_t n) {
    n = (n ^ n >> 16) * 0x7feb352d;
    n = (n ^ n >> 15) * 0x846ca68b;
    return static_cast<int>((n ^ n >> 16) % 3) - 1;
}

PictureVerdict verdict_on(const OpenedScene& opened, const Off& off) {
    const oracle::TargetImage picture = picture_of_port(opened, port_of_codes(Order::over), with_depths_off_by(off));
    return judge_picture(opened.input(), {.colors = picture});
}

}  // namespace

TEST_CASE("a bias of one surface that exchanges all close layers is wrong and the surfaces are named") {
    const OpenedScene opened = close_planes(2);
    std::vector<std::string> wrong;
    for (const int plane : {0, 1})
        for (const int bias : {-2, 2}) {
            const PictureVerdict found = verdict_on(
                opened, [&](const pipeline::CapturedFragment& f) { return plane_of(f) == plane ? bias : 0; });
            const std::string line = first_line(found.found, opened.scene.list);
            INFO(plane << ", " << bias << ": " << line);
            if (found.state() == State::right) continue;
            CHECK(found.state() == State::wrong);
            wrong.push_back(line);
        }
    REQUIRE(wrong.size() == 2);  // the nearer plane is moved back, or the farther one to the front
    for (const std::string& line : wrong)
        CHECK(line.find("all in one direction, as by a depth bias: triangles of instance 0 (mesh planes) lie behind "
                        "those that are submitted") != std::string::npos);
}

TEST_CASE("a bias that reverses three surfaces is wrong") {
    const OpenedScene opened = close_planes(3);
    std::size_t wrong = 0;
    for (const int bias : {-2, 2}) {
        const PictureVerdict found =
            verdict_on(opened, [bias](const pipeline::CapturedFragment& f) { return bias * plane_of(f); });
        INFO(bias << ": " << first_line(found.found, opened.scene.list));
        wrong += found.state() == State::wrong ? 1 : 0;
        CHECK(found.state() != State::right_but_excused);
    }
    CHECK(wrong == 1);
}

TEST_CASE("depths that are off by one code in both directions are right and what is open is said") {
    const OpenedScene opened = close_planes(2);
    const Off of_fragments = [](const pipeline::CapturedFragment& f) { return noise(f.pixel * 977 + f.primitive); };
    const Off of_triangles = [](const pipeline::CapturedFragment& f) { return noise(f.primitive); };
    for (const Off& off : {of_fragments, of_triangles}) {
        const PictureVerdict found = verdict_on(opened, off);
        const std::string line = first_line(found.found, opened.scene.list);
        INFO(line);
        CHECK(found.state() == State::right_but_excused);
        CHECK(found.found.right.at_close_depths > 10);
    }
}
