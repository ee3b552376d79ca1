// scenes/inside_folder.cpp - the two checks of inside_folder.h: by the text of a name, and by its resolved path.
#include "scenes/inside_folder.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "rasterizer/base/input_error.h"

namespace strata::scenes {

namespace fs = std::filesystem;

bool leaves_by_name(const fs::path& name) {
    return name.empty() || name.is_absolute() || name.native().find('\0') != std::string::npos ||
           std::find(name.begin(), name.end(), fs::path{".."}) != name.end();
}

InsideFolder inside_folder(const fs::path& folder, const fs::path& name) {
    using enum InsideFolder::PathStatus;
    if (leaves_by_name(name)) return {name_leaves};
    // Both paths are canonical, with links resolved, so that a link out of the folder is detected.
    std::error_code error;
    const fs::path home = fs::canonical(folder.empty() ? fs::path{"."} : folder, error);
    const fs::path path = error ? fs::path{} : fs::canonical(home / name, error);
    if (error) return {nothing};
    const bool is_inside = std::mismatch(home.begin(), home.end(), path.begin(), path.end()).first == home.end();
    return is_inside ? InsideFolder{inside, path} : InsideFolder{link_leaves};
}

std::string name_in_other_case(const fs::path& folder, const fs::path& name) {
    const auto folded = [](const fs::path& part) {
        std::string text = part.string();
        std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        return text;
    };
    std::error_code error;
    fs::path known;
    for (const fs::path& part : name) {
        std::vector<fs::path> alike;
        for (fs::directory_iterator entry{folder.empty() ? "." : folder / known, error}, end; !error && entry != end;
             entry.increment(error))
            if (folded(entry->path().filename()) == folded(part)) alike.push_back(entry->path().filename());
        if (alike.empty()) return "";
        known /= *std::ranges::min_element(alike);  // the order of a folder is not defined
    }
    return inside_folder(folder, known).status == InsideFolder::PathStatus::inside ? known.string() : "";
}

std::string path_inside(const std::string& folder, const std::string& name, const std::string& file,
                        const std::string& location) {
    using enum InsideFolder::PathStatus;
    const InsideFolder found = inside_folder(folder, name);
    const std::string expected = "a file in the folder " + (folder.empty() ? "." : folder);
    switch (found.status) {
        case inside: break;
        case nothing: throw InputError(file, location, expected, "'" + name + "', which is not there");
        case name_leaves: throw InputError(file, location, expected, "'" + name + "', which leaves it");
        case link_leaves: throw InputError(file, location, expected, "'" + name + "', a link that leaves it");
    }
    return (fs::path{folder} / name).string();
}

}  // namespace strata::scenes
