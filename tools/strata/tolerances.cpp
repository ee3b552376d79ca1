#include "tools/strata/tolerances.h"

#include "tools/strata/options/option.h"

namespace strata::tools {

namespace {

// "color=1,depth=2,coverage=10", each at most once.
std::optional<oracle::Tolerances> to_tolerances(std::string_view text) {
    oracle::Tolerances tolerances;
    std::vector<std::string_view> seen;
    for (const std::string& part : split(text, ',')) {
        const std::size_t is = part.find('=');
        if (is == std::string::npos) return std::nullopt;
        const auto amount = to_int<std::uint32_t>(std::string_view(part).substr(is + 1));
        if (!amount) return std::nullopt;
        const std::string kind = part.substr(0, is);
        if (kind == "color")
            tolerances.color_codes = *amount;
        else if (kind == "depth")
            tolerances.depth_codes = *amount;
        else if (kind == "coverage")
            tolerances.coverage_pixels = *amount;
        else
            return std::nullopt;
    }
    return tolerances;
}

}  // namespace

void add_layout_option(CLI::App& app, std::optional<oracle::RawLayout>& layout) {
    add_option(
        app, layout,
        {"--layout", "WIDTHxHEIGHT:FORMAT[:bottom-up]", "of files of bare little-endian numbers",
         "WIDTHxHEIGHT:FORMAT such as 640x480:rgba8, rgb16, rgba32f, d24 or d32f, and :bottom-up if the lowest row "
         "comes first"},
        [](std::string_view text) -> std::optional<std::optional<oracle::RawLayout>> {
            const auto found = oracle::raw_layout(text);
            if (!found) return std::nullopt;
            return found;
        });
}

void add_tolerance_option(CLI::App& app, oracle::Tolerances& tolerances) {
    add_option(app, tolerances,
               {"--tolerance", "KIND=N[,KIND=N...]",
                "forgive colours and depths N codes apart, and N pixels of other coverage; nothing without this option",
                "color=N, depth=N and coverage=N with commas between"},
               to_tolerances);
}

}  // namespace strata::tools
