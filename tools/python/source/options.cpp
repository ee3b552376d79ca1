// source/options.cpp - converts keyword arguments to the options of a frame, by the table of options.
#include <strata/scenes/nearest_name.h>
#include <strata/tools/request/option_fields.h>

#include <map>

#include "bindings.h"

namespace strata::python {

namespace {

using tools::OptionField;

// A scene has its own camera and is read before a frame has options.
bool is_keyword(const OptionField& field) {
    return field.group != tools::OptionGroup::reading && field.name != "camera" && field.name != "orbit";
}

// True is "true", and parts of a sequence are those of a text: (640, 480) is "640x480".
std::string text_of(const OptionField& field, const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
    std::vector<std::string> parts;
    if (py::isinstance<py::str>(value) || !py::isinstance<py::sequence>(value))
        parts.push_back(py::str(value).cast<std::string>());
    else
        for (const py::handle part : value) parts.push_back(py::str(part).cast<std::string>());
    return tools::text_of_parts(field, parts);
}

const OptionField& field_of(const std::string& keyword) {
    const OptionField* field = tools::find_option(keyword);
    if (field != nullptr && is_keyword(*field)) return *field;
    std::vector<std::string> names;
    for (const OptionField& other : tools::option_fields())
        if (is_keyword(other)) names.push_back(other.key());
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw py::type_error("expected an option of the frame, found " + scenes::quoted_with_suggestion(keyword, known));
}

NamedOptions named_options(const py::kwargs& keywords) {
    NamedOptions named;
    for (const auto& [key, value] : keywords) {
        const auto keyword = key.cast<std::string>();
        const OptionField& field = field_of(keyword);
        if (!value.is_none()) named.emplace_back(keyword, text_of(field, value));
    }
    return named;
}

// The options of a command line that are the same.
std::vector<std::string> command_words(const py::kwargs& keywords) {
    tools::PictureRequest request;
    for (const auto& [name, text] : named_options(keywords)) tools::set_option(request, name, text, "options");
    return tools::words_of(request);
}

}  // namespace

RenderOptions options_of_keywords(const py::kwargs& keywords, DeviceProfile& profile) {
    return options_of(named_options(keywords), profile);
}

void bind_options(py::module_& module) {
    module.def("_command_words", command_words);
    module.def("_option_words", [] {
        std::map<std::string, std::vector<std::string>> words;
        for (const OptionField& field : tools::option_fields())
            if (is_keyword(field))
                words[field.key()] = field.is_flag ? std::vector<std::string>{"true", "false"} : field.words;
        return words;
    });
}

}  // namespace strata::python
