// tools/strata/manual/help_text.cpp - the text of --help: options in groups, the common ones first.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tools/request/option_fields.h"
#include "tools/strata/manual/manual.h"

namespace strata::tools {

namespace {

// Options that --help lists together: those of the table of options by their group, others by their name.
struct HelpSection {
    std::string title;
    HelpDetail shown;
    std::vector<OptionGroup> groups;
    std::vector<std::string> names;
};

// In the order of --help. Options without a section are listed under "Options".
const std::vector<HelpSection>& sections() {
    using enum OptionGroup;
    static const std::vector<HelpSection> all{
        {"What is drawn", HelpDetail::usual, {reading, origin, depth}, {"algorithm", "profile", "from"}},
        {"The view", HelpDetail::usual, {view, samples}, {}},
        {"Results",
         HelpDetail::usual,
         {measures},
         {"output", "format", "stats", "json", "csv", "digests", "expect", "channels", "report", "map", "region"}},
        {"Messages", HelpDetail::usual, {}, {"quiet", "verbose", "color"}},
        {"Depths and positions, rarely needed", HelpDetail::all, {depth}, {}},
        {"Algorithms, rarely needed", HelpDetail::all, {targets, order}, {"mistake"}},
        {"Single algorithms, rarely needed", HelpDetail::all, {algorithm}, {}},
        {"Samples of a pixel, rarely needed", HelpDetail::all, {shading, samples}, {}},
        {"Files of --from, rarely needed", HelpDetail::all, {}, {"files-in"}},
        {"How it is run, to the same bits", HelpDetail::all, {execution, resources, measures}, {"max-memory"}},
    };
    return all;
}

// The field of an option of the table; null for another option.
const OptionField* field_of(const CLI::Option& option) {
    const std::string name = typed_name(option);
    const auto is_its_name = [&](const OptionField& field) { return field.option() == name; };
    const auto found = std::ranges::find_if(option_fields(), is_its_name);
    return found == option_fields().end() ? nullptr : &*found;
}

const HelpSection* section_of(const CLI::Option& option) {
    const OptionField* const field = field_of(option);
    const auto lists = [&](const HelpSection& section) {
        if (field == nullptr)
            return std::ranges::any_of(section.names, [&](const auto& name) { return option.check_lname(name); });
        const bool is_usual = section.shown == HelpDetail::usual;
        return is_usual == field->is_usual && std::ranges::find(section.groups, field->group) != section.groups.end();
    };
    const auto found = std::ranges::find_if(sections(), lists);
    return found == sections().end() ? nullptr : &*found;
}

}  // namespace

std::string typed_name(const CLI::Option& option) {
    if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
    return option.get_snames().empty() ? "" : "-" + option.get_snames().front();
}

std::vector<CLI::App*> commands_of(CLI::App& root) {
    return root.get_subcommands([](CLI::App*) { return true; });
}

std::string help_of(CLI::App& command, HelpDetail shown) {
    std::size_t hidden = 0;
    for (CLI::Option* option : command.get_options()) {
        if (option->get_positional() || option->get_group().empty()) continue;
        const HelpSection* section = section_of(*option);
        if (section == nullptr) continue;
        const bool is_hidden = section->shown == HelpDetail::all && shown == HelpDetail::usual;
        option->group(is_hidden ? "" : section->title);
        hidden += is_hidden ? 1 : 0;
    }
    const bool is_root = command.get_parent() == nullptr;
    std::string text = command.help(is_root ? "" : "strata") + '\n';
    if (hidden > 0)
        text += fmt::format("{} rare options are left out here: strata {} --help all\n", hidden, command.get_name());
    return text;
}

}  // namespace strata::tools
