// tools/oracle/picture/numbers_file.cpp - images in .npy files.
//
// Rule     In a .npy file a single channel of f4 or u4 is a depth, one of u1 or u2 another target. Four channels of u2
//          are codes of rgb10_a2 if no colour is above 1023 and every alpha is 341 times 0 to 3, not all of them 0.
#include "tools/oracle/picture/numbers_file.h"

#include <fmt/format.h>

#include "rasterizer/base/input_error.h"
#include "scenes/memory_limit.h"

namespace strata::oracle {

Code code_of(scenes::Element element, const std::string& file) {
    switch (element) {
        case scenes::Element::u1: return Code::unorm8;
        case scenes::Element::u2: return Code::unorm16;
        case scenes::Element::u4: return Code::integer;
        case scenes::Element::f2: return Code::half;
        case scenes::Element::f4: return Code::single;
        case scenes::Element::i4: break;
    }
    throw InputError(file, "descr", "elements |u1, <u2, <u4, <f2 or <f4", "<i4");
}

namespace {

// A picture of 16 bits has no such alphas: the greatest would be 1.6 %.
[[nodiscard]] bool holds_ten_bits(const TargetImage& target) {
    if (target.code != Code::unorm16 || target.channels != 4) return false;
    bool has_alpha = false;
    for (std::size_t i = 0; i < target.codes.size(); ++i) {
        const std::uint32_t code = target.codes[i];
        if (code > 1023 || (i % 4 == 3 && code % 341 != 0)) return false;
        has_alpha = has_alpha || (i % 4 == 3 && code != 0);
    }
    return has_alpha;
}

}  // namespace

TargetImage read_npy(const std::string& path) {
    const scenes::NumberArray array = scenes::read_npy(path);
    const auto& shape = array.shape;
    const auto fits = [](std::size_t side) { return side >= 1 && side <= max_side; };
    if ((shape.size() != 2 && shape.size() != 3) || !fits(shape[0]) || !fits(shape[1]) ||
        (shape.size() == 3 && (shape[2] < 1 || shape[2] > 4)))
        throw InputError(path, "shape", "(rows, columns) or (rows, columns, channels), at most 16384 and 4",
                         fmt::format("({})", fmt::join(shape, ", ")));
    TargetImage target{.code = code_of(array.element, path),
                       .width = static_cast<int>(shape[1]),
                       .height = static_cast<int>(shape[0]),
                       .channels = shape.size() == 3 ? static_cast<int>(shape[2]) : 1};
    const bool is_wide = target.code == Code::single || target.code == Code::integer;
    target.meaning = target.channels > 1 ? Meaning::color : is_wide ? Meaning::depth : Meaning::other;
    target.name = target.channels > 1 ? "color" : is_wide ? "depth" : "value";
    // NPY's elements have the same layout as raw numbers.
    scenes::check_pixels(path, shape[1], shape[0], 4 * static_cast<std::uint64_t>(target.channels));
    const RawLayout layout{.width = target.width,
                           .height = target.height,
                           .channels = target.channels,
                           .code = target.code,
                           .meaning = target.meaning};
    target.codes = raw_target(array.bytes, path, layout).codes;
    if (holds_ten_bits(target)) target.code = Code::unorm10;
    return target;
}

}  // namespace strata::oracle
