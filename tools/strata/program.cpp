// tools/strata/program.cpp - parses the command line, runs the subcommand, and turns every failure into a message and
// an exit status.
//
// Rule     A failure prints one line "strata: ..." on standard error. Exit status: 2 for bad input or usage, 3 if the
//          system failed, 130 if interrupted.
// Tests    tests/tools/strata/program/errors_test.cpp, interrupt_test.cpp
#include "tools/strata/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <ios>
#include <new>

#include "pipeline/device/check.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/parallel.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/system_error.h"
#include "scenes/files/unfinished_files.h"
#include "scenes/gltf/document/input_errors.h"
#include "scenes/read_files.h"
#include "tools/request/names.h"
#include "tools/strata/command.h"
#include "tools/strata/lab.h"
#include "tools/strata/manual/manual.h"
#include "tools/strata/messages.h"
#include "tools/strata/recorded_command.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

enum Exit : int { bad_input = 2, system_failed = 3 };

// Prints the message of a failure and returns its status.
int fail(const std::string& message, Exit status) {
    say_error(message);
    return status;
}

// Warns at the end, because the number of threads that a loop needs is known only when it runs.
void warn_of_threads() {
    const ThreadShortage threads = thread_shortage();
    if (threads.available < threads.requested)
        say_warning(fmt::format("--threads: the system did not start {} threads; {} threads ran", threads.requested,
                                threads.available));
}

using Clock = std::chrono::steady_clock;

// Prints at most 20 errors, because a broken file may have thousands.
int fail_of(const std::vector<std::string>& messages) {
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < std::min(messages.size(), most); ++i) say_error(messages[i]);
    if (messages.size() > most) say_error(std::to_string(messages.size() - most) + " more errors are not shown");
    return bad_input;
}

// Prints time and memory of the whole execution, for -v. ru_maxrss is in kilobytes on Linux.
void tell_effort(Clock::time_point start) {
    const std::chrono::duration<double> passed = Clock::now() - start;
    rusage used{};
    if (getrusage(RUSAGE_SELF, &used) == 0)
        say_detail(fmt::format("done in {}, with at most {} MiB of memory", seconds_text(passed.count()),
                               (used.ru_maxrss + 1023) / 1024));
}

std::vector<std::string> names_of(CLI::App& root) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands_of(root)) names.push_back(command->get_name());
    return names;
}

// The long options of a command in the form --size.
std::vector<std::string> options_of(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

std::string unknown_command(const std::string& word, CLI::App& root) {
    return "strata has no command " + found_but_near(word, names_of(root)) + "; strata --help lists them";
}

// The subcommand on the command line, or the root if there is none.
CLI::App& parsed_app(CLI::App& root) {
    const auto subcommands = root.get_subcommands();
    return subcommands.empty() ? root : *subcommands.front();
}

// "one value", or with the type in --help: "one FILE.html".
std::string value_of(const CLI::App& app, const std::string& name) {
    const CLI::Option* option = app.get_option_no_throw(name);
    const std::string type = option == nullptr ? "" : option->get_type_name();
    return type.empty() || type.size() > 40 ? "one value" : "one " + type;
}

// Rewrites CLI11's error messages in plain words. Messages of this project's validators are returned unchanged.
std::string message(const CLI::ParseError& error, CLI::App& root) {
    const CLI::App& app = parsed_app(root);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        const std::string extra = root.remaining(true).front();
        if (!extra.starts_with('-') && &app == &root) return unknown_command(extra, root);
        if (!extra.starts_with('-')) return "strata " + app.get_name() + ": unexpected argument '" + extra + "'";
        const std::string option = extra.substr(0, extra.find('='));
        return "strata " + app.get_name() + " has no option " + found_but_near(option, options_of(app));
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
        const std::string missing = std::string(error.what()).substr(0, std::string(error.what()).find(' '));
        return missing + " is missing; strata " + app.get_name() + " --help says more";
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        const std::string said = error.what();
        const std::string option = said.substr(0, said.find_first_of(": "));
        if (said.ends_with("flag override")) return "--" + option + " takes no value";
        return option + " needs " + value_of(app, option);
    }
    return error.what();
}

// The commands in the order of --help. An entry without a function is an experiment.
struct ListedCommand {
    const char* group;
    std::string_view name;
    Command (*add)(CLI::App& root) = nullptr;
};
constexpr std::array listed{
    ListedCommand{"Render and look", "render", add_render},
    ListedCommand{"Render and look", "report", add_report},
    ListedCommand{"Render and look", "explain", add_explain},
    ListedCommand{"Render and look", "passes", add_passes},
    ListedCommand{"Render and look", "layers", add_layers},
    ListedCommand{"Render and look", "scene", add_scene},
    ListedCommand{"Render and look", "info", add_info},
    ListedCommand{"Check a port", "compare", add_compare},
    ListedCommand{"Check a port", "golden", add_golden},
    ListedCommand{"Check a port", "diagnose", add_diagnose},
    ListedCommand{"Check a port", "reduce", add_reduce},
    ListedCommand{"Experiments", "cost"},
    ListedCommand{"Experiments", "invariance"},
    ListedCommand{"Experiments", "multisampling"},
    ListedCommand{"Experiments", "hard-cases"},
    ListedCommand{"Experiments", "reproduce"},
    ListedCommand{"Experiments", "bench"},
    ListedCommand{"Devices", "probe"},
    ListedCommand{"Devices", "infer"},
    ListedCommand{"Devices", "hardware-check"},
    ListedCommand{"Lists and help", "list", add_list},
    ListedCommand{"Lists and help", "help", add_help},
    ListedCommand{"Lists and help", "completions", add_completions},
};

// Adds a listed command. An experiment that this program does not contain gets only its name and description, for
// lists; run_lab has already run it otherwise.
Command add_listed(CLI::App& root, const ListedCommand& entry, const std::vector<NamedCommand>& experiments) {
    const auto held = std::ranges::find(experiments, entry.name, &NamedCommand::name);
    Command command;
    if (entry.add != nullptr)
        command = entry.add(root);
    else if (held != experiments.end())
        command = held->add(root);
    else
        command = {add_lab_command(root, entry.name), [] { return 0; }};
    command.app->group(entry.group);
    return command;
}

// The text that `strata` without a command prints.
std::string short_help(const std::vector<Command>& commands) {
    Table table{{{"strata COMMAND"}, {"what it does"}}, {}};
    std::string group;
    for (const Command& command : commands) {
        if (command.app->get_group() != group) {
            group = command.app->get_group();
            table.rows.push_back({group + ":", ""});
        }
        table.rows.push_back({"  " + command.app->get_name(), command.app->get_description()});
    }
    return titled(to_text(table)) +
           "Begin with: strata render teapot --size 400x300 -o teapot.png\n"
           "More about a command: strata COMMAND --help\n";
}

// Removes the word `all` after `--help`, which would be parsed as a scene; returns Shown::all if it was there.
HelpDetail take_amount_of_help(std::vector<std::string>& words) {
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        if ((words[i] != "--help" && words[i] != "-h") || words[i + 1] != "all") continue;
        words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        return HelpDetail::all;
    }
    return HelpDetail::usual;
}

// CLI11 expects the words in reverse order. A command's name after help is an argument: "--" prevents it from
// being parsed as a command.
void parse(CLI::App& root, std::vector<std::string> words) {
    if (words.front() == "help" && words.size() > 1 && !words[1].starts_with('-'))
        words.insert(words.begin() + 1, "--");
    root.parse(std::vector<std::string>(words.rbegin(), words.rend()));
}

// Disables values of flags, because CLI11 would accept --json=-1 as the negation of --json.
void refuse_values_of_flags(const std::vector<Command>& commands) {
    for (const Command& command : commands)
        for (CLI::Option* option : command.app->get_options({}))
            if (option->get_items_expected_max() == 0) option->disable_flag_override();
}

// Checks the first word, because CLI11 would report a misspelt command as an extra argument.
int parse_and_run(CLI::App& root, const std::vector<Command>& commands, std::vector<std::string> words) {
    const auto names = names_of(root);
    if (words.empty()) {
        print(short_help(commands));
        return 0;
    }
    const std::string first = words.front();
    if (!first.starts_with('-') && std::find(names.begin(), names.end(), first) == names.end()) {
        return fail(unknown_command(first, root), bad_input);
    }
    if (words == std::vector<std::string>{"help"}) {
        print(short_help(commands));
        return 0;
    }
    const HelpDetail shown = take_amount_of_help(words);
    try {
        expand_from(words);
        parse(root, words);
        for (const Command& command : commands) {
            if (command.app->parsed()) return command.run();
        }
        return fail("a command is missing; strata --help lists them", bad_input);
    } catch (const CLI::CallForHelp&) {
        print(help_of(parsed_app(root), shown));
    } catch (const CLI::CallForVersion& version) {
        print(std::string(version.what()) + '\n');
    } catch (const CLI::ParseError& error) {
        return fail(message(error, root), bad_input);
    }
    return 0;
}

int run(const std::vector<std::string>& words, const std::vector<NamedCommand>& experiments) {
    if (experiments.empty() && is_for_lab(words)) run_lab(words);
    CLI::App root{
        "Deterministic, bit-exact software rasterizer that runs depth-peeling algorithms as old GPUs ran them.",
        "strata"};
    root.set_version_flag("--version", "strata " STRATA_VERSION);
    root.footer("strata COMMAND --help says more about a command, with examples.");
    std::vector<Command> commands;
    for (const ListedCommand& entry : listed) commands.push_back(add_listed(root, entry, experiments));
    add_message_options(root);
    for (const Command& command : commands) add_message_options(*command.app);
    refuse_values_of_flags(commands);
    return parse_and_run(root, commands, words);
}

// "PATH: cannot create directories: Not a directory" of "filesystem error: cannot create directories: Not a directory
// [PATH]", the standard library's text.
std::string in_words(const std::filesystem::filesystem_error& error) {
    constexpr std::string_view head = "filesystem error: ";
    const std::string said = error.what();
    const std::size_t begin = said.starts_with(head) ? head.size() : 0;
    return error.path1().string() + ": " + said.substr(begin, said.find(" [", begin) - begin);
}

// Opens a standard stream that is closed, in the direction in which it is not used: else the next file that is opened
// would take its number, and a result written to standard output would be lost without an error.
void open_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// A program whose stack cannot grow ends with a signal, without a word.
void check_stack() {
    constexpr rlim_t least = rlim_t{512} << 10;
    rlimit stack{};
    if (getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < least)
        throw SystemError("the stack", fmt::format("grow beyond {} KiB", stack.rlim_cur >> 10),
                          fmt::format("strata needs {} KiB (ulimit -s 8192 is the usual limit)", least >> 10));
}

}  // namespace

int run_program(int count, char** words, const std::vector<NamedCommand>& experiments) {
    const Clock::time_point start = Clock::now();
    open_closed_streams();
    scenes::install_interrupt_handlers();
    scenes::protect_read_files();
    scenes::report_written_files([](const std::string& path) { say_detail("wrote " + path); });
    try {
        check_stack();
        const int status = run({words + std::min(count, 1), words + count}, experiments);
        warn_of_threads();
        tell_effort(start);
        return status;
    } catch (const scenes::InputErrors& errors) {
        return fail_of(errors.messages);
    } catch (const InputError& error) {
        return fail(error.what(), bad_input);
    } catch (const pipeline::Refused& error) {
        return fail(error.what(), bad_input);
    } catch (const std::bad_alloc&) {
        return fail("not enough memory", system_failed);
    } catch (const std::filesystem::filesystem_error& error) {
        return fail(in_words(error), system_failed);
    } catch (const std::exception& error) {  // SystemError, file systems, streams
        return fail(error.what(), system_failed);
    }
}

}  // namespace strata::tools
