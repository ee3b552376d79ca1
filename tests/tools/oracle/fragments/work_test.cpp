// Tests that a search counts the same steps with any number of threads, and the verdict of a search that was stopped.
#include "tools/oracle/fragments/work.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/verdict/report.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

struct Counted {
    Verdict verdict{};
    std::uint64_t work = 0;
};

Counted counted(const OpenedScene& opened, const oracle::TargetImage& picture, const SearchLimits& limits = {}) {
    SceneFragments fragments = opened.fragments();
    Verdict verdict = judge(fragments, Colors{picture}, limits);
    return {std::move(verdict), fragments.setting().work->done()};
}

constexpr SearchLimits nothing{.mistakes = 0, .narrower = 0, .leads = 0, .of_fragment = 0};

// A port that truncates in blends: right, but with wide intervals.
Hypothesis port_that_cuts() {
    Hypothesis cuts = port_of_codes(Order::both_ends);
    cuts.front.rounding = cuts.back.rounding = Rounding::truncated;
    return cuts;
}

}  // namespace

TEST_CASE("a batch is completed and no further one is started after the limit is reached") {
    WorkCounter work;
    work.allow(100);
    std::atomic<int> begun = 0;
    const auto act = [&](std::size_t) {
        ++begun;
        Steps steps{work, 20};
        while (!steps.is_over()) steps.composite(1);
    };
    work.for_each(1000, act);
    const int once = begun;
    CHECK(once > 0);
    CHECK(once < 1000);
    CHECK(work.is_spent());
    CHECK(work.is_cut_short());
    work.for_each(1000, act);
    CHECK(begun == once);
}

TEST_CASE(
    "the search for one pixel of a float picture stays within the limit with the same count on any number of threads") {
    OpenedScene opened{"teapot", 24, 18};
    oracle::TargetImage picture = *opened.picture("front_to_back", pipeline::Format::rgba32f);
    std::uint32_t& red = picture.codes[std::size_t{4} * (9 * 24 + 12)];
    red = std::bit_cast<std::uint32_t>(std::bit_cast<float>(red) * 0.5f + 0.125f);
    const Counted one = counted(opened, picture);
    CHECK(one.verdict.right.wrong_pixels == std::vector<std::uint32_t>{9 * 24 + 12});
    CHECK_FALSE(one.verdict.is_right);
    CHECK_FALSE(one.verdict.is_stopped);
    CHECK(one.work < SearchLimits{}.mistakes / 2);
    opened.options.threads = 1;
    CHECK(counted(opened, picture).work == one.work);
}

TEST_CASE("a stopped search reports no mistake and says that it was stopped") {
    const OpenedScene opened{"showroom", 24, 24};
    const auto lose_second = [](PortList& l) {
        if (l.visible.size() > 1) l.visible.erase(l.visible.begin() + 1);
    };
    const oracle::TargetImage picture = picture_of_port(opened, port_of_codes(Order::under), lose_second);
    const Counted whole = counted(opened, picture), stopped = counted(opened, picture, nothing);
    CHECK_FALSE(whole.verdict.is_stopped);
    CHECK_FALSE(whole.verdict.explanations.empty());
    CHECK(stopped.verdict.is_stopped);
    CHECK(stopped.verdict.explanations.empty());
    CHECK_FALSE(stopped.verdict.is_right);
    CHECK_FALSE(stopped.verdict.is_undecided());
    CHECK(stopped.work < whole.work);
    CHECK(to_text(stopped.verdict, opened.scene.list).find("reached its limit") != std::string::npos);
}

TEST_CASE("a picture with wide intervals has no verdict if the search is stopped") {
    const OpenedScene opened{"hard:case=inside-out", 8, 8};
    const oracle::TargetImage picture = picture_of_port(opened, port_that_cuts(), {});
    // A port that cuts the blends of so many layers needs more codes than are called right.
    CHECK(counted(opened, picture).verdict.doubt.find("codes allowed, where a right port needs at most 5") !=
          std::string::npos);
    const Verdict stopped = counted(opened, picture, nothing).verdict;
    CHECK_FALSE(stopped.is_right);
    CHECK(stopped.is_undecided());
    CHECK(to_text(stopped, opened.scene.list).starts_with("not decided: "));
    CHECK(json_of(stopped, opened.scene.list)["verdict"] == "undecided");
}

TEST_CASE("a picture with intervals of two codes is not decided either if the search is stopped") {
    const OpenedScene opened{"random:seed=3,triangles=400", 32, 24};
    const oracle::TargetImage picture = *opened.picture("dual", pipeline::Format::rgba8);
    const Verdict whole = counted(opened, picture).verdict;
    CHECK(whole.is_right);
    CHECK_FALSE(whole.is_stopped);
    REQUIRE(whole.right.possible == 2);
    const Verdict stopped = counted(opened, picture, nothing).verdict;
    CHECK(stopped.is_stopped);
    CHECK_FALSE(stopped.is_right);
    CHECK(stopped.is_undecided());
}
