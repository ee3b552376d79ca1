// tools/oracle/program/rounding.cpp - the roundings of each format, and their words (rounding.h).
#include "tools/oracle/program/rounding.h"

#include <algorithm>
#include <cmath>

#include "tools/oracle/rounding/storage_rounding.h"

namespace strata::oracle::program {

namespace {

PortRounding at_each_blend(BlendForm form, PortFormat format, PortFormat result) {
    return {.form = form, .blend = format, .weight = format, .result = result};
}

void add_of_codes(std::vector<PortRounding>& all, PortFormat format) {
    all.push_back({.truncates = true, .result = format});
    for (const BlendForm form : {BlendForm::over, BlendForm::under, BlendForm::under_alpha, BlendForm::both_ends}) {
        PortRounding r = at_each_blend(form, format, format);
        all.push_back(r);
        r.truncates = true;
        if (form != BlendForm::both_ends) all.push_back(r);
    }
    PortRounding stores = at_each_blend(BlendForm::over, format, format);
    stores.layers = format;
    all.push_back(stores);
    stores.premultiplies = true;
    all.push_back(stores);
    // A peel stores its layers before it blends them.
    for (const BlendForm form : {BlendForm::under, BlendForm::both_ends}) {
        PortRounding peels = at_each_blend(form, format, format);
        peels.layers = format;
        peels.premultiplies = true;
        all.push_back(peels);
    }
    PortRounding splits = at_each_blend(BlendForm::over, format, format);
    splits.splits = true;
    all.push_back(splits);
}

std::string_view name(PortFormat format) {
    switch (format) {
        case PortFormat::unorm8: return "8 bits";
        case PortFormat::unorm10: return "10 bits";
        case PortFormat::unorm16: return "16 bits";
        case PortFormat::half: return "halves";
        case PortFormat::exact: break;
    }
    return "floats";
}

std::string_view name(BlendForm form) {
    switch (form) {
        case BlendForm::once: return "rounded once";
        case BlendForm::over: return "back to front";
        case BlendForm::under: return "front to back";
        case BlendForm::under_alpha: return "front to back with alpha";
        case BlendForm::both_ends: break;
    }
    return "from both ends";
}

}  // namespace

std::vector<PortRounding> roundings(PortFormat format) {
    std::vector<PortRounding> all{{.result = format}};
    switch (format) {
        case PortFormat::exact: break;
        case PortFormat::half:
            for (const BlendForm form :
                 {BlendForm::over, BlendForm::under, BlendForm::under_alpha, BlendForm::both_ends})
                all.push_back(at_each_blend(form, format, format));
            all.push_back(all[1]);
            all.back().layers = format;
            break;
        case PortFormat::unorm8:
            add_of_codes(all, format);
            for (const BlendForm form : {BlendForm::over, BlendForm::under}) {
                all.push_back(at_each_blend(form, PortFormat::half, format));
                all.push_back(at_each_blend(form, PortFormat::unorm10, format));
            }
            all.push_back(at_each_blend(BlendForm::under, format, format));
            all.back().weight = PortFormat::half;
            break;
        case PortFormat::unorm10:
        case PortFormat::unorm16: add_of_codes(all, format); break;
    }
    return all;
}

std::string describe(const PortRounding& rounding) {
    std::string words{name(rounding.form)};
    if (rounding.form != BlendForm::once) words += " in " + std::string{name(rounding.blend)};
    if (rounding.truncates) words += ", truncated";
    return words;
}

PortFormat narrowest(std::span<const double> values) {
    const auto are_codes = [&](PortFormat format) {
        return std::ranges::all_of(values, [&](double v) {
            const double code = v * codes_of(format);
            return std::fabs(code - std::nearbyint(code)) < 0x1p-23 * codes_of(format) + 1e-9;
        });
    };
    for (const PortFormat format : {PortFormat::unorm8, PortFormat::unorm10})
        if (are_codes(format)) return format;
    const auto is_half = [](double v) { return verdict::StorageRounding::nearest_half(v) == v || std::fabs(v) < 1e-4; };
    if (std::ranges::all_of(values, is_half)) return PortFormat::half;
    // Steps of 2^-16 are hardly finer than those of binary32 near 1, so that they are asked of the exact code.
    const bool is_unorm16 = std::ranges::all_of(values, [](double v) {
        return static_cast<double>(static_cast<float>(std::nearbyint(v * 65535) / 65535)) == v;
    });
    return is_unorm16 ? PortFormat::unorm16 : PortFormat::exact;
}

}  // namespace strata::oracle::program
