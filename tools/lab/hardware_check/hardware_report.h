// tools/lab/hardware_check/hardware_report.h - what a hardware check found: a line a suite, a line a picture,
// JSON, and a page with pictures.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/hardware_check/compare.h"
#include "tools/strata/table.h"

namespace strata::tools {

// A file PATH = DIR/SUITE/NAME.png.
struct Capture {
    std::string suite, name, path;
};

// Beside the suites: images that tests loaded (Pixel_shader's). No suite.
inline constexpr std::string_view textures_folder = "textures";

// The picture of a known suite, or why there is none: the profile may lack what it draws on.
[[nodiscard]] hardware_check::Drawing drawn(const Capture& capture, const pipeline::DeviceProfile& profile);

// The outcome for one capture.
struct CheckedPicture {
    Capture capture;
    // The suite is known, and so is the name in it.
    bool is_known = false;
    // Why it was not compared; empty: it was.
    std::string unmodelled;
    hardware_check::Bound bound{};
    hardware_check::Comparison comparison{};
    std::vector<std::uint64_t> reports{};
    // With digests alone.
    rasterizer::Rect labels{};
    // Of the capture outside its labels.
    std::string digest{};
    [[nodiscard]] bool is_compared() const { return is_known && unmodelled.empty(); }
    // Pictures that are not modelled never fail a check; the tables count them by themselves.
    [[nodiscard]] bool is_accepted() const { return !is_compared() || comparison.within_bound; }
};

// rgba8. InputError for a file that holds no picture, or several.
[[nodiscard]] pipeline::Image read_capture(const std::string& path);

// Whether `labels` and `digest` are wanted, too: they take as long as the comparison.
enum class WithDigests : bool { no, yes };

// Draws the picture and compares. InputError for a file that is no such capture.
[[nodiscard]] CheckedPicture check(const Capture& capture, const pipeline::DeviceProfile& profile,
                                   WithDigests with_digests);

// The word in tables and JSON: "unknown", "not modelled", "equal", "within bound", "outside".
[[nodiscard]] std::string outcome(const CheckedPicture& p);
// A row a suite; a row a picture that is not equal or reports a count.
[[nodiscard]] Table suite_table(const std::vector<CheckedPicture>& checked);
[[nodiscard]] Table picture_table(const std::vector<CheckedPicture>& checked);
// The tables, and the JSON document of --json.
[[nodiscard]] std::string to_text(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile);
[[nodiscard]] std::string to_json(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile);
// Suite, picture, label box, digest: of every capture that came out equal.
[[nodiscard]] std::string digest_rows(const std::vector<CheckedPicture>& checked);
// report.md, and a difference picture of whatever is not equal, in `folder`, which is made.
void write_report(const std::string& folder, const std::vector<CheckedPicture>& checked,
                  const pipeline::DeviceProfile& profile);

}  // namespace strata::tools
