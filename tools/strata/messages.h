// tools/strata/messages.h - the program's messages besides its result: errors, warnings, details, with colours and
// verbosity.
//
// Rule     Messages go to standard error, one line each. A line over 3,000 bytes is shortened to its beginning and end.
//          Control characters from a file or the command line never reach a terminal. Colours are used only on a
//          terminal unless --color overrides that; NO_COLOR (not empty) and TERM=dumb disable them.
// Tests    tests/tools/strata/program/messages_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <string_view>

namespace strata::tools {

// Adds -q, -v and --color to a command. They take effect as soon as they are parsed, so they also apply to errors in
// later words.
void add_message_options(CLI::App& app);
[[nodiscard]] bool is_message_option(const CLI::Option& option);

enum class Paint : std::uint8_t { bold, red, yellow, green };
enum class Stream : std::uint8_t { output, error };

// The text, between the colour codes of `paint` if that stream shows colours.
[[nodiscard]] std::string painted(std::string_view text, Paint paint, Stream stream);

[[nodiscard]] bool is_quiet() noexcept;
[[nodiscard]] bool is_verbose() noexcept;
// True if progress bars are shown: standard error is a terminal, and -q is not given.
[[nodiscard]] bool shows_progress() noexcept;

void say_error(std::string_view message);    // "strata: ...", also under -q
void say_warning(std::string_view message);  // "strata: warning: ...", except under -q
void say_detail(std::string_view message);   // "strata: ...", only under -v
// Prints text that is not the result to standard error, except under -q.
void say_note(std::string_view text);

// The text as it is printed to that stream: control characters and invalid bytes are escaped as in `printable`, except
// line ends, tabs and, if the stream shows colours, the codes of `painted`. JSON remains valid.
[[nodiscard]] std::string shown_text(std::string_view text, Stream stream);

// Formats 0.0123 s as "0.012 s".
[[nodiscard]] std::string seconds_text(double seconds);

}  // namespace strata::tools
