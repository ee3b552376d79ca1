// tools/request/option_fields.h - the table of the options of a picture: name, group, values, help, and how a value is
// read from text and written as text.
//
// Rule     The options of the command line, the canonical command, help and completion, the state of a pack and the
//          keywords of Python are made from this table: a new option is one entry here and the code that obeys it. The
//          option "depth-format" is --depth-format on the command line, and depth_format in Python and in a pack.
//          text() is the shortest text that set() reads as the same value. The order of the table is that of a
//          canonical command (scenes/reference/reports.md 7).
// Tests    tests/tools/request/option_fields_test.cpp
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "tools/request/picture_request.h"

namespace strata::tools {

struct OptionField {
    std::string name;  // "depth-format"
    OptionGroup group{};
    std::string type;                  // "WIDTHxHEIGHT"; the words of a choice with | between them; empty for a flag
    std::string help;                  // its meaning and its default
    std::string expected;              // follows "expected" in a message
    std::vector<std::string> words{};  // of a choice
    bool is_usual = false;             // --help lists it without "all"
    bool is_flag = false;              // its texts are "true" and "false"
    // The algorithms that read it; empty if all do, or those for which is_read_by holds.
    std::vector<std::string> readers{};
    bool (*is_read_by)(const peeling::Algorithm&) = nullptr;
    // Reads a text; returns false, and leaves the field unchanged, if it is no value of this option.
    std::function<bool(PictureRequest&, std::string_view)> set{};
    // Empty for an optional value that is not asked for.
    std::function<std::string(const PictureRequest&)> text{};

    [[nodiscard]] bool is_default(const PictureRequest& request) const { return text(request) == text({}); }
    // A flag that is set unless it is turned off is --no-NAME on the command line.
    [[nodiscard]] bool is_on_by_default() const { return is_flag && text({}) == "true"; }
    // "--depth-format".
    [[nodiscard]] std::string option() const { return (is_on_by_default() ? "--no-" : "--") + name; }
};

[[nodiscard]] std::span<const OptionField> option_fields();

// The field of an option, by its name with - or _ between words; null if there is none.
[[nodiscard]] const OptionField* find_option(std::string_view name);

// True if the algorithm reads the option. A weighted tail reads --weight.
[[nodiscard]] bool reads(const peeling::Algorithm& algorithm, const OptionField& field, const PictureRequest& request);

// "expected less or greater, found 'lesser' (did you mean 'less'?)".
[[nodiscard]] std::string expectation(const OptionField& field, std::string_view found);

// The options that differ from their defaults, each followed by its value, as words of a command line, in the order of
// the table.
[[nodiscard]] std::vector<std::string> words_of(const PictureRequest& request, OptionGroup group);

}  // namespace strata::tools
