// source/options.cpp - converts keyword arguments to the settings of a frame; each name and each value is checked.
#include <strata/rasterizer/base/enum_values.h>
#include <strata/scenes/nearest_name.h>

#include <functional>
#include <map>
#include <optional>

#include "bindings.h"

namespace strata::python {

namespace {

template <class Enum>
Enum named(const std::string& field, const py::handle& value) {
    const auto text = value.cast<std::string>();
    if (const auto found = enum_named<Enum>(text)) return *found;
    std::string list;
    for (const std::string_view name : enum_names<Enum>) (list += list.empty() ? "" : ", ") += name;
    throw InputError("options", field, list,
                     scenes::quoted_with_suggestion(text, {enum_names<Enum>.begin(), enum_names<Enum>.end()}));
}

// What keywords can change: the options of a frame and its samples, and the origin of the device's window.
struct KeywordSettings {
    RenderOptions options;
    Multisampling sampling;
    bool shades_pixels = false;
    std::optional<rasterizer::Interpolation> interpolate;
    std::optional<pipeline::Origin> origin;
};
using Setter = std::function<void(KeywordSettings&, const std::string& field, const py::handle& value)>;

template <auto member>
Setter number() {
    return [](KeywordSettings& settings, const std::string&, const py::handle& value) {
        using Number = std::remove_reference_t<decltype(settings.options.*member)>;
        settings.options.*member = value.cast<Number>();
    };
}
template <auto member, class Enum>
Setter choice() {
    return [](KeywordSettings& settings, const std::string& field, const py::handle& value) {
        settings.options.*member = named<Enum>(field, value);
    };
}

const std::map<std::string, Setter>& setters() {
    using O = RenderOptions;
    static const std::map<std::string, Setter> all{
        {"width", number<&O::width>()},
        {"height", number<&O::height>()},
        {"depth", choice<&O::depth, pipeline::DepthFormat>()},
        {"depth_path", choice<&O::depth_path, rasterizer::DepthPath>()},
        {"reference_path", choice<&O::reference_path, rasterizer::DepthPath>()},
        {"quantize_reference", number<&O::quantize_reference>()},
        {"color_format", choice<&O::color_format, pipeline::Format>()},
        {"result_format", choice<&O::result_format, pipeline::Format>()},
        {"back_format", choice<&O::back_format, pipeline::Format>()},
        {"alpha", number<&O::alpha>()},
        {"max_passes", number<&O::max_passes>()},
        {"formulation", choice<&O::formulation, pipeline::Formulation>()},
        {"execution", choice<&O::execution, pipeline::Execution>()},
        {"fragment_memory", number<&O::fragment_memory>()},
        {"tile_size", number<&O::tile_size>()},
        {"threads", number<&O::threads>()},
        {"simd", choice<&O::simd, Simd>()},
        {"effects", choice<&O::effects, pipeline::Effects>()},
        {"audit", number<&O::audit>()},
        {"background",
         [](KeywordSettings& settings, const std::string&, const py::handle& value) {
             const auto c = value.cast<std::array<float, 4>>();
             settings.options.background = {c[0], c[1], c[2], c[3]};
         }},
        {"samples",
         [](KeywordSettings& settings, const std::string& field, const py::handle& value) {
             const int samples = settings.sampling.samples = value.cast<int>();
             if (samples != 1 && samples != 2 && samples != 4 && samples != 8)
                 throw InputError("options", field, "1, 2, 4 or 8", std::to_string(samples));
         }},
        {"shading",
         [](KeywordSettings& settings, const std::string& field, const py::handle& value) {
             const auto text = value.cast<std::string>();
             if (text != "sample" && text != "pixel")
                 throw InputError("options", field, "sample or pixel", "'" + text + "'");
             settings.shades_pixels = text == "pixel";
         }},
        {"interpolate",
         [](KeywordSettings& settings, const std::string& field, const py::handle& value) {
             const auto where = named<rasterizer::Interpolation>(field, value);
             if (where == rasterizer::Interpolation::sample)
                 throw InputError("options", field, "centre or centroid", "'sample'");
             settings.interpolate = where;
         }},
        {"origin", [](KeywordSettings& settings, const std::string& field,
                      const py::handle& value) { settings.origin = named<pipeline::Origin>(field, value); }},
    };
    return all;
}

}  // namespace

Settings settings_of(const py::kwargs& keywords, DeviceProfile& profile) {
    KeywordSettings settings;
    for (const auto& [key, value] : keywords) {
        const auto name = key.cast<std::string>();
        const auto found = setters().find(name);
        if (found == setters().end()) {
            std::vector<std::string_view> names;
            for (const auto& [known, setter] : setters()) names.push_back(known);
            throw py::type_error("expected an option of the frame, found " +
                                 scenes::quoted_with_suggestion(name, names));
        }
        try {
            found->second(settings, name, value);
        } catch (const py::cast_error&) {
            throw InputError("options", name, "a value of its type", py::repr(value).cast<std::string>());
        }
    }
    if (settings.origin) profile = with_origin(profile, *settings.origin);
    if (settings.interpolate && !settings.shades_pixels)
        throw InputError("options", "interpolate", "shading='pixel' with it", "none");
    if (settings.shades_pixels)
        settings.options.raster.interpolation = settings.interpolate.value_or(rasterizer::Interpolation::centre);
    return {settings.options, settings.sampling};
}

}  // namespace strata::python
