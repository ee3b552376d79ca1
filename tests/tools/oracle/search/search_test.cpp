// Tests the search for mistakes on pictures of ports that the test makes by changing their lists (wrong_ports.h), and
// of the renderer's own peels that are stopped early.
#include "tools/oracle/search/search.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/verdict/verdict.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

std::set<std::string> found(const Verdict& verdict) {
    std::set<std::string> names;
    for (const CheckedAccount& c : verdict.explanations)
        for (const Rule& rule : c.account.rules)
            names.insert(std::string{name(rule.kind)} + " " + std::to_string(rule.n));
    return names;
}

struct WrongPort {
    const char* wanted;
    ChangeList change;
};

void lose(PortList& list, std::size_t number) {
    if (number < list.visible.size()) list.visible.erase(list.visible.begin() + static_cast<std::ptrdiff_t>(number));
}

const std::vector<WrongPort>& wrong_ports() {
    static const std::vector<WrongPort> all{
        {"nearest_alone 2", [](PortList& l) { l.visible.resize(std::min<std::size_t>(l.visible.size(), 2)); }},
        {"farthest_alone 2",
         [](PortList& l) {
             while (l.visible.size() > 2) lose(l, 0);
         }},
        {"lost 1", [](PortList& l) { lose(l, 1); }},
        {"lost_from_far 0", [](PortList& l) { lose(l, l.visible.size() - 1); }},
        {"reversed 0", [](PortList& l) { std::ranges::reverse(l.visible); }},
        {"as_submitted 0",
         [](PortList& l) {
             std::ranges::sort(l.visible, std::ranges::greater{}, &pipeline::CapturedFragment::primitive);
         }},
        {"first_submitted 2",
         [](PortList& l) {
             std::ranges::sort(l.visible, {}, &pipeline::CapturedFragment::primitive);
             l.visible.resize(std::min<std::size_t>(l.visible.size(), 2));
             std::ranges::stable_sort(l.visible, {}, &pipeline::CapturedFragment::code);
         }},
        {"hidden_shown 0", [](PortList& l) { l.visible.insert(l.visible.end(), l.hidden.begin(), l.hidden.end()); }},
        {"behind_drawn 0",
         [](PortList& l) {
             std::ranges::sort(l.visible, {}, &pipeline::CapturedFragment::primitive);
             std::vector<pipeline::CapturedFragment> kept;
             for (const auto& f : l.visible)
                 if (kept.empty() || f.code < kept.back().code) kept.push_back(f);
             std::ranges::reverse(kept);
             l.visible = kept;
         }},
        {"alpha_squared 0",
         [](PortList& l) {
             for (auto& f : l.visible) f.color[3] *= f.color[3];
         }},
        {"premultiplied_twice 0",
         [](PortList& l) {
             for (auto& f : l.visible)
                 for (int c = 0; c < 3; ++c) f.color[c] *= f.color[3];
         }},
        {"background_lost 0",
         [](PortList& l) {
             if (!l.has_opaque) l.background = {0, 0, 0, 0};
         }},
        {"opaque_in_front 0",
         [](PortList& l) {
             if (l.has_opaque) l.visible.clear();
         }},
    };
    return all;
}

}  // namespace

TEST_CASE("a mistake of a port in the structure is found from its picture alone for every order of blending",
          "[long]") {
    const OpenedScene opened{"showroom", 48, 48};
    std::vector<std::string> missed;
    std::size_t number = 0;
    for (const WrongPort& port : wrong_ports()) {
        // Each port has one of the orders of blending, alternating, because testing all three for each port would find
        // nothing more.
        const Order orders[] = {Order::over, Order::under, Order::both_ends};
        const Order order = orders[number++ % 3];
        const Verdict verdict = judged(opened, picture_of_port(opened, port_of_codes(order), port.change));
        if (verdict.is_right || !found(verdict).contains(port.wanted)) missed.emplace_back(port.wanted);
    }
    CHECK(missed == std::vector<std::string>{});
}

TEST_CASE("a port that changes nothing is right with every order of blending") {
    const OpenedScene opened{"showroom", 32, 32};
    for (const Order order : {Order::over, Order::under, Order::both_ends})
        CHECK(judged(opened, picture_of_port(opened, port_of_codes(order), {})).is_right);
}

// LESS against the cleared depth of 1 hides them; a port without a depth test has nothing to compare with.
TEST_CASE("fragments at the depth of the far plane are right where a port without a depth test composites them") {
    OpenedScene opened{"planes:count=3", 48, 36};
    for (int column = 0; column < 4; ++column)  // z = w
        opened.view.projection[column][2] = opened.view.projection[column][3];
    const auto show_all = [](PortList& l) { std::swap(l.visible, l.hidden); };
    const Verdict all = judged(opened, picture_of_port(opened, port_of_codes(Order::under), show_all));
    CHECK(all.is_right);
    CHECK(all.shown_at_far_plane > 100);
    const Verdict none = judged(opened, picture_of_port(opened, port_of_codes(Order::under), {}));
    CHECK(none.is_right);
    CHECK(none.shown_at_far_plane == 0);
}

TEST_CASE("a peel that is stopped early is described by the layers that it has composited") {
    OpenedScene opened{"showroom", 48, 48};
    opened.options.max_passes = 2;  // of three layers
    CHECK(found(judged(opened, *opened.picture("front_to_back", pipeline::Format::rgba8))).contains("nearest_alone 2"));
    // The first pass of a dual peel composites nothing.
    CHECK(found(judged(opened, *opened.picture("dual", pipeline::Format::rgba8))).contains("ends_alone 1"));
}

TEST_CASE("a mistake is found in a picture of floats although rounding leaves some units in the last place open") {
    const OpenedScene opened{"showroom", 32, 32};
    for (const pipeline::Format format : {pipeline::Format::rgba16f, pipeline::Format::rgba32f})
        CHECK(found(judged(opened, *opened.picture("unsorted", format))).contains("as_submitted 0"));
}

TEST_CASE("layers that are lost in the middle of many are found although truncation could lose as much", "[long]") {
    const OpenedScene opened{"hard:case=inside-out", 32, 32};
    Hypothesis floats = port_of_codes(Order::both_ends);
    floats.front = floats.back = {Storage::single, SourceRounding::unrounded, Rounding::nearest};
    const auto lose_middle = [](PortList& l) {
        while (l.visible.size() > 10) lose(l, 5);
    };
    const Verdict verdict = judged(opened, picture_of_port(opened, floats, lose_middle));
    CHECK_FALSE(verdict.is_right);
    CHECK(found(verdict).contains("ends_alone 5"));
}

TEST_CASE("a picture that is right except for reversed rows is reported as such") {
    const OpenedScene opened{"showroom", 32, 32};
    oracle::TargetImage picture = picture_of_port(opened, port_of_codes(Order::under), {});
    for (std::size_t y = 0; y < 16; ++y)
        std::swap_ranges(picture.codes.begin() + static_cast<std::ptrdiff_t>(y * 128),
                         picture.codes.begin() + static_cast<std::ptrdiff_t>((y + 1) * 128),
                         picture.codes.begin() + static_cast<std::ptrdiff_t>((31 - y) * 128));
    const Verdict verdict = judged(opened, picture);
    CHECK_FALSE(verdict.is_right);
    CHECK(found(verdict) == std::set<std::string>{"rows_reversed 0"});
}

TEST_CASE("another background is reported with its colour") {
    const OpenedScene opened{"showroom", 32, 32};
    const auto change = [](PortList& l) {
        if (!l.has_opaque) l.background = {1, 0.6f, 0.2f, 1};
    };
    const Verdict verdict = judged(opened, picture_of_port(opened, port_of_codes(Order::over), change));
    CHECK(found(verdict) == std::set<std::string>{"background_other 0"});
    CHECK(verdict.facts.background == Rgba{1, 0.6f, 0.2f, 1});
}

TEST_CASE("a rule that explains only some of the wrong pixels is a lead and not an explanation", "[long]") {
    const OpenedScene opened{"showroom", 32, 32};
    std::size_t number = 0;
    const auto change = [&](PortList& l) {
        if (number++ % 2 == 0) lose(l, 0);  // no rule on a pixel's list describes this choice
    };
    const Verdict verdict = judged(opened, picture_of_port(opened, port_of_codes(Order::over), change));
    CHECK_FALSE(verdict.is_right);
    CHECK(verdict.explanations.empty());
    REQUIRE(!verdict.leads.empty());
    CHECK(verdict.leads[0].explained > 0);
}
