// source/scene.cpp - Python scenes from files, built-in scenes and arrays. Arrays are read in place, with any strides
// between rows.
#include "bindings.h"

namespace strata::python {

namespace {

using Floats = py::array_t<float, 0>;

// An array with rows of `size` floats. The floats of a row must be contiguous, the rows need not be.
VertexArray vertices_of(const char* field, const Floats& array, py::ssize_t size) {
    const bool fits = array.ndim() == 2 && array.shape(1) == size && array.strides(1) == sizeof(float) &&
                      (array.shape(0) < 2 || array.strides(0) >= size * py::ssize_t{sizeof(float)});
    if (!fits)
        throw InputError(
            "triangles", field,
            "an array of float32 and shape (vertices, " + std::to_string(size) + ") whose rows lie in order",
            "shape " + py::str(array.attr("shape")).cast<std::string>() + ", strides " +
                py::str(array.attr("strides")).cast<std::string>());
    return {array.data(), static_cast<std::size_t>(array.shape(0)), static_cast<std::size_t>(array.strides(0))};
}

Primitive primitive_of(const std::string& name) {
    if (name == "triangles") return Primitive::triangles;
    if (name == "lines") return Primitive::lines;
    if (name == "points") return Primitive::points;
    throw InputError("triangles", "primitive", "triangles, lines or points", "'" + name + "'");
}

pipeline::ColorSpace space_of(const std::string& name) {
    if (name == "encoded") return pipeline::ColorSpace::encoded;
    if (name == "linear") return pipeline::ColorSpace::linear;
    throw InputError("scene", "color_space", "encoded or linear", "'" + name + "'");
}

void add(Scene& scene, const Floats& positions, const std::optional<Floats>& colors,
         const std::optional<py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>>& indices,
         const std::array<float, 4>& color, bool transparent, bool double_sided,
         const std::optional<std::array<double, 16>>& model, const std::string& name, const std::string& primitive) {
    Triangles triangles{.name = name, .color = color, .is_transparent = transparent, .is_double_sided = double_sided};
    triangles.positions = vertices_of("positions", positions, 3);
    if (colors) triangles.colors = vertices_of("colors", *colors, 4);
    if (indices) triangles.indices = {indices->data(), static_cast<std::size_t>(indices->size())};
    triangles.model = model;
    triangles.primitive = primitive_of(primitive);
    scene.add(triangles);
}

}  // namespace

void bind_scene(py::module_& module) {
    py::class_<Scene>(module, "Scene", "What is drawn, and the camera.")
        .def(py::init([](const std::string& color_space) { return std::make_unique<Scene>(space_of(color_space)); }),
             py::kw_only(), py::arg("color_space") = "encoded")
        .def(py::init([](const std::string& spec, bool light, const std::string& color_space) {
                 SceneOptions options;
                 options.light = light;
                 options.color_space = space_of(color_space);
                 py::gil_scoped_release unlocked;
                 return std::make_unique<Scene>(spec, options);
             }),
             py::arg("spec"), py::kw_only(), py::arg("light") = true, py::arg("color_space") = "encoded")
        .def("_add", &add)
        .def(
            "look",
            [](Scene& scene, const std::array<double, 16>& view, const std::array<double, 16>& projection) {
                View both;
                both.view = matrix_of(view);
                both.projection = matrix_of(projection);
                scene.look(both);
            },
            py::arg("view"), py::arg("projection"), "Both matrices by columns.")
        .def(
            "look_at",
            [](Scene& scene, const std::array<double, 3>& eye, const std::array<double, 3>& center,
               const std::array<double, 3>& up, double fovy, double near, double far) {
                const auto vector = [](const std::array<double, 3>& v) { return Vec3d{v[0], v[1], v[2]}; };
                scene.look_at({vector(eye), vector(center), vector(up), fovy, near, far});
            },
            py::arg("eye"), py::arg("center") = std::array<double, 3>{0, 0, 0},
            py::arg("up") = std::array<double, 3>{0, 1, 0}, py::kw_only(), py::arg("fovy") = 45, py::arg("near") = 0.1,
            py::arg("far") = 100, "As gluLookAt and gluPerspective.")
        .def(
            "orbit", [](Scene& scene, double azimuth, double elevation) { scene.orbit(azimuth, elevation); },
            py::arg("azimuth"), py::arg("elevation"), "Sees the whole scene; degrees.")
        .def_property_readonly("warnings", [](const Scene& scene) { return scene.warnings(); })
        .def_property_readonly("triangles", [](const Scene& scene) {
            std::size_t count = 0;
            for (const auto& instance : scene.list().instances)
                count += scene.list().meshes[instance.mesh].indices.size() / 3;
            return count;
        });
}

}  // namespace strata::python
