// tools/strata/recorded_command.h - the command that a picture keeps, taken apart again.
//
// Rule     A picture may come from anyone. Its command chooses what is drawn: the scene, and the options of
//          add_picture_options and --map. It never says what is written, and the files that it names lie in the
//          picture's folder or in --files-in.
// Tests    tests/tools/recorded_command_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace strata::tools {

// The line as it is in the file. InputError if the file keeps none.
[[nodiscard]] std::string recorded_command(const std::string& file);

// What chooses what is drawn in the first command and not in the second, or otherwise, size and algorithm apart:
// "--background 1,1,1 (here: none)". Empty for commands that draw the same, and for a line that is no command of
// strata.
[[nodiscard]] std::vector<std::string> differences(const std::string& recorded, const std::string& here);

// `render --from FILE`, or layers: the words of the file's command take the place of the two, its scene and profile as
// paths in that folder; --files-in stays, and says where a camera's file is. InputError for a command with any other
// option or name; CLI::ValidationError for --files-in without --from.
void expand_from(std::vector<std::string>& words);

// For --help: expand_from takes --from before options are parsed. `files_in` is empty without --from.
void add_from_option(CLI::App& app, std::string& files_in);

}  // namespace strata::tools
