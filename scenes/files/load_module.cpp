// scenes/files/load_module.cpp - finds the shared library of a module and its function; for the image module it first
// checks that there are threads and address space for its dependencies.
#include "scenes/files/load_module.h"

#include <dlfcn.h>
#include <sys/mman.h>

#include <filesystem>
#include <vector>

#include "rasterizer/base/thread_loop.h"
#include "scenes/files/system_error.h"

namespace strata::scenes {
namespace {

constexpr const char* installed_folder = STRATA_MODULE_FOLDER;  // relative to the program's folder, when installed

// dlerror() returns null if nothing has failed since the last call.
std::string last_reason() {
    const char* reason = ::dlerror();
    return reason != nullptr ? reason : "no reason given";
}

// The folder of the shared library that contains this code; empty if unknown. For a program dladdr gives the name it
// was called by, which may be relative to another folder, so only absolute paths are used.
std::filesystem::path folder_of_this_code() {
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&last_reason), &info) == 0 || info.dli_fname == nullptr) return {};
    if (info.dli_fname[0] != '/') return {};
    std::error_code ignored;
    return std::filesystem::canonical(info.dli_fname, ignored).parent_path();
}

// The folders in which the module may be. The current folder and the search path are left out, so that no foreign
// library is run.
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

// If the program already contains the function, because it is linked with the module as some tests are, that one is
// used.
void* module_function(const ModuleFile& module) {
    if (void* const linked = ::dlsym(RTLD_DEFAULT, module.symbol)) return linked;
    std::error_code ignored;
    std::string looked_in;
    for (const auto& path : places(module.file)) {
        looked_in += (looked_in.empty() ? "" : " or ") + path.parent_path().lexically_normal().string();
        if (!std::filesystem::exists(path, ignored)) continue;
        void* const library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // never closed
        void* const function = library != nullptr ? ::dlsym(library, module.symbol) : nullptr;
        // A library that exists but does not load is an error of its own; trying the next folder would hide it.
        if (function == nullptr) throw SystemError(path.string(), module.task, last_reason());
        return function;
    }
    throw SystemError(module.file, module.task, "expected in " + looked_in + ", found in neither; " + module.is_needed);
}

void check_version(const ModuleFile& module, const std::string& version) {
    if (version != STRATA_VERSION)
        throw SystemError(module.file, module.task, "expected version " STRATA_VERSION ", found " + version);
}

namespace {

constexpr ModuleFile image_file{STRATA_IMAGE_MODULE, image_module_symbol, "load the image module",
                                "PNG and JPEG need it"};

// Reserves the address space and frees it again; it is never touched.
bool has_address_space(std::size_t bytes) {
    void* const place = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return place != MAP_FAILED && ::munmap(place, bytes) == 0;
}

// OpenImageIO's libraries start threads while they are loaded, and the process aborts or hangs if one cannot be
// created: four threads of its log library (counted, with OpenImageIO 2.4 of Debian 12). A signal also ends the process
// if the address space is less than what the libraries need beyond their own 400 MiB (measured with limits in steps of
// a megabyte).
void require_room() {
    constexpr int wanted = 4;
    constexpr std::size_t usual_stack = std::size_t{8} << 20, libraries = std::size_t{400} << 20;
    if (const int found = available_threads(wanted, usual_stack); found < wanted)
        throw SystemError(image_file.file, image_file.task,
                          "expected " + std::to_string(wanted) + " threads for the image library, the system gives " +
                              std::to_string(found));
    const std::size_t bytes = libraries + static_cast<std::size_t>(wanted) * usual_stack;
    if (!has_address_space(bytes))
        throw SystemError(image_file.file, image_file.task,
                          "expected " + std::to_string(bytes >> 20) +
                              " MiB of address space for the image library, the system gives less");
}

const ImageModule& load_image_module() {
    require_room();
    // POSIX allows converting dlsym()'s object pointer to a function pointer.
    const ImageModule& module = *reinterpret_cast<ImageModuleEntry>(module_function(image_file))();
    check_version(image_file, module.version);
    return module;
}

}  // namespace

const ImageModule& image_module() {
    // Once per process and thread-safe; after a failure the next call tries again.
    static const ImageModule& module = load_image_module();
    return module;
}

}  // namespace strata::scenes
