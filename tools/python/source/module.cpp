// source/module.cpp - defines the Python module, its exceptions, and its lists of names.
#include <strata/peeling/registry.h>
#include <strata/scenes/files/system_error.h>

#include "bindings.h"

namespace strata::python {

PYBIND11_MODULE(_strata, module) {
    py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
    py::register_exception<Refused>(module, "Refused", PyExc_RuntimeError);
    py::register_exception<SystemError>(module, "FileError", PyExc_OSError);
    module.attr("__version__") = std::string{version()};
    module.def("profiles", [] {
        std::vector<std::string> names;
        for (const DeviceProfile& profile : pipeline::builtin_profiles()) names.push_back(profile.name);
        return names;
    });
    module.def("algorithms", [] {
        std::vector<std::string> names;
        for (const Algorithm& algorithm : peeling::algorithms()) names.push_back(algorithm.name);
        return names;
    });
    bind_options(module);
    bind_scene(module);
    bind_results(module);
    bind_own_algorithm(module);
}

}  // namespace strata::python
