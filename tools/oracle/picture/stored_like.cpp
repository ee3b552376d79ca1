#include "tools/oracle/picture/stored_like.h"

#include <algorithm>
#include <cmath>

#include "pipeline/formats/srgb.h"
#include "pipeline/formats/unorm8.h"
#include "rasterizer/base/float_environment.h"
#include "scenes/numbers/srgb_encode.h"

namespace strata::oracle {

using pipeline::ColorSpace;

namespace {

std::uint32_t stored(Code code, float value, ColorSpace space) {
    if (code != Code::unorm8) return nearest(code, space == ColorSpace::linear ? scenes::encode_srgb(value) : value);
    return space == ColorSpace::linear ? scenes::encode_srgb8(value) : pipeline::to_unorm8(value);
}

// The colours of an srgb8_alpha8 target are decoded, and encoded again after a division by alpha.
[[nodiscard]] bool is_encoded_target(const TargetImage& rendered) {
    return rendered.holds_encoded && rendered.code == Code::unorm8;
}

// A float file holds the decoded colours of such a target, as the program's EXR does.
[[nodiscard]] bool is_in_light(const TargetImage& rendered, const TargetImage& file) {
    return is_encoded_target(rendered) && (file.code == Code::half || file.code == Code::single);
}

[[nodiscard]] bool is_converted(const TargetImage& rendered, const TargetImage& file, ColorSpace space) {
    const bool is_same = space == ColorSpace::encoded && rendered.code == Code::unorm8 && !is_encoded_target(rendered);
    return (file.holds_encoded || is_in_light(rendered, file)) && !is_same && rendered.meaning == Meaning::color &&
           rendered.channels == 4;
}

[[nodiscard]] bool is_divided(const TargetImage& rendered, const TargetImage& file) {
    const bool has_alpha = file.channels == 2 || file.channels == 4;
    return has_alpha && file.alpha_form == AlphaForm::straight && rendered.alpha_form == AlphaForm::premultiplied;
}

// The space of a channel that the file encodes.
[[nodiscard]] ColorSpace space_of(const TargetImage& rendered, const TargetImage& file, int c, ColorSpace space) {
    if (c == 3 || is_in_light(rendered, file)) return ColorSpace::encoded;
    return is_encoded_target(rendered) ? ColorSpace::linear : space;
}

// A channel of a pixel, divided by alpha if the file's colours are.
[[nodiscard]] float value_for(const TargetImage& rendered, const TargetImage& file, std::size_t pixel, int c) {
    const float value = is_encoded_target(rendered) && c < 3
                            ? pipeline::srgb_to_linear[rendered.at(pixel, c).word & 0xffu]
                            : static_cast<float>(rendered.value_at(pixel, c));
    if (c == 3 || !is_divided(rendered, file)) return value;
    const auto alpha = static_cast<float>(rendered.value_at(pixel, 3));
    return alpha > 0 ? value / alpha : 0.0f;
}

// True if the middle between the codes a and b, which are neighbours, is within two ulps of 1.0 of the value.
[[nodiscard]] bool is_at_tie(std::uint32_t a, std::uint32_t b, double value, Code code) {
    const double greatest = code == Code::unorm8 ? 255 : 65535;
    const double middle = (static_cast<double>(a) + static_cast<double>(b)) / 2;
    return (a + 1 == b || b + 1 == a) && std::fabs(value * greatest - middle) <= greatest * 0x1p-22;
}

}  // namespace

std::optional<TargetImage> stored_like(const TargetImage& rendered, const TargetImage& file, ColorSpace space) {
    if (!is_converted(rendered, file, space)) return std::nullopt;
    const FloatEnvironment environment;
    TargetImage made = rendered;
    made.code = file.code;
    made.alpha_form = is_divided(rendered, file) ? AlphaForm::straight : rendered.alpha_form;
    for (std::size_t pixel = 0; pixel < made.pixels(); ++pixel)
        for (int c = 0; c < 4; ++c)
            made.codes[pixel * 4 + static_cast<std::size_t>(c)] =
                stored(file.code, value_for(rendered, file, pixel, c), space_of(rendered, file, c, space));
    return made;
}

std::optional<std::size_t> differing_at_ties(const TargetImage& rendered, const TargetImage& file, ColorSpace space) {
    const std::optional<TargetImage> made = stored_like(rendered, file, space);
    if (!made || file.is_grey || (file.code != Code::unorm8 && file.code != Code::unorm16)) return std::nullopt;
    const FloatEnvironment environment;
    std::size_t pixels = 0;
    for (std::size_t pixel = 0; pixel < made->pixels(); ++pixel) {
        bool differs = false;
        for (int c = 0; c < file.channels; ++c) {
            const std::uint32_t own = made->at(pixel, c).word, seen = file.at(pixel, c).word;
            if (own == seen) continue;
            const float value = value_for(rendered, file, pixel, c);
            const bool is_encoded = space_of(rendered, file, c, space) == ColorSpace::linear;
            if (!is_at_tie(own, seen, double{is_encoded ? scenes::encode_srgb(value) : value}, file.code))
                return std::nullopt;
            differs = true;
        }
        pixels += differs ? 1 : 0;
    }
    return pixels;
}

std::optional<RoundedOtherwise> rounded_otherwise(const TargetImage& rendered, const TargetImage& file,
                                                  ColorSpace space) {
    if (rendered.code != Code::single || file.code != Code::single || file.is_grey) return std::nullopt;
    const std::optional<TargetImage> made = stored_like(rendered, file, space);
    const TargetImage& own = made ? *made : rendered;
    constexpr double most = 0x1p-20;
    RoundedOtherwise found;
    for (std::size_t pixel = 0; pixel < own.pixels(); ++pixel) {
        double worst = 0;
        for (int c = 0; c < std::min(file.channels, own.channels); ++c) {
            const double value = own.value_at(pixel, c), differs = std::fabs(value - file.value_at(pixel, c));
            if (!(differs <= most * std::max(1.0, std::fabs(value)))) return std::nullopt;
            worst = std::max(worst, differs);
        }
        found.pixels += worst > 0 ? 1 : 0;
        found.greatest = std::max(found.greatest, worst);
    }
    return found;
}

Picture stored_like(Picture rendered, const Picture& candidate, ColorSpace space) {
    const auto is_color = [](const TargetImage& t) { return t.meaning == Meaning::color; };
    const auto file = std::ranges::find_if(candidate.targets, is_color);
    if (file == candidate.targets.end()) return rendered;
    for (TargetImage& target : rendered.targets)
        if (auto made = stored_like(target, *file, space)) target = *std::move(made);
    return rendered;
}

}  // namespace strata::oracle
