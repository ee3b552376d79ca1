// tools/oracle/judge/emulated.cpp - finds the emulation that gives a picture, by a square of it first (emulated.h).
#include "tools/oracle/judge/emulated.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "peeling/render.h"
#include "pipeline/device/profile.h"
#include "tools/oracle/diagnosis/diagnosis_report.h"
#include "tools/oracle/diagnosis/evidence.h"
#include "tools/oracle/emulations/allowed_options.h"
#include "tools/oracle/picture/stored_like.h"
#include "tools/oracle/verdict/other_rules.h"

namespace strata::oracle {

namespace {

TargetImage cut(const TargetImage& target, const rasterizer::Rect& part) {
    TargetImage some = target;
    some.width = part.x1 - part.x0;
    some.height = part.y1 - part.y0;
    some.codes.clear();
    const auto channels = static_cast<std::ptrdiff_t>(target.channels);
    for (std::ptrdiff_t y = part.y0; y < part.y1; ++y) {
        const auto row = target.codes.begin() + y * target.width * channels;
        some.codes.insert(some.codes.end(), row + part.x0 * channels, row + part.x1 * channels);
    }
    return some;
}

Picture cut(const Picture& picture, const rasterizer::Rect& part) {
    Picture some{.file = picture.file, .targets = {}};
    for (const TargetImage& target : picture.targets) some.targets.push_back(cut(target, part));
    return some;
}

bool is_seen(const Picture& picture, const Picture& candidate, pipeline::ColorSpace space, const AskedPicture& asked) {
    return std::ranges::all_of(agreement(stored_like(picture, candidate, space), candidate, asked.tolerances),
                               std::identity{});
}

class EmulationSearch {
  public:
    EmulationSearch(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, const AskedPicture& asked,
                    const rasterizer::Rect& part)
        : algorithm_{algorithm},
          asked_{asked},
          space_{input.space},
          part_{rasterizer::intersection(part, {0, 0, input.options.width, input.options.height})},
          some_{cut(asked.candidate, part_)},
          whole_{input, algorithm, has_depth(asked.candidate) ? Depths::made : Depths::left_out, asked.limit},
          square_{whole_.within(part_)} {}

    [[nodiscard]] Emulated found() const {
        if (is_seen(whole_.right(), asked_.candidate)) return {.kind = Emulated::Kind::right};
        if (whole_.right_run().passes > most_passes_of_emulations) return {};
        const std::vector<Mistake> options = allowed_options(algorithm_, whole_.right_run(), asked_.more);
        for (const std::span<const Mistake> all : {std::span<const Mistake>{options}, catalogue()})
            if (Emulated one = among(all); one.kind != Emulated::Kind::none) return one;
        return {};
    }

  private:
    [[nodiscard]] bool is_seen(const Picture& picture, const Picture& candidate) const {
        return oracle::is_seen(picture, candidate, space_, asked_);
    }

    [[nodiscard]] bool may_be(const Mistake& mistake) const {
        if (mistake.part == ChangedPart::picture) return is_seen(cut(changed(whole_.right(), mistake), part_), some_);
        const std::optional<Picture> picture = square_.with(mistake);
        return picture && is_seen(cut(*picture, part_), some_);
    }

    [[nodiscard]] Emulated among(std::span<const Mistake> all) const {
        std::vector<char> may(all.size(), 0);
        for_all(all.size(), {}, [&](std::size_t i) { may[i] = may_be(all[i]) ? 1 : 0; });
        Emulated one;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (may[i] == 0) continue;
            const std::optional<Picture> picture = whole_.with(all[i]);
            if (!picture || !is_seen(*picture, asked_.candidate)) continue;
            std::string words = description_of({&all[i]});
            if (one.kind != Emulated::Kind::none)
                one.alike.push_back(std::move(words));
            else
                one = {.kind = all[i].is_allowed ? Emulated::Kind::other_options : Emulated::Kind::mistakes,
                       .is_single = true,
                       .words = std::move(words)};
        }
        return one;
    }

    const peeling::Algorithm& algorithm_;
    const AskedPicture& asked_;
    pipeline::ColorSpace space_;
    rasterizer::Rect part_;
    Picture some_;
    MistakeRenderer whole_, square_;
};

}  // namespace

Emulated emulated_of(const Diagnosis& d) {
    const Finding& best = d.findings.front();
    if ((best.agreeing != d.pixels && !d.is_nearly) || d.passes_contradict) return {};
    Emulated found{.kind = best.mistakes.empty()                                      ? Emulated::Kind::right
                           : std::ranges::all_of(best.mistakes, &Mistake::is_allowed) ? Emulated::Kind::other_options
                                                                                      : Emulated::Kind::mistakes,
                   .is_exact = !d.is_nearly,
                   .is_single = best.mistakes.size() == 1,
                   .words = description_of(best.mistakes)};
    for (const Mistake* mistake : best.alike) found.alike.push_back(description_of({mistake}));
    return found;
}

Emulated emulated_alone(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                        const AskedPicture& asked, const rasterizer::Rect& part) {
    return EmulationSearch{input, algorithm, asked, part}.found();
}

std::string sentence_of(const Emulated& emulated, const peeling::Algorithm& algorithm, std::size_t pixels) {
    if (emulated.kind == Emulated::Kind::right)
        return fmt::format("right: equal to the picture of {} at all {} pixels", algorithm.name, pixels);
    return fmt::format("{}: every pixel is{} that of: {}",
                       emulated.kind == Emulated::Kind::other_options ? "right under other options" : "wrong",
                       emulated.is_exact ? "" : ", within one code,", emulated.words);
}

std::optional<std::string> right_but_for_rounding(const TargetImage& own, const TargetImage& candidate,
                                                  pipeline::ColorSpace space, const peeling::Algorithm& algorithm) {
    const std::size_t pixels = candidate.pixels();
    if (const auto floats = rounded_otherwise(own, candidate, space))
        return fmt::format("right but for rounding: the picture of {}; {} of {} pixels differ, by at most {:.1g}",
                           algorithm.name, floats->pixels, pixels, floats->greatest);
    const auto at_ties = differing_at_ties(own, candidate, space);
    if (!at_ties) return std::nullopt;
    if (*at_ties == 0) return sentence_of({.kind = Emulated::Kind::right}, algorithm, pixels);
    return fmt::format(
        "right but for rounding: the picture of {}; {} of {} pixels have the other of the two codes in whose middle a "
        "value "
        "lies",
        algorithm.name, *at_ties, pixels);
}

std::optional<Picture> own_picture(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm) {
    peeling::RenderOptions options = input.options;
    options.audit = options.keep_layers = false;
    const auto run = peeling::Renderer{input.list, input.view, input.profile, options}.render(algorithm);
    if (run.outcome == peeling::Outcome::refused) return std::nullopt;
    Picture own{.file = "", .targets = {as_target(run.frame.color, "color")}};
    own.targets[0].alpha_form = AlphaForm::premultiplied;
    return own;
}

bool is_picture_of(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, const AskedPicture& asked,
                   const rasterizer::Rect& part) {
    const Picture colors{.file = asked.candidate.file, .targets = {colors_of(asked.candidate)}};
    if (colors.targets[0].pixels() > most_pixels_of_emulations) return false;
    const auto square = rasterizer::intersection(part, {0, 0, input.options.width, input.options.height});
    for (const bool is_whole : {false, true}) {
        peeling::RenderOptions options = input.options;
        if (!is_whole) options = verdict::scissored(options, square);
        if (options.max_passes == 0) options.max_passes = most_passes_of_emulations;
        const auto own = own_picture(input.with(options), algorithm);
        if (!own) return false;
        const Picture& seen = is_whole ? colors : cut(colors, square);
        if (!is_seen(is_whole ? *own : cut(*own, square), seen, input.space, asked)) return false;
    }
    return true;
}

}  // namespace strata::oracle
