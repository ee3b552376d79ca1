// tools/strata/messages.h - what the program says beside its result: errors, warnings, details and their colours, and
// how much of it is wanted.
//
// Rule     Messages go to standard error, one line each of at most 3,000 bytes or its begin and end; no byte of a file
//          or of the command line reaches a terminal as a control character. Colours are put round words of a terminal
//          alone, unless --color says otherwise; NO_COLOR (not empty) and TERM=dumb leave them out.
// Tests    tests/tools/messages_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <string_view>

namespace strata::tools {

// -q, -v and --color of a command. They count from the word on at which they stand, for errors of later words, too.
void add_message_options(CLI::App& app);
[[nodiscard]] bool is_message_option(const CLI::Option& option);

enum class Paint : std::uint8_t { bold, red, yellow, green };
enum class Stream : std::uint8_t { output, error };

// The text as it is, or between the codes of its paint where that stream shows colours.
[[nodiscard]] std::string painted(std::string_view text, Paint paint, Stream stream);

[[nodiscard]] bool is_quiet() noexcept;
[[nodiscard]] bool is_verbose() noexcept;
// A bar is drawn on a terminal alone, and not under -q.
[[nodiscard]] bool shows_progress() noexcept;

void say_error(std::string_view sentence);    // "strata: ...", under -q as well
void say_warning(std::string_view sentence);  // "strata: warning: ..."; -q leaves it out
void say_detail(std::string_view sentence);   // "strata: ..." under -v alone
// Text for people that is not the result, on standard error; -q leaves it out.
void say_note(std::string_view text);

// As it may go to that stream: control characters and bytes that are no character as `printable` has them, but for line
// ends, tabs and, where the stream shows colours, the codes of `painted`. JSON stays JSON.
[[nodiscard]] std::string shown_text(std::string_view text, Stream stream);

// 0.0123 s as "0.012 s".
[[nodiscard]] std::string seconds_text(double seconds);

}  // namespace strata::tools
