#include "tools/lab/hard_cases/hard_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "peeling/audit/image_error.h"
#include "peeling/registry.h"
#include "peeling/render.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "tools/lab/hard_cases/hard_moved_page.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// Counts of each verdict, in the order of hard_verdicts.
using VerdictCounts = std::array<int, hard_verdicts.size()>;

void count(const ordered_json& line, VerdictCounts& counts) {
    for (std::size_t i = 0; i < hard_verdicts.size(); ++i)
        if (line["verdict"] == name_of(hard_verdicts[i])) ++counts[i];
}

std::string page_row(const std::string& name, const VerdictCounts& counts) {
    std::string row = "| " + name;
    for (const int number : counts) row += fmt::format(" | {}", number);
    return row + " |\n";
}

std::string page_head(const std::string& first) {
    std::string head = "| " + first, rule = "\n|---";
    for (const HardVerdict verdict : hard_verdicts) {
        head += fmt::format(" | {}", name_of(verdict));
        rule += "|---:";
    }
    return head + " |" + rule + "|\n";
}

// The first reason for each kind of failure of the case, with the combination.
std::string troubles(const std::vector<const ordered_json*>& lines) {
    std::string text;
    for (const HardVerdict verdict : {HardVerdict::failed, HardVerdict::breaks, HardVerdict::degrades}) {
        for (const ordered_json* line : lines) {
            if ((*line)["verdict"] != name_of(verdict)) continue;
            text += fmt::format("- {}, for instance {} on {} at {}:", name_of(verdict),
                                (*line)["algorithm"].get<std::string>(), (*line)["profile"].get<std::string>(),
                                (*line)["depth"].get<std::string>());
            for (const auto& reason : (*line)["reasons"]) text += " " + reason.get<std::string>() + ";";
            text.back() = '.';
            text += "\n";
            break;
        }
    }
    return text.empty() ? text : "\n" + text;
}

std::string section(const HardSweep& sweep, const scenes::HardCase& hard, bool has_picture,
                    const std::vector<const ordered_json*>& lines) {
    const scenes::HardAnswer& counts = hard.counts;
    const bool has_range = hard.depth_near != 0 || hard.depth_far != 1;
    const std::string range =
        has_range ? fmt::format(" --depth-range {},{}", hard.depth_near, hard.depth_far) : std::string{};
    std::string text = fmt::format("\n## {}\n", hard.name);
    if (has_picture) text += fmt::format("![{}](pictures/{}.png)\n\n", hard.name, hard.name);
    text += fmt::format(
        "{} Right answer: {} Exact geometry has {} visible fragments, {} at the deepest pixel, {} layers, "
        "and ties at {} pixels of {} x {}.\n\n    strata render hard:case={} --size {}x{}{} -o {}.png\n\n",
        hard.hard, hard.answer, counts.fragments, counts.deepest, counts.layers, counts.tied_pixels, hard.width,
        hard.height, hard.name, hard.width, hard.height, range, hard.name);
    text += page_head("profile");
    for (const auto& profile : sweep.profiles) {
        VerdictCounts own{};
        for (const ordered_json* line : lines)
            if ((*line)["profile"] == profile.name) count(*line, own);
        text += page_row(profile.name, own);
    }
    return text + troubles(lines) + moved_tables(sweep, lines);
}

std::string in_folder(const std::string& folder, const std::string& name) {
    return (std::filesystem::path(folder) / name).string();
}

bool is_refused(const scenes::HardCase& hard) { return hard.depth_near > hard.depth_far; }

// The range of the frame's pixels that one pixel of its image covers, along one axis: from `first` to `end`, exclusive.
struct Covered {
    int first = 0, end = 0;
};

Covered covered_by(int number, int side, int picture_side) {
    const auto at = [&](int n) { return static_cast<int>(std::int64_t{n} * side / picture_side); };
    return {at(number), std::max(at(number) + 1, at(number + 1))};
}

// The index of the codes of a block's brightest pixel.
std::size_t brightest(const pipeline::Image& image, const Covered& columns, const Covered& rows) {
    std::size_t best = image.index(columns.first, rows.first);
    double most = -1;
    for (int y = rows.first; y < rows.end; ++y)
        for (int x = columns.first; x < columns.end; ++x) {
            double sum = 0;
            for (int c = 0; c < 3; ++c) sum += peeling::channel_value(image, x, y, c);
            if (!(sum > most)) continue;
            most = sum;
            best = image.index(x, y);
        }
    return best;
}

}  // namespace

pipeline::Image page_picture(const pipeline::Image& image) {
    constexpr int least_side = 32, small = 256, large = 1024;
    const int enlarged = std::max(1, small / std::max(image.width, image.height));
    const auto side = [&](int pixels) { return std::clamp(pixels * enlarged, least_side, large); };
    pipeline::Image picture{image.format, side(image.width), side(image.height)};
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const std::size_t from = brightest(image, covered_by(x, image.width, picture.width),
                                               covered_by(y, image.height, picture.height));
            std::copy_n(image.codes.begin() + static_cast<std::ptrdiff_t>(from), image.channels(),
                        picture.codes.begin() + static_cast<std::ptrdiff_t>(picture.index(x, y)));
        }
    return picture;
}

std::string page_of(const HardSweep& sweep, const Lines& lines) {
    std::map<std::string, std::vector<const ordered_json*>> by_case;
    VerdictCounts all{};
    for (const ordered_json& line : lines) {
        by_case[line["case"].get<std::string>()].push_back(&line);
        count(line, all);
    }
    std::string text = fmt::format(
        "# Hard cases\n"
        "{} scenes by {} algorithms on {} devices at {} depth formats. Pictures are the exact A-buffer of the profile "
        "ideal, small frames enlarged; of frames over 1024 pixels each block's brightest.\n\n",
        sweep.cases.size(), sweep.algorithms.size(), sweep.profiles.size(), sweep.formats.size());
    text += page_head("") + page_row("all", all) + moved_overview(sweep, lines);
    for (const scenes::HardCase* hard : sweep.cases)
        text += section(sweep, *hard, !is_refused(*hard), by_case[std::string{hard->name}]);
    return text;
}

void write_page(const HardSweep& sweep, const Lines& lines, const std::string& folder) {
    std::filesystem::create_directories(std::filesystem::path(folder) / "pictures");
    for (const scenes::HardCase* hard : sweep.cases) {
        if (is_refused(*hard)) continue;
        const auto picture = picture_of(*hard, *pipeline::find_profile("ideal"), *peeling::find_algorithm("a_buffer"));
        scenes::write_image(in_folder(folder, fmt::format("pictures/{}.png", hard->name)),
                            {.color = page_picture(picture.frame.color)});
    }
    scenes::write_file(in_folder(folder, "RESULTS.md"), page_of(sweep, lines));
}

}  // namespace strata::tools
