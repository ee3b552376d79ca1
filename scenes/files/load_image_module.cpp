// scenes/files/load_image_module.cpp - the image module's table of functions, once there is room for what it brings along.
#include <sys/mman.h>

#include "rasterizer/base/thread_loop.h"
#include "scenes/files/load_module.h"
#include "scenes/files/system_error.h"

namespace strata::scenes {
namespace {

constexpr ModuleFile file{STRATA_IMAGE_MODULE, image_module_symbol, "load the image module", "PNG and JPEG need it"};

// Asked for and given back: nothing of it is ever touched.
bool has_address_space(std::size_t bytes) {
    void* const place = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return place != MAP_FAILED && ::munmap(place, bytes) == 0;
}

// OpenImageIO's libraries start threads as they are loaded, and the process aborts or hangs where one is refused: four of
// its log library (found by counting them, OpenImageIO 2.4 of Debian 12). It ends by a signal, too, where the address
// space runs out behind the libraries' own 400 MiB (found by limiting it, megabyte by megabyte).
void require_room() {
    constexpr int wanted = 4;
    constexpr std::size_t usual_stack = std::size_t{8} << 20, libraries = std::size_t{400} << 20;
    if (const int found = threads_to_be_had(wanted, usual_stack); found < wanted)
        throw SystemError(file.file, file.task,
                          "expected " + std::to_string(wanted) + " threads for the image library, the system gives " +
                              std::to_string(found));
    const std::size_t bytes = libraries + static_cast<std::size_t>(wanted) * usual_stack;
    if (!has_address_space(bytes))
        throw SystemError(file.file, file.task,
                          "expected " + std::to_string(bytes >> 20) +
                              " MiB of address space for the image library, the system gives less");
}

const ImageModule& load() {
    require_room();
    // POSIX lets an object pointer of dlsym() be a function's.
    const ImageModule& module = *reinterpret_cast<ImageModuleEntry>(module_function(file))();
    check_version(file, module.version);
    return module;
}

}  // namespace

const ImageModule& image_module() {
    // Once a process, and safe from several threads; a failure is tried again by the next call.
    static const ImageModule& module = load();
    return module;
}

}  // namespace strata::scenes
