// tools/oracle/folders/picture_folders.cpp - lists the pictures of two folders and pairs them (picture_folders.h).
#include "tools/oracle/folders/picture_folders.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "rasterizer/base/input_error.h"
#include "scenes/file_ending.h"
#include "scenes/files/image_decode.h"

namespace strata::oracle {

namespace {

namespace fs = std::filesystem;

bool is_picture(const std::string& path) {
    return scenes::has_ending(path, ".exr") || scenes::has_ending(path, ".npy") || scenes::reader_of(path) != nullptr;
}

// The paths of all files in the folder, sorted. The folder `other` in it is left out.
std::vector<std::string> files_in(const std::string& folder, const std::string& other) {
    std::vector<std::string> paths;
    try {
        const bool are_same = fs::equivalent(folder, other);
        for (auto at = fs::recursive_directory_iterator(folder); at != fs::recursive_directory_iterator(); ++at) {
            const bool is_hidden = at->path().filename().string().starts_with('.');
            if (at->is_directory() && (is_hidden || (!are_same && fs::equivalent(at->path(), other))))
                at.disable_recursion_pending();
            else if (!is_hidden && at->is_regular_file())
                paths.push_back(at->path().lexically_relative(folder).generic_string());
        }
    } catch (const fs::filesystem_error& error) {
        throw InputError(folder, "cannot be listed: " + error.code().message());
    }
    std::ranges::sort(paths);
    return paths;
}

// Without patterns the name of a further baseline gets the file's ending, as all names have it.
std::string name_with_ending(std::string name, const std::string& path) {
    const std::string ending = fs::path(path).extension().string();
    return name.ends_with(ending) ? name : name + ending;
}

class PairedNames {
  public:
    PairedNames(const PictureNames& names, bool is_one_folder) : names_{names}, is_one_folder_{is_one_folder} {}

    void add_reference(const std::string& folder, const std::string& path) {
        if (is_one_folder_ && names_.candidate && name_in(path, *names_.candidate)) return;
        for (const NamePattern& pattern : names_.baselines)
            if (const auto name = name_in(path, pattern)) {
                taken_.insert(key(folder, path));
                further_[names_.reference ? *name : name_with_ending(*name, path)].push_back(path);
                return;
            }
        if (const auto name = name_of(folder, path, names_.reference)) add(references_, folder, *name, path);
    }

    void add_candidate(const std::string& folder, const std::string& path) {
        const auto fits = [&](const NamePattern& pattern) { return name_in(path, pattern).has_value(); };
        if (is_one_folder_ && !names_.candidate && std::ranges::any_of(names_.baselines, fits)) return;
        if (const auto name = name_of(folder, path, names_.candidate)) add(candidates_, folder, *name, path);
    }

    [[nodiscard]] PairedFolders pairs() const {
        std::map<std::string, NamedPictures> all;
        for (const auto& [name, path] : references_) all[name].references.push_back(path);
        for (const auto& [name, paths] : further_)
            all[name].references.insert(all[name].references.end(), paths.begin(), paths.end());
        for (const auto& [name, path] : candidates_) all[name].candidate = path;
        PairedFolders found;
        for (const std::string& file : left_out_) found.left_out += taken_.contains(file) ? 0 : 1;
        for (auto& [name, pictures] : all) {
            pictures.name = name;
            found.pictures.push_back(std::move(pictures));
        }
        return found;
    }

  private:
    // Of a file: one for both folders if they are one.
    [[nodiscard]] std::string key(const std::string& folder, const std::string& path) const {
        return is_one_folder_ ? path : folder + '/' + path;
    }

    std::optional<std::string> name_of(const std::string& folder, const std::string& path,
                                       const std::optional<NamePattern>& pattern) {
        const auto name = pattern ? name_in(path, *pattern) : is_picture(path) ? std::optional{path} : std::nullopt;
        if (!name) left_out_.insert(key(folder, path));
        return name;
    }

    void add(std::map<std::string, std::string>& to, const std::string& folder, const std::string& name,
             const std::string& path) {
        const auto [before, is_new] = to.emplace(name, path);
        taken_.insert(key(folder, path));
        if (!is_new) throw InputError(folder, "names", "one picture named " + name, before->second + " and " + path);
    }

    const PictureNames& names_;
    std::map<std::string, std::string> references_, candidates_;
    std::map<std::string, std::vector<std::string>> further_;
    bool is_one_folder_;
    std::set<std::string> left_out_, taken_;
};

}  // namespace

PairedFolders pair_folders(const std::string& reference, const std::string& candidate, const PictureNames& names) {
    std::error_code unread;
    PairedNames paired(names, fs::equivalent(reference, candidate, unread));
    for (const std::string& path : files_in(reference, candidate)) paired.add_reference(reference, path);
    for (const std::string& path : files_in(candidate, reference)) paired.add_candidate(candidate, path);
    PairedFolders found = paired.pairs();
    if (found.pictures.empty())
        throw InputError(reference, "names", "a picture in one of the two folders",
                         found.left_out == 0 ? "no file" : std::to_string(found.left_out) + " other files");
    return found;
}

}  // namespace strata::oracle
