// tools/oracle/judge/fitted.cpp - asks the three kinds of fits in their order, and makes their lines (fitted.h).
#include "tools/oracle/judge/fitted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/picture/picture.h"
#include "tools/oracle/program/drawing/fit_drawings.h"

namespace strata::oracle {

using State = program::Fitting::State;

double FittedPicture::cost() const { return screen.empty() ? fitting.found[0].cost : screen[0].cost(); }

std::vector<std::string> FittedPicture::mistakes() const {
    std::vector<std::string> all;
    for (const program::ScreenMap& map : screen) all.push_back(map.words);
    if (screen.empty())
        for (const program::Proof& proof : fitting.found) all.push_back(describe(proof.program));
    return all;
}

std::string FittedPicture::right_sentence(std::size_t pixels) const {
    const program::Fitness& right = fitting.right;
    const std::string how = describe(right.rounding);
    if (right.pixels == pixels)
        return fmt::format("right: equal to layers blended {} at all {} pixels, but for rounding", how, pixels);
    return fmt::format(
        "right: equal to layers blended {} at {} of {} pixels, but for rounding; {} at edges that another "
        "rasterizer may cover so",
        how, right.pixels, pixels, pixels - right.pixels);
}

std::vector<std::string> FittedPicture::leads() const {
    std::vector<std::string> all;
    if (fitting.state != State::explained_in_part) return all;
    for (const program::Proof& proof : fitting.found)
        all.push_back(fmt::format("{}: {} of {} pixels are wrong then", describe(proof.program), proof.fitness.beyond,
                                  proof.fitness.pixels));
    return all;
}

std::string FittedPicture::lines(std::size_t pixels) const {
    if (fitting.state == State::explained_in_part && screen.empty()) {
        std::string text;
        for (const std::string& lead : leads()) text += "  lead: " + lead + '\n';
        return text;
    }
    if (screen.empty()) {
        const std::string text = to_text(fitting);
        return text.substr(std::min(text.size(), text.find('\n') + 1));
    }
    std::string text;
    for (std::size_t i = 0; i < screen.size(); ++i) {
        if (i > 0) text += "  or: " + screen[i].words + '\n';
        text += fmt::format("    {} of {} pixels are wrong then\n", screen[i].beyond, pixels);
    }
    return text;
}

namespace {

FittedPicture fitted_in_its_format(const peeling::FrameRequest& input, const verdict::SceneFragments& fragments,
                                   const verdict::Colors& colors) {
    const program::Lists all = program::lists_of(fragments, colors, true);
    FittedPicture found{.fitting = {.right = program::best_fitness(all, {})}};
    if (program::is_plainly_right(found.fitting.right) && found.fitting.right.beyond == 0) {
        found.fitting.state = State::right;
        return found;
    }
    const program::Fitness right = found.fitting.right;
    found.fitting = fit_drawings(all, program::other_drawings(input, all, colors), &right);
    const bool is_pair = found.is_explained() && !found.fitting.found[0].program.edits.empty();
    if (found.is_explained() && !is_pair) return found;
    found.screen = explain_by_screen(all, found.fitting.right);
    if (!found.screen.empty()) return found;
    program::Fitting fitted = fit(program::lists_of(fragments, colors));
    if (!is_pair || fitted.state == State::explained) found.fitting = std::move(fitted);
    return found;
}

TargetImage in_8_bits(const verdict::Colors& colors) {
    TargetImage image{.name = "color", .width = colors.width(), .height = colors.height(), .channels = 3};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::array<double, 4> color = colors.at(x, y);
            for (std::size_t c = 0; c < 3; ++c)
                image.codes.push_back(static_cast<std::uint32_t>(std::clamp(color[c], 0.0, 1.0) * 255 + 0.5));
        }
    return image;
}

}  // namespace

FittedPicture fitted_picture(const peeling::FrameRequest& input, const verdict::SceneFragments& fragments,
                             const verdict::Colors& colors) {
    FittedPicture found = fitted_in_its_format(input, fragments, colors);
    const program::PortFormat format = found.fitting.right.rounding.result;
    const bool is_fine = format == program::PortFormat::exact || format == program::PortFormat::half;
    if (!is_fine || found.is_explained() || found.fitting.is_right()) return found;
    const TargetImage codes = in_8_bits(colors);
    FittedPicture coarse = fitted_in_its_format(input, fragments, verdict::Colors{codes});
    return coarse.is_explained() ? std::move(coarse) : std::move(found);
}

bool is_habit_of(const FittedPicture& seen, const verdict::SceneFragments& fragments, const verdict::Colors& own) {
    const program::Lists all = program::lists_of(fragments, own, true);
    const program::Fitting fitting = fit(all);
    if (!seen.screen.empty()) {
        const auto maps = explain_by_screen(all, fitting.right);
        return !maps.empty() && maps[0].words == seen.screen[0].words;
    }
    const auto entry_of = [](const program::Fitting& f) {
        return f.found.empty() || f.found[0].program.edits.empty() ? nullptr : f.found[0].program.edits[0].entry;
    };
    return entry_of(fitting) != nullptr && entry_of(fitting) == entry_of(seen.fitting);
}

}  // namespace strata::oracle
