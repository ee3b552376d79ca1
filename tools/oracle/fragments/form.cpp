// tools/oracle/fragments/form.cpp - decides whether a picture's colours are straight or premultiplied: the form with
// fewer wrong pixels of a sample (form.h).
#include "tools/oracle/fragments/form.h"

#include <algorithm>

#include "tools/oracle/picture/pairs.h"
#include "tools/oracle/search/match.h"

namespace strata::oracle::verdict {

std::string Formed::description() const {
    if (!is_chosen) return "";
    return use.is_divided
               ? "  colours are read as straight and multiplied by their alpha, because fewer pixels are wrong then\n"
               : "  colours are read as premultiplied, because fewer pixels are wrong then\n";
}

namespace {

// The number of pixels of a sample that are wrong under the closest definite hypothesis.
std::size_t wrong_of(const SceneFragments& scene, const Formed& formed) {
    constexpr std::size_t most = 400, most_structures = 1024;
    const Colors colors = formed.colors();
    const Families all = families(storage_of(colors.code()), {0, 0x1p-20}, Looseness::definite, formed.use.is_divided);
    const Sample sample = sampled(scene, colors, most).with_few_structures(most_structures);
    const auto closest = best_of(all, {}, sample, WrongPixels::some);
    if (!closest) return sample.pixels().size();
    const Compositor compositor{*closest};
    StackMaker maker{scene.setting()};
    return static_cast<std::size_t>(std::ranges::count_if(sample.pixels(), [&](const SampledPixel& pixel) {
        return matching_ties(compositor, {}, pixel.list, pixel.value, maker).mask == 0;
    }));
}

}  // namespace

std::optional<TargetImage> in_codes(const TargetImage& target) {
    if (target.code != Code::half && target.code != Code::single) return std::nullopt;
    TargetImage made = target;
    made.code = Code::unorm8;
    for (std::size_t i = 0; i < target.codes.size(); ++i) {
        made.codes[i] = nearest(Code::unorm8, value(target.code, target.codes[i]));
        if (!is_equal({target.code, target.codes[i]}, {Code::unorm8, made.codes[i]})) return std::nullopt;
    }
    return made;
}

Formed formed(const SceneFragments& scene, const TargetImage& stored, bool is_stated) {
    const std::optional<TargetImage> codes = in_codes(stored);
    const TargetImage& target = codes ? *codes : stored;
    Formed as_it_is{.target = target};
    if (target.alpha_form != AlphaForm::straight) return as_it_is;
    auto multiplied = premultiplied(target);
    if (!multiplied) return as_it_is;
    Formed divided{.target = *std::move(multiplied), .use = {.is_divided = true}};
    if (is_stated) return divided;
    divided.is_chosen = as_it_is.is_chosen = true;
    return wrong_of(scene, as_it_is) < wrong_of(scene, divided) ? as_it_is : divided;
}

}  // namespace strata::oracle::verdict
