// Tests that the judge names mistakes with a pixel's layers that no rule lists: the test changes the lists of a port
// (wrong_ports.h), and a program is fitted to its picture.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/judge/judge.h"

using namespace strata;
using namespace strata::test;
using pipeline::CapturedFragment;

namespace {

std::string judged_port(const ChangeList& change) {
    const OpenedScene opened{"random:seed=9,triangles=120", 48, 36};
    const oracle::Picture picture{
        .targets = {picture_of_port(opened, port_of_codes(oracle::verdict::Order::under), change)}};
    return judge(opened.input(), {.candidate = picture, .has_alpha = false}, oracle::Effort::single).sentence;
}

}  // namespace

TEST_CASE("a layer that is blended twice or exchanged with the next is named by its rank") {
    CHECK(judged_port([](PortList& l) {
              if (!l.visible.empty()) l.visible.insert(l.visible.begin(), CapturedFragment{l.visible[0]});
          }) == "wrong: fragments with rank from the front 0 are blended twice");
    CHECK(judged_port([](PortList& l) {
              if (l.visible.size() > 1) std::swap(l.visible[0], l.visible[1]);
          }) == "wrong: fragments with rank from the front below 2 are composited in reverse order");
}

TEST_CASE("layers that are lost by their order of submission or every second one are named by that property") {
    CHECK(judged_port([](PortList& l) {
              const auto first = std::ranges::min_element(l.visible, {}, &CapturedFragment::primitive);
              if (first != l.visible.end()) l.visible.erase(first);
          }) == "wrong: fragments with rank in drawing order 0 are left out");
    CHECK(judged_port([](PortList& l) {
              std::size_t rank = 0;
              std::erase_if(l.visible, [&](const CapturedFragment&) { return rank++ % 2 == 1; });
          }) == "wrong: fragments of odd ranks from the front are left out");
}

TEST_CASE("a pair of mistakes that no rule lists is named by both") {
    const std::string sentence = judged_port([](PortList& l) {
        for (CapturedFragment& f : l.visible)
            for (int c = 0; c < 3; ++c) f.color[c] *= f.color[3];
        std::ranges::reverse(l.visible);
    });
    CHECK(sentence ==
          "wrong: all fragments have colours multiplied by alpha twice; and all fragments are composited in reverse "
          "order");
}
