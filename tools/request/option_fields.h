// tools/request/option_fields.h - the table of the options of a picture: name, group, values, help, and how a value is
// read from text and written as text.
//
// Rule     The options of the command line, the canonical command, help and completion, the state of a pack, the
//          simplifications of strata reduce, the rows of --stats, the browser's page, the keywords of Python and the
//          names of the C++ library are made from this table: a new option is one entry here and the code that obeys
//          it. The option "depth-format" is --depth-format on the command line and depth_format elsewhere.
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
    // Copies the option's value.
    std::function<void(PictureRequest& to, const PictureRequest& from)> copy{};

    [[nodiscard]] bool is_default(const PictureRequest& request) const { return text(request) == text({}); }
    // A flag that is set unless it is turned off is --no-NAME on the command line.
    [[nodiscard]] bool is_on_by_default() const { return is_flag && text({}) == "true"; }
    // "--depth-format".
    [[nodiscard]] std::string option() const { return (is_on_by_default() ? "--no-" : "--") + name; }
    // "depth_format".
    [[nodiscard]] std::string key() const;
};

[[nodiscard]] std::span<const OptionField> option_fields();

// Adds an entry to the table while the object exists, which is then the only one. For tests.
class AddedOption {
  public:
    explicit AddedOption(OptionField field);
    ~AddedOption();
    AddedOption(const AddedOption&) = delete;
    AddedOption& operator=(const AddedOption&) = delete;
};

// The field of an option, by its name with - or _ between words; null if there is none.
[[nodiscard]] const OptionField* find_option(std::string_view name);

// True if the algorithm reads the option. A weighted tail reads --weight.
[[nodiscard]] bool reads(const peeling::Algorithm& algorithm, const OptionField& field, const PictureRequest& request);

// Sets the option of that name. Throws InputError, with `source` as its file, for a name that is not among `known` and
// for a text that is no value of the option.
void set_option(
    PictureRequest& request, std::string_view name, std::string_view text, const std::string& source,
    bool (*known)(const OptionField&) = [](const OptionField&) { return true; });

// The text of a value that has several parts, such as (640, 480), or one: "640x480". A word may have _ for -.
[[nodiscard]] std::string text_of_parts(const OptionField& field, const std::vector<std::string>& parts);

// The bits of a picture depend on the option, and neither the reading of the scene nor the view does.
[[nodiscard]] bool is_of_frame(const OptionField& field);

// "expected less or greater, found 'lesser' (did you mean 'less'?)".
[[nodiscard]] std::string expectation(const OptionField& field, std::string_view found);

// The options that differ from their defaults, each followed by its value, as words of a command line, in the order of
// the table.
[[nodiscard]] std::vector<std::string> words_of(const PictureRequest& request, OptionGroup group);
[[nodiscard]] std::vector<std::string> words_of(const PictureRequest& request);  // of all groups

}  // namespace strata::tools
