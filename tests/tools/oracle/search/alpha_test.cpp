// Expected values: alphas of the renderer's own pictures are right by definition (background_alpha_test proves them);
// wrong ones are worked out here, from the layers' alphas in binary64.
#include "tools/oracle/search/alpha.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/fragments/form.h"
#include "tools/oracle/search/match.h"
#include "tools/oracle/verdict/report.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

OpenedScene over_alpha(float alpha) {
    OpenedScene opened{"showroom", 24, 24};
    opened.options.background = {0.2f * alpha, 0.3f * alpha, 0.5f * alpha, alpha};
    return opened;
}

// The scene's right picture by 8-bit codes, with this alpha for what a pixel's layers let through, its layers' alphas
// from the far end, and the alpha of what lies behind.
using AlphaOf = std::function<double(double through, const std::vector<double>& far_to_near, double behind)>;
oracle::TargetImage picture_with(const OpenedScene& opened, const AlphaOf& alpha) {
    std::vector<double> alphas;
    const auto note = [&](PortList& list) {
        double through = 1;
        std::vector<double> far_to_near;
        for (const pipeline::CapturedFragment& f : list.visible) {
            through *= 1 - double{f.color[3]};
            far_to_near.insert(far_to_near.begin(), double{f.color[3]});
        }
        alphas.push_back(alpha(through, far_to_near, list.has_opaque ? 1 : double{list.background[3]}));
    };
    oracle::TargetImage picture = picture_of_port(opened, port_of_codes(Order::over), note);
    for (std::size_t i = 0; i < alphas.size(); ++i)
        picture.codes[4 * i + 3] = static_cast<std::uint32_t>(std::lround(alphas[i] * 255));
    return picture;
}

double right_alpha(double through, const std::vector<double>&, double behind) { return 1 - through * (1 - behind); }

// Blended by SRC_ALPHA and ONE_MINUS_SRC_ALPHA.
double weighted_alpha(double, const std::vector<double>& far_to_near, double behind) {
    double alpha = behind;
    for (const double a : far_to_near) alpha = a * a + (1 - a) * alpha;
    return alpha;
}

}  // namespace

TEST_CASE("the alpha of every exact algorithm over a transparent background is right in every format") {
    constexpr pipeline::Format formats[] = {pipeline::Format::rgba8, pipeline::Format::rgba16f,
                                            pipeline::Format::rgba32f};
    std::vector<std::string> wrong;
    for (const float alpha : {0.0f, 0.4f}) {
        const OpenedScene opened = over_alpha(alpha);
        SceneFragments fragments = opened.fragments();
        for (const peeling::Algorithm& algorithm : peeling::algorithms())
            for (const pipeline::Format format : formats) {
                const auto picture = algorithm.exact ? opened.picture(algorithm.name, format) : std::nullopt;
                if (!picture) continue;
                const Colors colors{*picture};
                const Families all = families(storage_of(colors.code()), {0, 0x1p-20}, Looseness::definite);
                Sample sample = sampled(fragments, colors, 512);
                const auto account = account_for(all, {}, fragments, colors, sample);
                if (!account || check_alpha(fragments, colors, account->account.hypothesis).state != AlphaState::right)
                    wrong.push_back(algorithm.name + " in " + std::string{pipeline::info(format).name});
            }
    }
    CHECK(wrong == std::vector<std::string>{});
}

TEST_CASE("one alpha that no rounding leaves is wrong at its pixel, though all colours are right") {
    const OpenedScene opened = over_alpha(0);
    oracle::TargetImage picture = picture_with(opened, right_alpha);
    const Verdict right = judged(opened, picture);
    CHECK(right.is_right);
    CHECK(right.alpha.state == AlphaState::right);
    CHECK(to_text(right, opened.scene.list).find("\n  alpha is right at all pixels\n") != std::string::npos);
    const std::size_t pixel = 12 * 24 + 12;
    std::uint32_t& alpha = picture.codes[4 * pixel + 3];
    alpha = alpha > 127 ? alpha - 9 : alpha + 9;
    const Verdict wrong = judged(opened, picture);
    CHECK_FALSE(wrong.is_right);
    CHECK_FALSE(wrong.is_undecided());
    CHECK(wrong.right.is_whole());
    CHECK(wrong.alpha.wrong_pixels == std::vector<std::uint32_t>{pixel});
    CHECK(wrong.alpha.mistake == AlphaMistake::unknown);
    CHECK(to_text(wrong, opened.scene.list)
              .starts_with("wrong: alpha is wrong at 1 of 576 pixels; the colours are right\n"));
}

TEST_CASE("alpha that a port blends or keeps by a known mistake is named") {
    struct Port {
        AlphaMistake wanted;
        float background;  // of the scene
        AlphaOf alpha;
    };
    const Port ports[] = {
        {AlphaMistake::weighted_by_itself, 0, weighted_alpha},
        {AlphaMistake::weighted_by_itself, 1, weighted_alpha},
        {AlphaMistake::inverted, 0, [](double t, const auto&, double behind) { return t * (1 - behind); }},
        {AlphaMistake::unwritten, 0, [](double, const auto&, double) { return 0.0; }},
        {AlphaMistake::other_background, 0,
         [](double t, const auto&, double behind) { return behind == 1 ? 1 : 1 - t * 0.5; }},
    };
    for (const Port& port : ports) {
        const OpenedScene opened = over_alpha(port.background);
        const Verdict found = judged(opened, picture_with(opened, port.alpha));
        INFO(name(port.wanted) << " over " << port.background);
        CHECK_FALSE(found.is_right);
        CHECK(found.right.is_whole());
        CHECK(name(found.alpha.mistake) == name(port.wanted));
        if (port.wanted == AlphaMistake::other_background) CHECK(found.alpha.background == Approx(0.5).margin(0.002));
    }
}

TEST_CASE("a picture whose alpha is 1 everywhere has none to compare and is not called wrong") {
    const OpenedScene opened = over_alpha(0);
    const Verdict found = judged(opened, picture_with(opened, [](double, const auto&, double) { return 1.0; }));
    CHECK(found.is_right);
    CHECK(found.alpha.state == AlphaState::opaque);
    CHECK(describe(found.alpha) == "alpha is 1 everywhere, as on an opaque canvas: there is none to compare");
    // Over an opaque background that is right, and nothing has to be said.
    const OpenedScene opaque = over_alpha(1);
    const Verdict right = judged(opaque, picture_with(opaque, right_alpha));
    CHECK(right.alpha.state == AlphaState::right);
    CHECK(describe(right.alpha).empty());
}

namespace {

// What a file of straight colours holds of premultiplied codes.
oracle::TargetImage straight(oracle::TargetImage picture) {
    for (std::size_t i = 0; i < picture.codes.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t alpha = picture.codes[i + 3];
            if (alpha > 0) picture.codes[i + c] = (picture.codes[i + c] * 255 + alpha / 2) / alpha;
        }
    picture.alpha_form = oracle::AlphaForm::straight;
    return picture;
}

}  // namespace

TEST_CASE("a picture over a transparent background is right with straight colours and with premultiplied ones") {
    const OpenedScene opened = over_alpha(0);
    const oracle::TargetImage premultiplied = picture_with(opened, right_alpha);
    oracle::TargetImage stored = premultiplied;  // as it is, in a file of straight colours
    stored.alpha_form = oracle::AlphaForm::straight;
    SceneFragments fragments = opened.fragments();
    for (const bool is_straight : {true, false}) {
        const Formed f = formed(fragments, is_straight ? straight(premultiplied) : stored, false);
        CHECK(f.is_chosen);
        CHECK(f.use.is_divided == is_straight);
        CHECK(judge(fragments, f.colors()).is_right);
    }
    // What an option states is not tried.
    CHECK(formed(fragments, stored, true).use.is_divided);
}

TEST_CASE("straight colours that a shader divides are right though they pass through two roundings") {
    OpenedScene opened = over_alpha(0.4f);
    const oracle::TargetImage floats = *opened.picture("a_buffer", pipeline::Format::rgba32f);
    oracle::TargetImage picture = floats;
    picture.code = oracle::Code::unorm8;
    picture.alpha_form = oracle::AlphaForm::straight;
    for (std::size_t pixel = 0; pixel < floats.pixels(); ++pixel) {
        const double alpha = floats.value_at(pixel, 3);
        for (int c = 0; c < 4; ++c)
            picture.codes[4 * pixel + static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(
                std::lround(std::min(1.0, floats.value_at(pixel, c) / (c < 3 ? alpha : 1)) * 255));
    }
    SceneFragments fragments = opened.fragments();
    const Formed f = formed(fragments, picture, false);
    CHECK(f.use.is_divided);
    const Verdict found = judge(fragments, f.colors());
    CHECK(found.is_right);
    CHECK(found.alpha.state == AlphaState::right);
}
