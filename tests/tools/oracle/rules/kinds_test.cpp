// Tests the search on one picture per kind of mistake, made with that mistake.
#include <catch2/catch.hpp>
#include <mutex>
#include <set>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/rules/structure.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

// The picture of an 8-bit port with these mistakes that blends front to back.
oracle::TargetImage picture_by(const SceneFragments& scene, const std::vector<Rule>& rules) {
    const int width = scene.width(), height = scene.height();
    oracle::TargetImage picture{
        .name = "color", .code = oracle::Code::unorm8, .width = width, .height = height, .channels = 3};
    picture.codes.resize(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const Compositor compositor{port_of_codes(Order::under)};
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        StackMaker maker{scene.setting()};
        const std::scoped_lock lock{mutex};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            const ReachableColor reach = compositor.reach(maker.with(rules, list, {}));
            const std::size_t first = std::size_t{3} * static_cast<std::size_t>(list.y * width + list.x);
            for (std::size_t c = 0; c < 3; ++c)
                picture.codes[first + c] = static_cast<std::uint32_t>(std::lround(reach[c].low * 255));
        }
    });
    return picture;
}

std::uint32_t farthest(const oracle::TargetImage& a, const oracle::TargetImage& b) {
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < a.codes.size(); ++i)
        most = std::max(most, std::max(a.codes[i], b.codes[i]) - std::min(a.codes[i], b.codes[i]));
    return most;
}

// The kinds for which only other kinds are reported, although these give other pictures.
std::vector<std::string> misnamed_in(const std::string& scene, int width, int height) {
    const OpenedScene opened{scene, width, height};
    const SceneFragments fragments = opened.fragments();
    const oracle::TargetImage right = picture_by(fragments, {});
    const Sample sample = sampled(fragments, Colors{right}, 2048);
    std::vector<std::string> misnamed;
    std::size_t named = 0;
    for (const Rule& rule : one_of_each_kind(facts_of(fragments, sample))) {
        const oracle::TargetImage picture = picture_by(fragments, {rule});
        if (farthest(picture, right) <= 1) continue;
        const Verdict verdict = judged(opened, picture);
        const auto has_kind = [&](const CheckedAccount& c) { return c.account.rules[0].kind == rule.kind; };
        const auto is_same = [&](const CheckedAccount& c) {
            return farthest(picture_by(fragments, c.account.rules), picture) <= 1;
        };
        named += std::ranges::any_of(verdict.explanations, has_kind) ? 1 : 0;
        if (std::ranges::any_of(verdict.explanations, has_kind) || std::ranges::all_of(verdict.explanations, is_same))
            continue;
        misnamed.emplace_back(name(rule.kind));
        for (const CheckedAccount& c : verdict.explanations)
            misnamed.back() += " " + std::string{name(c.account.rules[0].kind)};
    }
    CHECK(named > 50);
    return misnamed;
}

}  // namespace

TEST_CASE("rules that leave fewer layers than the right near half has are checked at every pixel") {
    const OpenedScene opened{"teapot", 48, 36};
    const SceneFragments fragments = opened.fragments();
    const std::vector<Rule> rules{{.kind = RuleKind::averaged, .n = 1}, {.kind = RuleKind::surface_lost}};
    const oracle::TargetImage picture = picture_by(fragments, rules);
    Sample examples{fragments.setting()};
    const Account account{rules, port_of_codes(Order::both_ends)};
    const CheckedAccount found = check_all(fragments, Colors{picture}, account, WrongPixels::some, examples);
    CHECK(found.is_whole());
    CHECK(found.changed == found.pixels);  // the background is behind all of them
}

TEST_CASE("no kind of mistake is reported for a picture that another kind made", "[exhaustive]") {
    CHECK(misnamed_in("showroom", 32, 32) == std::vector<std::string>{});
}
