// tools/strata/info.cpp - strata info: what a picture says of itself, first of all the command that made it.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "rasterizer/base/input_error.h"
#include "scenes/files/picture_attributes.h"
#include "tools/strata/command.h"
#include "tools/strata/options/parse.h"
#include "tools/strata/options/printable.h"
#include "tools/strata/recorded_command.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

struct InfoOptions {
    std::string file;
    bool json = false;
};

std::string recorded(const std::string& file) {
    const scenes::Attributes attributes = scenes::read_attributes(file);
    const auto found = attributes.find("command");
    if (found == attributes.end())
        throw InputError(file, "strata:command", "a picture that strata wrote", "none of its commands in it");
    return found->second;
}

int info(const InfoOptions& options) {
    const std::string command = recorded(options.file);  // first: a picture of another program is refused
    const scenes::Attributes attributes = scenes::read_attributes(options.file);
    if (options.json) {
        const nlohmann::ordered_json document = attributes;
        print(document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
        return 0;
    }
    print(printable(command) + "\n");
    for (const auto& [key, value] : attributes)
        if (key != "command" && value.size() <= 64) print(fmt::format("{}: {}\n", printable(key), printable(value)));
    return 0;
}

}  // namespace

// The words as canonical_command joins them; a name with a blank in it cannot be told from two.
std::vector<std::string> recorded_words(const std::string& file) {
    std::vector<std::string> words;
    for (const std::string& word : split(recorded(file), ' '))
        if (!word.empty()) words.push_back(word);
    if (words.size() < 3 || words[0] != "strata")
        throw InputError(file, "strata:command", "a command of strata", "'" + printable(recorded(file)) + "'");
    return words;
}

void expand_from(std::vector<std::string>& words) {
    constexpr std::string_view option = "--from";
    for (std::size_t i = 0; i < words.size(); ++i)
        if (words[i].starts_with("--from=") && words[i].size() > option.size() + 1) {
            words.insert(words.begin() + static_cast<std::ptrdiff_t>(i) + 1, words[i].substr(option.size() + 1));
            words[i] = option;
        }
    const auto at = std::find(words.begin(), words.end(), option);
    if (words.front() != "render" && words.front() != "layers") return;
    if (at == words.end() || at + 1 == words.end()) return;
    const std::string file = *(at + 1);
    const std::vector<std::string> recorded = recorded_words(file);
    if (recorded[1] != words.front())
        throw InputError(file, "strata:command", "a file of strata " + words.front(), "one of strata " + recorded[1]);
    words.erase(at, at + 2);
    words.insert(words.begin() + 1, recorded.begin() + 2, recorded.end());
}

void add_from_option(CLI::App& app) {
    app.add_option_function<std::string>(
           "--from",
           [](const std::string& file) {
               throw CLI::ValidationError("--from", "expected a picture's name, found '" + file + "'");
           },
           "run the command that made this picture again (strata info tells it)")
        ->type_name("FILE");
}

Command add_info(CLI::App& root) {
    auto* app = root.add_subcommand("info", "tell which command made a picture; render --from FILE runs it again");
    const auto options = std::make_shared<InfoOptions>();
    app->add_option("FILE", options->file, "an .exr or .png file that strata wrote")->required()->type_name("");
    app->add_flag("--json", options->json, "all that it says: camera and profile, too");
    app->footer(footer(
        "  strata render teapot --size 64x64 -o teapot.png && strata info teapot.png\n"
        "  strata render teapot --size 64x64 -o a.png && strata render --from a.png -o b.png && cmp a.png b.png\n"));
    return {app, [options] { return info(*options); }};
}

}  // namespace strata::tools
