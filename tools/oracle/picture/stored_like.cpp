#include "tools/oracle/picture/stored_like.h"

#include <algorithm>

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

}  // namespace

std::optional<TargetImage> stored_like(const TargetImage& rendered, const TargetImage& file, ColorSpace space) {
    const bool is_float = rendered.code == Code::half || rendered.code == Code::single;
    const bool is_same = space == ColorSpace::encoded && !is_float;
    if (!file.holds_encoded || is_same || rendered.meaning != Meaning::color || rendered.channels != 4)
        return std::nullopt;
    const FloatEnvironment environment;
    const bool has_alpha = file.channels == 2 || file.channels == 4;
    const bool is_divided =
        has_alpha && file.alpha_form == AlphaForm::straight && rendered.alpha_form == AlphaForm::premultiplied;
    TargetImage made = rendered;
    made.code = file.code;
    made.alpha_form = is_divided ? AlphaForm::straight : rendered.alpha_form;
    for (std::size_t pixel = 0; pixel < made.pixels(); ++pixel) {
        const auto alpha = static_cast<float>(rendered.value_at(pixel, 3));
        for (int c = 0; c < 4; ++c) {
            auto value = static_cast<float>(rendered.value_at(pixel, c));
            if (is_divided && c < 3) value = alpha > 0 ? value / alpha : 0.0f;
            made.codes[pixel * 4 + static_cast<std::size_t>(c)] =
                stored(file.code, value, c < 3 ? space : ColorSpace::encoded);
        }
    }
    return made;
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
