// source/options.cpp - converts keyword arguments to the settings of a frame, by the table of options.
#include <strata/scenes/nearest_name.h>
#include <strata/tools/request/complete.h>
#include <strata/tools/request/option_fields.h>

#include <algorithm>

#include "bindings.h"

namespace strata::python {

namespace {

using tools::OptionField;
using tools::OptionGroup;
using tools::PictureRequest;

// A scene has its own camera and is read before a frame has options.
bool is_of_frame(const OptionField& field) {
    return field.group != OptionGroup::reading && field.name != "camera" && field.name != "orbit";
}

// "drop_new" is "drop-new".
std::string word_of(const OptionField& field, std::string text) {
    const auto dashed = [](char c) { return c == '_' ? '-' : c; };
    for (const std::string& word : field.words)
        if (std::ranges::equal(word, text, {}, dashed, dashed)) return word;
    return text;
}

// The text of a value: True is "true", (0.1, 0.2, 0.3) is "0.1,0.2,0.3", and a size (640, 480) is "640x480".
std::string text_of(const OptionField& field, const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
    if (py::isinstance<py::str>(value)) return word_of(field, value.cast<std::string>());
    if (!py::isinstance<py::sequence>(value)) return py::str(value).cast<std::string>();
    std::string text;
    for (const py::handle part : value) {
        if (!text.empty()) text += field.name == "size" ? 'x' : ',';
        text += py::str(part).cast<std::string>();
    }
    return text;
}

const OptionField& field_of(const std::string& keyword) {
    const OptionField* field = tools::find_option(keyword);
    if (field != nullptr && is_of_frame(*field)) return *field;
    std::vector<std::string> names;
    for (const OptionField& other : tools::option_fields())
        if (is_of_frame(other)) names.push_back(other.name);
    for (std::string& name : names) std::ranges::replace(name, '-', '_');
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw py::type_error("expected an option of the frame, found " + scenes::quoted_with_suggestion(keyword, known));
}

PictureRequest request_of(const py::kwargs& keywords) {
    PictureRequest request;
    for (const auto& [key, value] : keywords) {
        const auto keyword = key.cast<std::string>();
        const OptionField& field = field_of(keyword);
        if (value.is_none()) continue;
        const std::string text = text_of(field, value);
        if (!field.set(request, text)) throw InputError("options", keyword, field.expected, "'" + text + "'");
    }
    if (!request.scene_options.alpha.empty())
        throw InputError("options", "alpha", "a number from 0 to 1", "alphas of materials");
    return request;
}

}  // namespace

Settings settings_of(const py::kwargs& keywords, DeviceProfile& profile) {
    PictureRequest request = request_of(keywords);
    if (const auto found = tools::option_conflict(request))
        throw InputError("options", found->option, found->sentence, "");
    if (request.origin) profile = with_origin(profile, *request.origin);
    tools::complete(request, profile);
    return {request.render};
}

}  // namespace strata::python
