// scenes/files/load_module.cpp - finds the shared library of a module and takes its function.
#include "scenes/files/load_module.h"

#include <dlfcn.h>

#include <filesystem>
#include <vector>

#include "scenes/files/system_error.h"

namespace strata::scenes {
namespace {

constexpr const char* installed_folder = STRATA_MODULE_FOLDER;  // from the program's folder, when installed

// dlerror() answers null where nothing has failed since it was last asked.
std::string last_reason() {
    const char* reason = ::dlerror();
    return reason != nullptr ? reason : "no reason given";
}

// Of the shared library that this code is a part of; empty if that is not known. A program is known by the name that it was called
// by, which may be relative to another folder: only whole paths count.
std::filesystem::path folder_of_this_code() {
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&last_reason), &info) == 0 || info.dli_fname == nullptr) return {};
    if (info.dli_fname[0] != '/') return {};
    std::error_code ignored;
    return std::filesystem::canonical(info.dli_fname, ignored).parent_path();
}

// Where the module may be. The current folder and the search path are left out, so that no stray library is run.
std::vector<std::filesystem::path> places(const char* file) {
    std::error_code ignored;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    std::vector<std::filesystem::path> places{program / file, program / installed_folder / file};
    const auto library = folder_of_this_code();
    if (library.empty() || library == program) return places;
    places.push_back(library / file);
    places.push_back(library / "strata" / file);
    return places;
}

}  // namespace

// A function that the program already holds (tests link the module) comes first.
void* module_function(const ModuleFile& module) {
    if (void* const linked = ::dlsym(RTLD_DEFAULT, module.symbol)) return linked;
    std::error_code ignored;
    std::string looked_in;
    for (const auto& path : places(module.file)) {
        looked_in += (looked_in.empty() ? "" : " or ") + path.parent_path().lexically_normal().string();
        if (!std::filesystem::exists(path, ignored)) continue;
        void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // for as long as the process lives
        void* const function = library != nullptr ? ::dlsym(library, module.symbol) : nullptr;
        // A library that is there and does not load is an error of its own: a second place would hide it.
        if (function == nullptr) throw SystemError(path.string(), module.task, last_reason());
        return function;
    }
    throw SystemError(module.file, module.task, "expected in " + looked_in + ", found in neither; " + module.is_needed);
}

void check_version(const ModuleFile& module, const std::string& version) {
    if (version != STRATA_VERSION)
        throw SystemError(module.file, module.task, "expected version " STRATA_VERSION ", found " + version);
}

}  // namespace strata::scenes
