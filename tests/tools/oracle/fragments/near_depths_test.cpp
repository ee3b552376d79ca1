// Tests the lists of pixels whose depths nearly meet, and the verdict on ports that order or merge them otherwise.
#include "tools/oracle/fragments/near_depths.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/verdict/picture_verdict.h"
#include "tools/oracle/verdict/report.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

// Fragments of triangles 0, 1, 2 ... at these depths.
OtherList at_depths(const std::vector<std::uint32_t>& codes) {
    OtherList list;
    for (const std::uint32_t code : codes)
        list.visible.push_back({.color = {1, 0, 0, 0.5f},
                                .code = code,
                                .shader_z = static_cast<float>(code) * 0x1p-24f,
                                .primitive = static_cast<std::uint32_t>(list.visible.size())});
    return list;
}

// The triangles of each list that is added, as digits.
std::multiset<std::string> added(const OtherList& given) {
    std::vector<OtherList> others;
    add_close_depths(given, others);
    std::multiset<std::string> all;
    for (const OtherList& other : others) {
        CHECK(other.has_close_depths);
        CHECK(std::ranges::is_sorted(other.visible, {}, &Fragment::code));
        std::string triangles;
        for (const Fragment& f : other.visible) triangles += std::to_string(f.primitive);
        all.insert(triangles);
    }
    return all;
}

// Of neighbours at most `codes` apart the nearest alone is kept.
ChangeList losing_within(std::uint32_t codes) {
    return [codes](PortList& l) {
        std::vector<pipeline::CapturedFragment> kept;
        for (std::size_t i = 0; i < l.visible.size(); ++i)
            if (i == 0 || l.visible[i].code - l.visible[i - 1].code > codes) kept.push_back(l.visible[i]);
        l.visible = kept;
    };
}

std::string line_on(const std::string& planes, const ChangeList& change, State expected) {
    OpenedScene opened{planes, 32, 24};
    opened.profile = *pipeline::find_profile("llvmpipe");
    opened.options.depth = pipeline::DepthFormat::d16;
    for (pipeline::Mesh& mesh : opened.scene.list.meshes)
        for (Rgba& color : mesh.colors) color[3] = 0.5f;
    const oracle::TargetImage picture = picture_of_port(opened, port_of_codes(Order::over), change);
    const PictureVerdict found = judge_picture(opened.input(), {.colors = picture});
    const std::string line = first_line(found.found, opened.scene.list);
    INFO(planes << ": " << to_text(found.found, opened.scene.list));
    CHECK(found.state() == expected);
    return line;
}

}  // namespace

TEST_CASE("of two depths within two codes either may be kept and they may be exchanged or merged") {
    CHECK(added(at_depths({100, 102, 500})) == std::multiset<std::string>{"02", "12", "102", "02"});
    CHECK(added(at_depths({100, 103, 500})).empty());
    CHECK(added(at_depths({100, 100, 500})).empty());          // ties have their own rules
    CHECK(added(at_depths({100, 100, 101})).count("0") == 2);  // the nearest is kept, or all are merged
}

TEST_CASE("groups of near depths are changed all alike or one alone") {
    const auto lists = added(at_depths({10, 11, 50, 51}));
    for (const char* const one : {"02", "13", "1032", "023", "123", "1023", "012", "013", "0132"})
        CHECK(lists.count(one) > 0);
}

TEST_CASE("a port that merges depths within two codes is excused and it is said that this is open") {
    const std::string line = line_on("planes:count=3,gap=32", losing_within(2), State::right_but_excused);
    CHECK(line.find("where depths differ by at most 2 codes, so that their order and merging are open") !=
          std::string::npos);
}

TEST_CASE("a port that merges depths farther apart is wrong") {
    line_on("planes:count=3,gap=512", losing_within(64), State::wrong);
}
