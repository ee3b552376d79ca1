#include <algorithm>

#include "tools/strata/manual/manual.h"

namespace strata::tools {

namespace {

// Escapes text for troff: a line that begins with a dot or a quote would be a request, and a bare minus would become a
// hyphen.
std::string troff(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        const bool begins = escaped.empty() || escaped.back() == '\n';
        if (begins && (c == '.' || c == '\'')) escaped += "\\&";
        if (c == '\\')
            escaped += "\\e";
        else if (c == '-')
            escaped += "\\-";
        else
            escaped += c;
    }
    return escaped;
}

std::string page_name(const CLI::App& root, const CLI::App& command) {
    return &root == &command ? root.get_name() : root.get_name() + "-" + command.get_name();
}

std::string option_entry(const CLI::Option& option) {
    std::string names;
    for (const std::string& name : option.get_snames()) names += (names.empty() ? "" : ", ") + ("-" + name);
    for (const std::string& name : option.get_lnames()) names += (names.empty() ? "" : ", ") + ("--" + name);
    const std::string type = option.get_items_expected_max() == 0 ? "" : " " + option.get_type_name();
    return ".TP\n.B " + troff(names + type) + "\n" + troff(option.get_description()) + "\n";
}

std::string options_section(CLI::App& command) {
    std::string text;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_positional()) text += option_entry(*option);
    return text.empty() ? "" : ".SH OPTIONS\n" + text;
}

std::string synopsis(const CLI::App& root, CLI::App& command) {
    std::string text = ".SH SYNOPSIS\n.B " + troff(root.get_name());
    if (&root == &command) return text + "\n.I COMMAND\n[options]\n";
    text += " " + troff(command.get_name()) + "\n[options]\n";
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional()) text += ".I " + troff(option->get_name(true)) + "\n";
    return text;
}

std::string arguments_section(CLI::App& command) {
    std::string text;
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional())
            text += ".TP\n.I " + troff(option->get_name(true)) + "\n" + troff(option->get_description()) + "\n";
    return text.empty() ? "" : ".SH ARGUMENTS\n" + text;
}

std::string commands_section(CLI::App& root) {
    std::string text = ".SH COMMANDS\n";
    for (const CLI::App* command : commands_of(root))
        text += ".TP\n.BR " + troff(root.get_name() + "-" + command->get_name()) + " (1)\n" +
                troff(command->get_description()) + "\n";
    return text;
}

// The last sections of a page: "Examples:" with one command per line, then the exit statuses; some commands have a
// paragraph before these.
std::string end_section(const CLI::App& command) {
    const std::string footer = command.get_footer(), begin = "Examples:\n", status = "Exit status: ";
    const std::size_t from = footer.find(begin), at = footer.find(status);
    if (from == footer.npos || at == footer.npos || at < from) return "";
    return ".SH EXAMPLES\n.nf\n" + troff(footer.substr(from + begin.size(), at - from - begin.size())) +
           ".fi\n.SH EXIT STATUS\n" + troff(footer.substr(at + status.size())) + "\n";
}

}  // namespace

std::string man_page(CLI::App& root, CLI::App& command) {
    const std::string name = page_name(root, command);
    std::string upper = name;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    std::string text = ".TH " + upper + " 1 \"\" \"strata " STRATA_VERSION "\"\n.SH NAME\n" + troff(name) + " \\- " +
                       troff(command.get_description()) + "\n" + synopsis(root, command);
    if (&root == &command) return text + commands_section(root) + options_section(command);
    return text + arguments_section(command) + options_section(command) + end_section(command) + ".SH SEE ALSO\n.BR " +
           troff(root.get_name()) + " (1)\n";
}

}  // namespace strata::tools
