#include "tools/strata/options/old_words.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace strata::tools {

namespace {

struct OldCommand {
    std::string_view old, now, mode;  // `mode` is the word after the command
};
constexpr std::array old_commands{
    OldCommand{"algorithms", "list", "algorithms"}, OldCommand{"profiles", "list", "profiles"},
    OldCommand{"scenes", "list", "scenes"},         OldCommand{"digest", "info", "--digests"},
    OldCommand{"mistakes", "diagnose", "--list"},   OldCommand{"effects", "bench", "--per-effect"}};

struct OldOption {
    std::string_view old, now;
};
constexpr std::array old_options{OldOption{"--colour", "--color-space"}, OldOption{"--depth", "--depth-format"}};

const OldCommand* old_command(std::string_view word) {
    const auto found = std::ranges::find(old_commands, word, &OldCommand::old);
    return found == old_commands.end() ? nullptr : found;
}

void replace_command(std::vector<std::string>& words) {
    const std::size_t at = command_at(words);
    if (at >= words.size()) return;
    if (const OldCommand* command = old_command(words[at])) {
        words[at] = command->now;
        words.insert(words.begin() + static_cast<std::ptrdiff_t>(at) + 1, std::string{command->mode});
    } else if ((words[at] == "help" || words[at] == "man") && at + 1 < words.size()) {
        if (const OldCommand* meant = old_command(words[at + 1])) words[at + 1] = meant->now;
    }
}

// True for --old and --old=value.
bool is_option(std::string_view word, std::string_view option) {
    return word.starts_with(option) && (word.size() == option.size() || word[option.size()] == '=');
}

std::string sentence(std::string_view old, std::string_view now) {
    return std::string(old) + " is an old spelling, which goes with version 0.3: " + std::string(now);
}

// Replaces bench --json FILE by -o FILE, and bench --json - by --json.
void replace_json_of_bench(std::vector<std::string>& words, std::vector<std::string>& sentences) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (!is_option(words[i], "--json")) continue;
        const bool is_joined = words[i].size() > 6;
        if (!is_joined && i + 1 == words.size()) continue;
        const std::string value = is_joined ? words[i].substr(7) : words[i + 1];
        if (value != "-" && !value.ends_with(".json")) continue;
        sentences.push_back(sentence("--json " + value, value == "-" ? "--json" : "-o " + value));
        if (!is_joined) words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        words[i] = value == "-" ? "--json" : "-o" + value;
    }
}

}  // namespace

std::size_t command_at(const std::vector<std::string>& words) {
    std::size_t at = 0;
    while (at < words.size() && words[at].starts_with('-')) at += words[at] == "--color" ? 2 : 1;
    return std::min(at, words.size());
}

std::vector<std::string> replace_old_words(std::vector<std::string>& words) {
    std::vector<std::string> sentences;
    replace_command(words);
    const std::size_t at = command_at(words);
    if (at < words.size() && words[at] == "bench") replace_json_of_bench(words, sentences);
    for (std::string& word : words)
        for (const OldOption& option : old_options) {
            if (!is_option(word, option.old)) continue;
            word.replace(0, option.old.size(), option.now);
            sentences.push_back(sentence(option.old, option.now));
        }
    return sentences;
}

}  // namespace strata::tools
