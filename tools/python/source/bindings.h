// source/bindings.h - the parts of the extension, and how values cross between the library and Python.
//
// Rule     The interpreter's lock is released while the library works. What holds 32-bit codes of one word a channel
//          (binary32, D24, D32F, integers) becomes an array that shares the library's memory; narrower codes are packed
//          once.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <strata/strata.h>

#include <memory>

namespace strata::python {

namespace py = pybind11;

// A read-only array in memory that `owner` keeps; no strides: one element behind the other.
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

// (height, width) or (height, width, channels) of the stored codes; samples are a further axis before the channels.
[[nodiscard]] py::array as_array(const std::shared_ptr<const Image>& image);
// An image that is a part of what `owner` holds.
template <class Owner>
[[nodiscard]] py::array as_array(const std::shared_ptr<Owner>& owner, const Image& image) {
    return as_array(std::shared_ptr<const Image>{owner, &image});
}
[[nodiscard]] py::array as_array(oracle::Target&& target);

// A picture of an array with one, three or four channels; `meaning` is "color", "depth" or "" (by the array's shape and
// type).
[[nodiscard]] Picture picture_of_array(const py::array& array, const std::string& meaning);

// RenderOptions from keywords, of which `origin` is the profile's; TypeError for a name that is none, InputError for a
// value that is none.
[[nodiscard]] RenderOptions options_of(const py::kwargs& keywords, DeviceProfile& profile);

void bind_scene(py::module_& module);
void bind_results(py::module_& module);

}  // namespace strata::python
