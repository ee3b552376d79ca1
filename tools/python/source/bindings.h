// source/bindings.h - the parts of the Python extension module, and the conversion of values between the library and
// Python.
//
// Rule     The global interpreter lock is released while the library works. Targets whose codes have 32 bits per
//          channel (binary32, D24, D32F, integers) become arrays that share the library's memory; narrower codes are
//          copied once.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <strata/strata.h>

#include <memory>

namespace strata::python {

namespace py = pybind11;

// A read-only array in memory that `owner` keeps alive; without strides the elements are contiguous.
template <class Owner>
[[nodiscard]] py::array shared_array(const py::dtype& type, std::vector<py::ssize_t> shape,
                                     std::vector<py::ssize_t> strides, const void* first,
                                     const std::shared_ptr<Owner>& owner) {
    using Held = std::shared_ptr<Owner>;
    const py::capsule keeper(new Held{owner}, [](void* held) { delete static_cast<Held*>(held); });
    py::array array(type, std::move(shape), std::move(strides), first, keeper);
    array.attr("flags").attr("writeable") = false;
    return array;
}

// An array of the stored codes with the shape (height, width) or (height, width, channels); multisampled targets have a
// further axis before the channels.
[[nodiscard]] py::array as_array(const std::shared_ptr<const Image>& image);
// An array of an image that is a member of `owner`.
template <class Owner>
[[nodiscard]] py::array as_array(const std::shared_ptr<Owner>& owner, const Image& image) {
    return as_array(std::shared_ptr<const Image>{owner, &image});
}
[[nodiscard]] py::array as_array(oracle::TargetImage&& target);

// A picture from an array with one, three or four channels; `meaning` is "color", "depth", or "" to derive it from the
// array's shape and type.
[[nodiscard]] Picture picture_of_array(const py::array& array, const std::string& meaning);

// Converts keyword arguments; `origin` is set in the profile. Throws TypeError for an unknown keyword and InputError
// for an invalid value.
[[nodiscard]] RenderOptions options_of_keywords(const py::kwargs& keywords, DeviceProfile& profile);

// Calls the library with the interpreter lock released. The result is shared, so arrays can refer to its memory.
template <class Work>
auto unlocked(const Work& work) {
    py::gil_scoped_release without_lock;
    return std::make_shared<decltype(work())>(work());
}

void bind_options(py::module_& module);
void bind_own_algorithm(py::module_& module);
void bind_scene(py::module_& module);
void bind_results(py::module_& module);

}  // namespace strata::python
