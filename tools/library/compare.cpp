// tools/library/compare.cpp - formats a comparison as the message of a failed test, and writes the pictures that show
// the difference.
#include "strata/compare.h"

#include <cstdlib>
#include <filesystem>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "scenes/nearest_name.h"
#include "tools/oracle/compare/drawings.h"
#include "tools/oracle/pack/pack_pictures.h"

namespace strata {
inline namespace v0_1 {

namespace {

std::filesystem::path folder_for_pictures() {
    const char* const wanted = std::getenv("STRATA_PICTURES");
    return std::filesystem::absolute(wanted != nullptr && *wanted != 0 ? wanted : "strata-pictures");
}

// Derives a file name from the reference's name: characters other than letters, digits, '.', '-' and '_' become '_'.
std::string file_name(const std::string& name) {
    std::string file = std::filesystem::path(name).filename().string();
    for (char& c : file) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                              c == '-' || c == '_';
        if (!is_plain) c = '_';
    }
    return file.empty() ? "reference" : file;
}

// Reads the expected picture of one algorithm from a pack, or the picture in any other file.
Picture picture_at(const std::string& path, const std::string& algorithm) {
    const std::filesystem::path place{path};
    std::error_code ignored;
    if (!std::filesystem::is_directory(place, ignored) && place.filename() != "manifest.json") {
        if (!algorithm.empty())
            throw InputError(path, "algorithm", "none, for the file is no pack", "'" + algorithm + "'");
        return read_picture(path);
    }
    std::vector<oracle::PackPictures> expected = oracle::expected_pictures(path);
    std::vector<std::string_view> names;
    std::string list;
    for (oracle::PackPictures& pictures : expected) {
        if (pictures.algorithm == algorithm || (algorithm.empty() && expected.size() == 1))
            return std::move(pictures.picture);
        names.push_back(pictures.algorithm);
        list += (list.empty() ? "" : ", ") + pictures.algorithm;
    }
    throw InputError(path, "algorithm", list, scenes::quoted_with_suggestion(algorithm, names));
}

// "color at 118 pixels, first at (17, 20)" for each kind that the tolerances do not accept.
std::string description(const Comparison& found) {
    std::string text;
    for (const oracle::KindReport& kind : found.kinds) {
        if (kind.beyond == 0) continue;
        text += (text.empty() ? "" : "; ") + std::string{oracle::name(kind.kind)} + " at " +
                std::to_string(kind.beyond) + " pixels, first at (" + std::to_string(kind.first_x) + ", " +
                std::to_string(kind.first_y) + ")";
        if (!kind.detail.empty()) text += ", " + kind.detail;
    }
    for (const oracle::Explanation& mistake : found.explanations)
        if (mistake.is_whole()) return text + "; all of it is " + mistake.description;
    return text;
}

// Returns the path of the written pictures, or the reason why they could not be written: a full disk must not hide the
// difference.
std::string leave_pictures(const Picture& candidate, const Reference& reference, const Comparison& found) {
    const auto folder = folder_for_pictures();
    const std::string side = (folder / (file_name(reference.name()) + ".side.png")).string();
    try {
        std::filesystem::create_directories(folder);
        scenes::write_image(side, {.color = oracle::side_by_side(reference.picture(), candidate, found)});
    } catch (const std::exception& error) {
        return std::string{"no picture could be left: "} + error.what();
    }
    return "reference, candidate and difference: " + side;
}

}  // namespace

Reference::Reference(const std::string& path, const std::string& algorithm)
    : Reference{picture_at(path, algorithm), algorithm.empty() ? path : path + "." + algorithm} {}
Reference::Reference(Picture picture, std::string name) : picture_{std::move(picture)}, name_{std::move(name)} {}

std::string size_text(const Picture& picture) {
    std::string text;
    for (const oracle::TargetImage& target : picture.targets)
        text += (text.empty() ? std::to_string(target.width) + "x" + std::to_string(target.height) + " " : ", ") +
                (target.part.empty() ? "" : target.part + " ") + target.name + " of " +
                std::to_string(target.channels) + " x " + std::string{oracle::name(target.code)};
    return text;
}

Checked check(const Picture& candidate, const Reference& reference, const Tolerances& tolerances) {
    Comparison found;
    try {
        found = compare(reference.picture(), candidate, tolerances);
    } catch (const InputError& error) {
        return {false, "cannot be compared with " + reference.name() + ": " + error.what()};
    }
    if (found.accepted)
        return {true, found.equal ? "equals " + reference.name() : "is accepted for " + reference.name()};
    return {false, "differs from " + reference.name() + ": " + description(found) + "; " +
                       leave_pictures(candidate, reference, found)};
}

}  // namespace v0_1
}  // namespace strata
