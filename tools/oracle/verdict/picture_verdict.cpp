// tools/oracle/verdict/picture_verdict.cpp - decides the verdict on a picture: equal pictures, then structure and
// rounding, then other profiles and origins, then mistakes (picture_verdict.h).
#include "tools/oracle/verdict/picture_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "peeling/algorithms/algorithm.h"
#include "pipeline/device/profile.h"
#include "tools/oracle/fragments/near_depths.h"
#include "tools/oracle/rules/rules.h"
#include "tools/oracle/verdict/equal_picture.h"
#include "tools/oracle/verdict/exchanged_depths.h"
#include "tools/oracle/verdict/opposite_edges.h"
#include "tools/oracle/verdict/other_profile.h"
#include "tools/oracle/verdict/report.h"
#include "tools/oracle/verdict/shifted_edges.h"

namespace strata::oracle::verdict {

namespace {

using pipeline::DeviceProfile;

// The ways to read the numbers, the usual first.
std::vector<ColorStorage> readings(const PictureQuestion& question) {
    if (!question.is_frame_linear || !question.colors.holds_encoded) return {ColorStorage::as_they_are};
    return {ColorStorage::encoded, ColorStorage::srgb_target, ColorStorage::as_they_are};
}

std::string words_of(ColorStorage stored) {
    switch (stored) {
        case ColorStorage::as_they_are:
            return "  its numbers are linear light, as they are: a file for display has them encoded\n";
        case ColorStorage::srgb_target:
            return "  blended in an sRGB target: every blend is decoded, and encoded again\n";
        case ColorStorage::encoded: break;
    }
    return "";
}

std::string words_of(const ExchangedDepths& exchanged, const pipeline::DrawList& list) {
    const PairedSurface &nearer = exchanged.nearer, &farther = exchanged.farther;
    const std::string name = instance_name(nearer.instance, list);
    if (nearer.instance != farther.instance)
        return fmt::format("{} lies behind {}", name, instance_name(farther.instance, list));
    if (nearer.is_front_facing != farther.is_front_facing)
        return fmt::format("{} faces of {} lie behind the others", nearer.is_front_facing ? "front" : "back", name);
    return fmt::format("triangles of {} lie behind those that are submitted {}", name,
                       nearer.is_later ? "earlier" : "later");
}

class PictureJudge {
  public:
    PictureJudge(const peeling::FrameRequest& input, const PictureQuestion& question)
        : input_{input}, question_{question} {
        result_.fragments = std::make_unique<SceneFragments>(input, input.options.fragment_memory);
        scene().setting().work->show_by(question.progress);
        scene().set_stored(readings(question)[0]);
        result_.formed = formed(scene(), question.colors, question.is_form_stated);
        result_.formed.use.has_alpha = question.has_alpha;
        result_.reading = result_.formed.description();
    }

    [[nodiscard]] PictureVerdict decide() && {
        auto quick = judge_quickly(scene(), seen());
        if (quick && quick->state() == State::right) return with(*std::move(quick));
        if (const std::string name = equal_algorithm(input_, question_, fullest(scene())); !name.empty())
            return with(equal_to(name));
        if (auto right = by_another_reading()) return with(*std::move(right));
        result_.found = quick ? *std::move(quick) : judge_at_length(scene(), seen());
        scene().setting().work->begin_stage(0.9, 1);
        ask_profiles();
        hold_to_algorithm();
        find_shifted_edges();
        find_exchanged_depths();
        doubt_many_edges();
        doubt_opposite_edges();
        return std::move(result_);
    }

  private:
    [[nodiscard]] SceneFragments& scene() const { return *result_.fragments; }
    [[nodiscard]] Colors seen() const { return result_.formed.colors(); }
    [[nodiscard]] PictureVerdict with(Verdict&& verdict) {
        result_.found = std::move(verdict);
        return std::move(result_);
    }

    [[nodiscard]] Verdict equal_to(const std::string& name) const {
        Verdict verdict{.is_right = true, .width = scene().width(), .equal_to = name};
        verdict.right.pixels = question_.colors.pixels();
        verdict.alpha.state =
            question_.has_alpha && question_.colors.channels == 4 ? AlphaState::right : AlphaState::absent;
        return verdict;
    }

    [[nodiscard]] std::optional<Verdict> by_another_reading() {
        const std::vector<ColorStorage> all = readings(question_);
        for (std::size_t i = 1; i < all.size(); ++i) {
            scene().set_stored(all[i]);
            auto right = right_narrowly(scene(), seen());
            if (!right || !right->is_right) continue;
            result_.reading += words_of(all[i]);
            return right;
        }
        scene().set_stored(all[0]);
        return std::nullopt;
    }

    // Another profile's rules explain a wrong picture, or the edges of one that is right but for them.
    void ask_profiles() {
        Verdict& found = result_.found;
        const bool is_wrong = found.state() == State::wrong && found.alpha.state != AlphaState::wrong;
        const bool is_excused = found.right.rasterized_otherwise() > 0 && found.state() != State::wrong;
        if (!is_wrong && !is_excused) return;
        std::vector<std::uint32_t> wrong = found.right.wrong_pixels;
        auto other = right_by_other_profile(input_, seen(), wrong, question_.more);
        if (!other || (is_excused && other->verdict.right.rasterized_otherwise() > 0)) return;
        result_.reading +=
            other->description(input_.profile.name, is_wrong ? wrong.size() : found.right.rasterized_otherwise());
        found = std::move(other->verdict);
        result_.other_profile = std::move(other->profile);
        result_.fragments = std::move(other->fragments);
    }

    // An algorithm that keeps all fragments of one depth must not lose any.
    void hold_to_algorithm() {
        Verdict& found = result_.found;
        if (!found.is_right || found.right.lost_at_ties == 0 || question_.algorithm == nullptr) return;
        const auto ties = question_.algorithm->ties;
        if (ties != peeling::TiePolicy::first && ties != peeling::TiePolicy::last &&
            ties != peeling::TiePolicy::first_then_last)
            return;
        found.is_right = false;
        found.finding =
            fmt::format("fragments of one depth are lost or merged at {} of {} pixels, and {} keeps all of them",
                        found.right.lost_at_ties, found.right.pixels, question_.algorithm->name);
    }

    // Another rasterizer's snapping moves edges in all directions.
    void find_shifted_edges() {
        Verdict& found = result_.found;
        constexpr std::uint64_t few = 10;
        if (!found.is_right || found.right.at_edges < std::max(few, found.right.edges / 100)) return;
        const std::string_view direction = direction_of_edges(scene(), seen(), found.right);
        if (direction.empty()) return;
        found.is_right = false;
        found.finding = fmt::format(
            "{} of {} pixels at edges are covered as if everything were moved {} by a fraction of "
            "a pixel",
            found.right.at_edges, found.right.edges, direction);
    }

    // Depths of another precision exchange close layers in both directions.
    void find_exchanged_depths() {
        Verdict& found = result_.found;
        constexpr std::uint64_t few = 10;
        if (!found.is_right || found.right.rasterized_otherwise() < few) return;
        const auto exchanged = exchanged_depths(scene(), seen(), found.right);
        if (!exchanged) return;
        found.is_right = false;
        found.finding = fmt::format(
            "layers at most {} codes of depth apart are exchanged {} times, all in one direction, as by a depth bias: "
            "{}",
            close_codes, exchanged->pairs, words_of(*exchanged, input_.list));
    }

    void doubt_many_edges() {
        Verdict& found = result_.found;
        if (!found.is_right || !found.right.excuses_many_edges()) return;
        found.is_right = false;
        found.doubt = fmt::format(
            "{} of {} pixels at edges are excused, where another rasterizer's snapping moves few: "
            "another view or position?",
            found.right.at_edges, found.right.edges);
    }

    // Pixels that another rasterizer would excuse whatever the direction of their error are no evidence of one.
    void doubt_opposite_edges() {
        Verdict& found = result_.found;
        if (!found.is_right || found.right.at_edges == 0) return;
        const ExcusedEdges excused = excused_edges(scene(), seen(), found.right);
        if (!excused.show_no_coverage()) return;
        found.is_right = false;
        found.doubt = fmt::format(
            "{} of the {} pixels that are excused at edges would be excused if they were off in the opposite "
            "direction: they show no other coverage",
            excused.either_way, excused.all);
    }

    const peeling::FrameRequest& input_;
    const PictureQuestion& question_;
    PictureVerdict result_{};
};

}  // namespace

PictureVerdict judge_picture(const peeling::FrameRequest& input, const PictureQuestion& question) {
    PictureVerdict verdict = PictureJudge{input, question}.decide();
    verdict.fragments->setting().work->show_by({});  // they outlive the question
    return verdict;
}

std::string to_text(const PictureVerdict& verdict, const pipeline::DrawList& list) {
    return to_text(verdict.found, list) + verdict.reading;
}

nlohmann::ordered_json json_of(const PictureVerdict& verdict, const pipeline::DrawList& list,
                               const std::string& given_profile) {
    nlohmann::ordered_json document = json_of(verdict.found, list);
    if (verdict.formed.is_chosen) document["colors"] = verdict.formed.use.is_divided ? "straight" : "premultiplied";
    document["profile"] = verdict.other_profile ? verdict.other_profile->name : given_profile;
    return document;
}

}  // namespace strata::oracle::verdict
