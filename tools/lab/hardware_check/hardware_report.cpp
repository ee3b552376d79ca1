// tools/lab/hardware_check/hardware_report.cpp - draws each capture's picture, decides its outcome, and writes tables,
// JSON and difference images (hardware_report.h).
#include "tools/lab/hardware_check/hardware_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "pipeline/device/check.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace hc = hardware_check;
using nlohmann::ordered_json;

namespace {

// The reason why a picture is not compared; else the first pixel that differs, the eight smallest differences with
// their pixels, and the results of queries.
std::string detail(const CheckedPicture& p) {
    if (!p.is_compared()) return p.unmodelled;
    const hc::CaptureComparison& c = p.comparison;
    std::string text;
    if (c.differing > 0) {
        text = fmt::format("first at {},{}: {:08x}, the chip {:08x};", c.first[0], c.first[1], c.ours, c.theirs);
        int shown = 0;
        for (const auto& [difference, pixels] : c.histogram)
            if (shown++ < 8) text += fmt::format(" {:+d}: {}", difference, pixels);
    }
    for (const std::uint64_t report : p.reports) text += fmt::format("{}report {}", text.empty() ? "" : ", ", report);
    return text;
}

// Replaces control characters, which a file name may contain, with question marks.
std::string printable(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return text;
}

// A suite's row. The first six count pictures; `pixels` and `off` count pixels.
struct SuiteCount {
    std::string name;
    std::uint64_t pictures = 0, equal = 0, within = 0, differ = 0, unmodelled = 0, pixels = 0, off = 0;
    std::uint32_t largest = 0;
};

// Captures are sorted by suite, so a suite's pictures are consecutive.
std::vector<SuiteCount> count_suites(const std::vector<CheckedPicture>& checked) {
    std::vector<SuiteCount> suites;
    for (const CheckedPicture& p : checked) {
        const std::string name = printable(p.capture.suite);
        if (suites.empty() || suites.back().name != name) suites.push_back({.name = name});
        SuiteCount& s = suites.back();
        ++s.pictures;
        if (!p.is_compared()) {
            ++s.unmodelled;
            continue;
        }
        const hc::CaptureComparison& c = p.comparison;
        ++(c.differing == 0 ? s.equal : c.within_bound ? s.within : s.differ);
        s.pixels += c.compared;
        s.off += c.differing;
        s.largest = std::max(s.largest, c.largest);
    }
    return suites;
}

// The name of the difference image in the report's folder.
std::string file_name(const CheckedPicture& p) { return p.capture.suite + "-" + p.capture.name + ".png"; }

}  // namespace

std::string outcome(const CheckedPicture& p) {
    if (!p.is_known) return "unknown";
    if (!p.unmodelled.empty()) return "not modelled";
    if (p.comparison.differing == 0) return "equal";
    return p.comparison.within_bound ? "within bound" : "outside";
}

Table suite_table(const std::vector<CheckedPicture>& checked) {
    const auto right = Align::right;
    Table table{{{"suite"},
                 {"pictures", right},
                 {"equal", right},
                 {"within bound", right},
                 {"outside", right},
                 {"not modelled", right},
                 {"pixels compared", right},
                 {"pixels off", right},
                 {"largest", right}},
                {}};
    for (const SuiteCount& s : count_suites(checked))
        table.rows.push_back({s.name, fmt::to_string(s.pictures), fmt::to_string(s.equal), fmt::to_string(s.within),
                              fmt::to_string(s.differ), fmt::to_string(s.unmodelled), fmt::to_string(s.pixels),
                              fmt::to_string(s.off), fmt::to_string(s.largest)});
    return table;
}

pipeline::Image read_capture(const std::string& path) {
    std::vector<scenes::FileImage> images = scenes::read_images(path);
    // A PNG has one image; an EXR of several parts is not a capture.
    if (images.size() != 1) throw InputError{path, "picture", "one image", std::to_string(images.size())};
    return std::move(images.front().image);
}

hc::Drawing drawn(const Capture& capture, const pipeline::DeviceProfile& profile) {
    // The captures' folder is the suite's parent.
    const std::filesystem::path folder = std::filesystem::path(capture.path).parent_path().parent_path();
    try {
        return hc::draw(*hc::find_suite(capture.suite), capture.name, profile, (folder / textures_folder).string());
        // A refusal is a reason: the profile is not of a chip that could draw this.
    } catch (const pipeline::Refused& refused) {
        return {std::nullopt, refused.what()};
    }
}

CheckedPicture check(const Capture& capture, const pipeline::DeviceProfile& profile, WithDigests with_digests) {
    CheckedPicture result;
    result.capture = capture;
    // Unknown suites and names are listed and not compared, because a newer archive may contain both.
    if (hc::find_suite(capture.suite) == nullptr) {
        result.unmodelled = "no suite of this name is known";
        return result;
    }
    const hc::Drawing drawing = drawn(capture, profile);
    result.is_known = drawing.reason != hc::unknown_name_reason;
    result.unmodelled = drawing.reason;
    if (!drawing.picture) return result;
    const pipeline::Image image = read_capture(capture.path);
    result.bound = drawing.picture->bound;
    result.reports = drawing.picture->reports;
    result.comparison = hc::compare(*drawing.picture, image, capture.path);
    if (with_digests == WithDigests::no) return result;
    result.labels = hc::label_box(*drawing.picture, image);
    result.digest = hc::digest_outside(result.labels, *drawing.picture, image);
    return result;
}

// Pictures that are equal and have no query results would fill pages: only the table of suites counts them.
Table picture_table(const std::vector<CheckedPicture>& checked) {
    Table pictures{
        {{"suite"}, {"picture"}, {"outcome"}, {"pixels off", Align::right}, {"largest", Align::right}, {"detail"}}, {}};
    for (const CheckedPicture& p : checked)
        if (outcome(p) != "equal" || !p.reports.empty())
            pictures.rows.push_back({printable(p.capture.suite), printable(p.capture.name), outcome(p),
                                     fmt::to_string(p.comparison.differing), fmt::to_string(p.comparison.largest),
                                     detail(p)});
    return pictures;
}

std::string to_text(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile) {
    return fmt::format("profile {}; pictures that are not equal, or report a count:\n", profile.name) +
           to_text(picture_table(checked)) + '\n' + to_text(suite_table(checked));
}

std::string to_json(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile) {
    ordered_json pictures = ordered_json::array();
    for (const CheckedPicture& p : checked) {
        const hc::CaptureComparison& c = p.comparison;
        ordered_json histogram = ordered_json::object();
        for (const auto& [difference, count] : c.histogram) histogram[std::to_string(difference)] = count;
        pictures.push_back({{"suite", p.capture.suite},
                            {"picture", p.capture.name},
                            {"outcome", outcome(p)},
                            {"detail", detail(p)},
                            {"difference", p.is_compared() && c.differing > 0 ? ordered_json(file_name(p)) : nullptr},
                            {"compared", c.compared},
                            {"differing", c.differing},
                            {"largest", c.largest},
                            {"histogram", std::move(histogram)},
                            {"first", c.differing > 0 ? ordered_json(c.first) : ordered_json(nullptr)},
                            {"bound", {{"pixels", p.bound.pixels}, {"units", p.bound.units}}},
                            {"reports", p.reports}});
    }
    const ordered_json document{{"profile", profile.name}, {"pictures", std::move(pictures)}};
    // File names may contain bytes that are not UTF-8; these are replaced.
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

std::string digest_rows(const std::vector<CheckedPicture>& checked) {
    std::string rows;
    for (const CheckedPicture& p : checked)
        if (outcome(p) == "equal")
            rows += fmt::format("{} {} {} {} {} {} {}\n", p.capture.suite, p.capture.name, p.labels.x0, p.labels.y0,
                                p.labels.x1, p.labels.y1, p.digest);
    return rows;
}

void write_report(const std::string& folder, const std::vector<CheckedPicture>& checked,
                  const pipeline::DeviceProfile& profile) {
    std::filesystem::create_directories(folder);
    for (const CheckedPicture& p : checked) {
        if (!p.is_compared() || outcome(p) == "equal") continue;
        // Drawn again, because keeping every picture would take a megabyte each.
        const hc::Drawing drawing = drawn(p.capture, profile);
        scenes::write_image((std::filesystem::path(folder) / file_name(p)).string(),
                            {.color = hc::difference_picture(*drawing.picture, read_capture(p.capture.path))});
    }
    scenes::write_file((std::filesystem::path(folder) / "results.json").string(), to_json(checked, profile));
}

}  // namespace strata::tools
