// tools/strata/messages.cpp - decides which messages are shown, by -q and -v, and whether they have colours, by
// --color, NO_COLOR and the terminal (messages.h).
#include "tools/strata/messages.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "scenes/printable.h"
#include "tools/strata/options/option.h"

namespace strata::tools {

namespace {

enum class Amount : std::uint8_t { quiet, usual, verbose };
enum class ColorMode : std::uint8_t { automatic, always, never };

// The settings of -q, -v and --color. They are process-wide, and set while the command line is parsed, before other
// threads start.
struct Wanted {
    Amount amount = Amount::usual;
    ColorMode colors = ColorMode::automatic;
};
Wanted& wanted() {
    static Wanted of_process;
    return of_process;
}

bool shows_colors(Stream stream) {
    if (wanted().colors != ColorMode::automatic) return wanted().colors == ColorMode::always;
    const char *no_color = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
    if (no_color != nullptr && *no_color != '\0') return false;
    if (terminal == nullptr || std::string_view(terminal) == "dumb") return false;
    return isatty(stream == Stream::output ? STDOUT_FILENO : STDERR_FILENO) == 1;
}

std::string_view code_of(Paint paint) {
    switch (paint) {
        case Paint::bold: return "\x1b[1m";
        case Paint::red: return "\x1b[1;31m";
        case Paint::yellow: return "\x1b[1;33m";
        case Paint::green: break;
    }
    return "\x1b[1;32m";
}

// Removes the middle of a sentence that is too long, for example because a name in it has a megabyte; its end contains
// the value that was found.
std::string shortened(std::string_view message) {
    constexpr std::size_t most = 3000, kept = 1000;
    if (message.size() <= most) return scenes::printable(message);
    const std::size_t left_out = message.size() - 2 * kept;
    return fmt::format("{} [{} bytes left out] {}", scenes::printable(message.substr(0, kept)), left_out,
                       scenes::printable(message.substr(kept + left_out)));
}

// Prints each line with one call, so that lines of different threads do not mix.
void say(const std::string& begin, std::string_view message) {
    std::fprintf(stderr, "%s %s\n", begin.c_str(), shortened(message).c_str());
}

}  // namespace

void add_message_options(CLI::App& app) {
    app.add_flag_callback(
           "-q,--quiet", [] { wanted().amount = Amount::quiet; },
           "print errors and the result only: no progress, no warnings, no notes")
        ->trigger_on_parse();
    app.add_flag_callback(
           "-v,--verbose", [] { wanted().amount = Amount::verbose; },
           "print steps, files written and times on standard error")
        ->trigger_on_parse();
    const std::vector<Choice<ColorMode>> choices{
        {"auto", ColorMode::automatic}, {"always", ColorMode::always}, {"never", ColorMode::never}};
    add_choice(app, wanted().colors, "--color", choices,
               "colours of messages and tables, not of pictures (default auto: on a terminal, unless NO_COLOR is set)")
        ->trigger_on_parse();
}

bool is_message_option(const CLI::Option& option) {
    const std::string name = option.get_name();
    return name == "--quiet" || name == "--verbose" || name == "--color";
}

std::string painted(std::string_view text, Paint paint, Stream stream) {
    if (!shows_colors(stream)) return std::string(text);
    return fmt::format("{}{}\x1b[0m", code_of(paint), text);
}

bool is_quiet() noexcept { return wanted().amount == Amount::quiet; }
bool is_verbose() noexcept { return wanted().amount == Amount::verbose; }
bool shows_progress() noexcept { return !is_quiet() && isatty(STDERR_FILENO) == 1; }

void say_error(std::string_view message) { say(painted("strata:", Paint::red, Stream::error), message); }

void say_warning(std::string_view message) {
    if (!is_quiet()) say("strata: " + painted("warning:", Paint::yellow, Stream::error), message);
}

void say_detail(std::string_view message) {
    if (is_verbose()) say("strata:", message);
}

void say_note(std::string_view text) {
    if (!is_quiet()) std::fprintf(stderr, "%s", shown_text(text, Stream::error).c_str());
}

std::string shown_text(std::string_view text, Stream stream) {
    constexpr std::string_view codes[] = {"\x1b[0m", "\x1b[1m", "\x1b[1;31m", "\x1b[1;33m", "\x1b[1;32m"};
    const bool has_colors = shows_colors(stream);
    std::string shown;
    shown.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        std::size_t taken = 0;
        if (rest[0] == '\n' || rest[0] == '\t') taken = 1;
        for (const std::string_view code : codes)
            if (has_colors && rest.starts_with(code)) taken = code.size();
        if (taken > 0) {
            shown += rest.substr(0, taken);
        } else {
            taken = std::max<std::size_t>(scenes::utf8_length(rest), 1);
            shown += scenes::printable(rest.substr(0, taken));
        }
        i += taken;
    }
    return shown;
}

std::string seconds_text(double seconds) { return fmt::format("{:.3f} s", seconds); }

}  // namespace strata::tools
