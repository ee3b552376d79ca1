#include "tools/lab/hard_cases/hard_moved_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tools/strata/options/choices.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

constexpr const char* shown_algorithm = "depth_units";

std::string text_of(const ordered_json& line, const char* key) { return line[key].get<std::string>(); }

std::uint64_t changes_of(const ordered_json& changes) {
    return changes["gained"].get<std::uint64_t>() + changes["lost"].get<std::uint64_t>() +
           changes["reordered"].get<std::uint64_t>();
}

// A parsed line with movements.
struct MovedLine {
    const ordered_json* line = nullptr;
    std::uint64_t exact = 0, ours = 0, within_move = 0, within_device = 0, beyond = 0;
    double depth = 0;  // amplification: ratio to the exact answer's change
    std::uint64_t order = 0, coverage = 0;

    explicit MovedLine(const ordered_json& from) : line{&from} {
        const ordered_json& unit = from["stability"]["unit"];
        exact = changes_of(unit["exact"]);
        ours = changes_of(unit["ours"]);
        within_move = changes_of(unit["within_move"]);
        within_device = changes_of(unit["within_device"]);
        beyond = changes_of(unit["beyond"]);
        const ordered_json& ratio = unit["amplification"]["depth"];
        depth = ratio.is_null() ? 0 : ratio.get<double>();
        order = from["flicker"]["order"];
        coverage = from["flicker"]["coverage"];
    }
    [[nodiscard]] std::string profile() const { return text_of(*line, "profile"); }
    [[nodiscard]] std::string format() const { return text_of(*line, "depth"); }
    [[nodiscard]] std::uint64_t trouble() const { return within_device + beyond + order + coverage; }
};

std::vector<MovedLine> shown_lines(const std::vector<const ordered_json*>& lines) {
    std::vector<MovedLine> shown;
    for (const ordered_json* line : lines)
        if ((*line)["algorithm"] == shown_algorithm && !(*line)["stability"].is_null()) shown.emplace_back(*line);
    return shown;
}

// "-" if the exact answer does not change.
std::string amplification(const MovedLine& l) {
    if (l.exact == 0) return l.ours == 0 ? "1" : "-";
    return fmt::format("{:.2f}", static_cast<double>(l.ours) / static_cast<double>(l.exact));
}

std::string table_of(const std::vector<MovedLine>& lines) {
    std::string text =
        "\nMoved by one unit in the last place, and along the camera path (depth_units; the verdict is that of both "
        "sizes of moves):\n\n"
        "| profile | depth | changes | exact | amplification | of depth | within the move | within the device | beyond "
        "| flips in order | in coverage | verdict |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n";
    for (const MovedLine& l : lines)
        text += fmt::format("| {} | {} | {} | {} | {} | {:.3g} | {} | {} | {} | {} | {} | {} |\n", l.profile(),
                            l.format(), l.ours, l.exact, amplification(l), l.depth, l.within_move, l.within_device,
                            l.beyond, l.order, l.coverage, text_of((*l.line)["stability"], "verdict"));
    return text;
}

std::string paths_of(const std::vector<const ordered_json*>& lines) {
    std::string head = "\nFlips in order by depth path (front_to_back):\n\n| profile | depth", rule = "\n|---|---",
                rows;
    for (const ordered_json* line : lines) {
        if ((*line)["flicker"].is_null() || (*line)["flicker"]["paths"].is_null()) continue;
        const ordered_json& paths = (*line)["flicker"]["paths"];
        if (rows.empty())
            for (const auto& [name, flicker] : paths.items()) {
                head += " | " + name;
                rule += "|---:";
            }
        rows += fmt::format("| {} | {}", text_of(*line, "profile"), text_of(*line, "depth"));
        for (const auto& [name, flicker] : paths.items())
            rows += flicker.is_null() ? " | " : fmt::format(" | {}", flicker["order"].get<std::uint64_t>());
        rows += " |\n";
    }
    return rows.empty() ? rows : head + " |" + rule + "|\n" + rows;
}

const pipeline::DeviceProfile& profile_named(const HardSweep& sweep, const std::string& name) {
    return *std::ranges::find(sweep.profiles, name, &pipeline::DeviceProfile::name);
}

// The first rule in which the devices differ and which can cause the difference.
std::string cause(const pipeline::DeviceProfile& most, const pipeline::DeviceProfile& least) {
    using rasterizer::PlaneRule;
    const auto& a = most.raster;
    const auto& b = least.raster;
    if (a.plane_rule != PlaneRule::exact && b.plane_rule == PlaneRule::exact)
        return fmt::format(
            "{} begins each plane at the window's corner and rounds every step to binary32, {} rounds an "
            "exact plane once",
            most.name, least.name);
    if (a.subpixel_bits != b.subpixel_bits)
        return fmt::format(
            "the grid of {} has steps of 1/{} pixel, that of {} 1/{}, and a corner off its place tilts "
            "its plane",
            most.name, 1 << a.subpixel_bits, least.name, 1 << b.subpixel_bits);
    if (a.plane_origin != b.plane_origin)
        return fmt::format("planes of {} go through {} corners, those of {} through {} ones", most.name,
                           a.plane_origin == rasterizer::PlaneOrigin::snapped ? "snapped" : "unsnapped", least.name,
                           b.plane_origin == rasterizer::PlaneOrigin::snapped ? "snapped" : "unsnapped");
    if (a.depth_path != b.depth_path)
        return fmt::format("{} computes depths by {}, {} by {}", most.name, name_of(depth_paths(), a.depth_path),
                           least.name, name_of(depth_paths(), b.depth_path));
    return "they follow the same rules of rasterization";
}

// For the format at which two devices differ most.
std::string description_of(const HardSweep& sweep, const std::vector<MovedLine>& lines) {
    const MovedLine *most = nullptr, *least = nullptr;
    for (const MovedLine& a : lines)
        for (const MovedLine& b : lines) {
            if (a.format() != b.format() || a.profile() == b.profile() || a.trouble() < b.trouble()) continue;
            if (most == nullptr || a.trouble() - b.trouble() > most->trouble() - least->trouble())
                most = &a, least = &b;
        }
    if (most == nullptr) return "";
    if (most->trouble() == least->trouble())
        return fmt::format(
            "\nAt every format all devices change and flip alike: {} within a step of the device, {} in "
            "order and {} in coverage at {}.\n",
            most->within_device, most->order, most->coverage, most->format());
    const std::string a = most->profile(), b = least->profile();
    return fmt::format(
        "\nAt {} {} changes {} times within a step of the device and {} times beyond, {} {} and {} times; along the "
        "path "
        "{} flips {} times in order and {} in coverage, {} {} and {}. The reason: {}; {} moves a depth up to {:.3g} "
        "times "
        "as far as the exact answer, {} {:.3g} times.\n",
        most->format(), a, most->within_device, most->beyond, b, least->within_device, least->beyond, a, most->order,
        most->coverage, b, least->order, least->coverage, cause(profile_named(sweep, a), profile_named(sweep, b)), a,
        most->depth, b, least->depth);
}

}  // namespace

std::string moved_tables(const HardSweep& sweep, const std::vector<const ordered_json*>& lines) {
    const std::vector<MovedLine> shown = shown_lines(lines);
    if (shown.empty()) return "";
    return table_of(shown) + paths_of(lines) + description_of(sweep, shown);
}

std::string moved_overview(const HardSweep& sweep, const Lines& lines) {
    constexpr std::array verdicts{StabilityVerdict::stable, StabilityVerdict::degrades, StabilityVerdict::breaks,
                                  StabilityVerdict::unstable};
    std::map<std::string, std::map<std::string, std::uint64_t>> counts;
    for (const ordered_json& line : lines) {
        if (line["stability"].is_null()) continue;
        auto& own = counts[text_of(line, "profile")];
        ++own[text_of(line["stability"], "verdict")];
        own["order"] += line["flicker"]["order"].get<std::uint64_t>();
        own["coverage"] += line["flicker"]["coverage"].get<std::uint64_t>();
    }
    if (counts.empty()) return "";
    std::string text = "\nMoved, and seen along a camera path:\n\n| profile", rule = "\n|---";
    for (const StabilityVerdict verdict : verdicts) {
        text += fmt::format(" | {}", name_of(verdict));
        rule += "|---:";
    }
    text += " | flips in order | in coverage |" + rule + "|---:|---:|\n";
    for (const auto& profile : sweep.profiles) {
        auto& own = counts[profile.name];
        text += "| " + profile.name;
        for (const StabilityVerdict verdict : verdicts)
            text += fmt::format(" | {}", own[std::string{name_of(verdict)}]);
        text += fmt::format(" | {} | {} |\n", own["order"], own["coverage"]);
    }
    return text;
}

}  // namespace strata::tools
