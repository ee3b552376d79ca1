// tools/lab/hardware_check/hardware_report.h - the result of a hardware check: one line per suite, one per picture,
// JSON, and difference images.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/lab/hardware_check/drawing/compare.h"
#include "tools/strata/table.h"

namespace strata::tools {

// A file PATH = DIR/SUITE/NAME.png.
struct Capture {
    std::string suite, name, path;
};

// A folder next to the suites with images that tests loaded (Pixel_shader's). Not a suite.
inline constexpr std::string_view textures_folder = "textures";

// The picture of a known suite, or the reason why there is none: the profile may lack a feature that it needs.
[[nodiscard]] hardware_check::Drawing drawn(const Capture& capture, const pipeline::DeviceProfile& profile);

// The outcome for one capture.
struct CheckedPicture {
    Capture capture;
    // The suite is known, and so is the name in it.
    bool is_known = false;
    // The reason why it was not compared; empty: it was.
    std::string unmodelled;
    hardware_check::Bound bound{};
    hardware_check::CaptureComparison comparison{};
    std::vector<std::uint64_t> reports{};
    // Only with digests.
    rasterizer::Rect labels{};
    // Of the capture, without its labels.
    std::string digest{};
    [[nodiscard]] bool is_compared() const { return is_known && unmodelled.empty(); }
    // Pictures that are not modelled never fail a check; the tables count them separately.
    [[nodiscard]] bool is_accepted() const { return !is_compared() || comparison.within_bound; }
};

// Returns rgba8. InputError for a file with no image, or with several.
[[nodiscard]] pipeline::Image read_capture(const std::string& path);

// Whether `labels` and `digest` are computed, which takes as long as the comparison.
enum class WithDigests : bool { no, yes };

// Draws the picture and compares it. InputError for a file that is not such a capture.
[[nodiscard]] CheckedPicture check(const Capture& capture, const pipeline::DeviceProfile& profile,
                                   WithDigests with_digests);

// The outcome in tables and JSON: "unknown", "not modelled", "equal", "within bound", "outside".
[[nodiscard]] std::string outcome(const CheckedPicture& p);
// One row per suite; one row per picture that is not equal or reports a count.
[[nodiscard]] Table suite_table(const std::vector<CheckedPicture>& checked);
[[nodiscard]] Table picture_table(const std::vector<CheckedPicture>& checked);
// The tables, and the JSON document of --json.
[[nodiscard]] std::string to_text(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile);
[[nodiscard]] std::string to_json(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile);
// Suite, picture, label box and digest of every capture that is equal.
[[nodiscard]] std::string digest_rows(const std::vector<CheckedPicture>& checked);
// Writes results.json, the document of --json, and a difference image of every picture that is not equal, into
// `folder`, which is created.
void write_report(const std::string& folder, const std::vector<CheckedPicture>& checked,
                  const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
