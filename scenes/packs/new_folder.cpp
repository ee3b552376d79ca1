#include "scenes/packs/new_folder.h"

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace strata::scenes {

NewFolder::NewFolder(const std::string& path) : path_{path} {
    std::error_code error;
    if (std::filesystem::exists(path_, error) && !std::filesystem::is_empty(path_, error))
        throw InputError(path, "folder", "one that does not exist or is empty", "something");
    std::filesystem::create_directories(path_);
}

NewFolder::~NewFolder() {
    std::error_code ignored;
    if (!keep_) std::filesystem::remove_all(path_, ignored);
}

void NewFolder::write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    write_file(file.string(), bytes);
}

}  // namespace strata::scenes
