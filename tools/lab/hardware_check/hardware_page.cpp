#include "tools/lab/hardware_check/hardware_page.h"

#include <fmt/format.h>

#include <algorithm>

namespace strata::tools {

namespace {

std::size_t number_of(const std::vector<CheckedPicture>& checked, std::string_view word) {
    return static_cast<std::size_t>(
        std::ranges::count_if(checked, [&](const CheckedPicture& p) { return outcome(p) == word; }));
}

std::string found(const std::vector<CheckedPicture>& checked) {
    std::uint64_t compared = 0, off = 0;
    for (const CheckedPicture& p : checked) compared += p.comparison.compared, off += p.comparison.differing;
    std::string text = fmt::format(
        "Of {} picture{} that the chip drew, {} come out equal in every bit, {} within their bound, {} beyond it; {} "
        "are "
        "not modelled.",
        checked.size(), checked.size() == 1 ? "" : "s", number_of(checked, "equal"), number_of(checked, "within bound"),
        number_of(checked, "outside"), number_of(checked, "not modelled"));
    if (const std::size_t unknown = number_of(checked, "unknown"); unknown > 0)
        text += fmt::format(" The names of {} are not known.", unknown);
    return text + fmt::format(" Of {} pixels compared {} differ.", compared, off);
}

// Drawn again, because keeping every picture would take a megabyte each.
void add_difference(PlainPage& page, const CheckedPicture& p, const pipeline::DeviceProfile& profile) {
    const hardware_check::Drawing drawing = drawn(p.capture, profile);
    const pipeline::Image capture = read_capture(p.capture.path);
    const std::string name = p.capture.suite + "/" + p.capture.name;
    if (outcome(p) == "outside") page.picture(capture, name + ": the chip's picture");
    page.picture(hardware_check::difference_picture(*drawing.picture, capture),
                 fmt::format("{}: {}, {} of {} pixels off, by at most {}", name, outcome(p), p.comparison.differing,
                             p.comparison.compared, p.comparison.largest));
}

}  // namespace

PlainPage page_of(const std::vector<CheckedPicture>& checked, const pipeline::DeviceProfile& profile) {
    PlainPage page{"The profile " + std::string(profile.name) + " against a real chip", "strata hardware-check"};
    page.lead(found(checked));
    page.heading("Suites");
    page.table(suite_table(checked), "Pictures and pixels of each suite");
    if (number_of(checked, "outside") + number_of(checked, "within bound") > 0) {
        page.heading("Where they differ");
        page.paragraph(
            "Black is equal; red is a colour that differs, or a depth that is the chip's greater one, cyan a depth "
            "that is "
            "its smaller one; labels, which are not compared, are white.");
        for (const std::string_view word : {"outside", "within bound"})
            for (const CheckedPicture& p : checked)
                if (outcome(p) == word) add_difference(page, p, profile);
    }
    const Table pictures = picture_table(checked);
    if (!pictures.rows.empty()) {
        page.heading("Pictures that are not equal, or report a count");
        page.table(pictures, "What differs in each, or why it is not compared");
    }
    return page;
}

}  // namespace strata::tools
