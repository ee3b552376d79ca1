#include "tools/strata/compare/tolerances.h"

#include <algorithm>

#include "tools/strata/options/option.h"

namespace strata::tools {

namespace {

// Parses "30" or "0.02%" of all pixels.
std::optional<oracle::PixelBudget> to_budget(std::string_view text) {
    if (!text.ends_with('%')) {
        const auto pixels = to_int<std::uint64_t>(text);
        return pixels ? std::optional(oracle::PixelBudget{.pixels = *pixels}) : std::nullopt;
    }
    const auto percent = to_number<double>(text.substr(0, text.size() - 1));
    if (!percent || *percent < 0 || *percent > 100) return std::nullopt;
    return oracle::PixelBudget{.share = *percent / 100};
}

bool take_tolerance(std::string_view kind, std::string_view amount, oracle::Tolerances& tolerances) {
    using oracle::Tolerances;
    for (const auto& [name, codes] :
         {std::pair{"color", &Tolerances::color_codes}, std::pair{"depth", &Tolerances::depth_codes}})
        if (kind == name) {
            const auto found = to_int<std::uint32_t>(amount);
            tolerances.*codes = found.value_or(0);
            return found.has_value();
        }
    for (const auto& [name, budget] :
         {std::pair{"coverage", &Tolerances::coverage}, std::pair{"background", &Tolerances::background},
          std::pair{"layers", &Tolerances::layers}, std::pair{"unseen", &Tolerances::unseen},
          std::pair{"depth-pixels", &Tolerances::depth}, std::pair{"color-pixels", &Tolerances::color},
          std::pair{"pixels", &Tolerances::pixels}, std::pair{"not-finite", &Tolerances::not_finite}})
        if (kind == name) {
            const auto found = to_budget(amount);
            tolerances.*budget = found.value_or(oracle::PixelBudget{});
            return found.has_value();
        }
    const auto codes = to_int<std::uint32_t>(amount);
    if (codes) tolerances.target_codes[std::string{kind}] = *codes;
    return codes.has_value();
}

// Parses "color=1,depth=2,coverage=10,pixels=0.02%".
std::optional<oracle::Tolerances> to_tolerances(std::string_view text) {
    oracle::Tolerances tolerances;
    for (const std::string& part : split(text, ',')) {
        const std::size_t is = part.find('=');
        if (is == std::string::npos ||
            !take_tolerance(std::string_view(part).substr(0, is), std::string_view(part).substr(is + 1), tolerances))
            return std::nullopt;
    }
    return tolerances;
}

std::optional<std::optional<oracle::RawLayout>> to_layout(std::string_view text) {
    const auto found = oracle::raw_layout(text);
    if (!found) return std::nullopt;
    return found;
}

}  // namespace

void check_targets(const oracle::Tolerances& tolerances, const std::vector<std::string>& targets) {
    for (const auto& [name, codes] : tolerances.target_codes) {
        if (std::ranges::find(targets, name) != targets.end()) continue;
        std::vector<std::string> known{"color",        "depth",        "coverage", "background", "layers",
                                       "depth-pixels", "color-pixels", "unseen",   "pixels",     "not-finite"};
        std::ranges::copy_if(targets, std::back_inserter(known), [&](const std::string& target) {
            return std::ranges::find(known, target) == known.end();
        });
        throw CLI::ValidationError("--tolerance",
                                   "expected " + one_of(known) + ", found " + found_but_near(name, known));
    }
}

void add_layout_option(CLI::App& app, std::optional<oracle::RawLayout>& layout) {
    add_option(app, layout,
               {"--layout", "WIDTHxHEIGHT:FORMAT[:WORD...]",
                "of files of bare little-endian numbers: rgba8, bgra8, rgb10a2, rgba16f, d24, d24s8 and the like, and "
                ":bottom-up, "
                ":offset=BYTES, :stride=BYTES",
                oracle::raw_layout_expected},
               to_layout);
}

void add_candidate_layout_option(CLI::App& app, std::optional<oracle::RawLayout>& layout) {
    add_option(app, layout,
               {"--candidate-layout", "WIDTHxHEIGHT:FORMAT[:WORD...]",
                "of the candidate's file of bare numbers, if it is not that of --layout", oracle::raw_layout_expected},
               to_layout);
}

void add_alpha_option(CLI::App& app, std::optional<oracle::AlphaForm>& form) {
    static const std::vector<Choice<oracle::AlphaForm>> choices{{"straight", oracle::AlphaForm::straight},
                                                                {"premultiplied", oracle::AlphaForm::premultiplied}};
    add_choice(app, form, "--candidate-alpha", choices,
               "whether the candidate's colours are times alpha (default: those of PNG, TGA, BMP and TIFF are "
               "straight, of EXR "
               "premultiplied, of bare numbers as the reference's)");
}

void state_alpha(oracle::Picture& picture, const std::optional<oracle::AlphaForm>& form) {
    if (!form) return;
    for (oracle::TargetImage& target : picture.targets)
        if (target.meaning == oracle::Meaning::color) target.alpha_form = *form;
}

void add_channels_option(CLI::App& app, oracle::Tolerances& tolerances) {
    static const std::vector<Choice<oracle::ColorChannels>> choices{{"rgba", oracle::ColorChannels::all},
                                                                    {"rgb", oracle::ColorChannels::rgb}};
    add_choice(app, tolerances.channels, "--channels", choices,
               "which channels of colours count; rgb leaves alpha out (default rgba)");
}

void add_tolerance_option(CLI::App& app, oracle::Tolerances& tolerances) {
    add_option(
        app, tolerances,
        {"--tolerance", "KIND=N[,KIND=N...]",
         "forgive colours and depths N codes apart (color, depth, or a target by its name), and pixels that differ all "
         "the same, N or N% of them, by what they differ in (coverage, background, layers, depth-pixels, color-pixels, "
         "unseen: colours where alpha is 0 in both) or in whatever "
         "(pixels); NaN and infinity only by not-finite=N; nothing without this option; with a scene: compare code by "
         "code with its own picture, without the verdict that knows what rounding explains",
         "color=N, depth=N, TARGET=N, coverage=N, background=N, layers=N, depth-pixels=N, color-pixels=N, "
         "unseen=N, not-finite=N and pixels=N with commas between, pixels also as a share such as 0.02%"},
        [&tolerances](std::string_view text) {
            auto found = to_tolerances(text);
            if (found) found->channels = tolerances.channels;  // --channels is a separate option
            return found;
        });
}

}  // namespace strata::tools
