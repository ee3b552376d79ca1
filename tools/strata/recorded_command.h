// tools/strata/recorded_command.h - parses the command that a picture file records, for --from and for comparisons.
//
// Rule     A picture file is untrusted. Its command may only choose what is rendered: the scene, and the options of
//          add_picture_options and --map. It cannot name outputs, and its input files are read only from the picture's
//          folder or from --files-in.
// Tests    tests/tools/strata/program/recorded_command_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tools/strata/options/options.h"

namespace strata::tools {

// The command in the file, unchanged. Throws InputError if the file contains none.
[[nodiscard]] std::string recorded_command(const std::string& file);

// The settings of the first command that are absent from the second or have other values there, except size and
// algorithm: "--background 1,1,1 (here: none)". Empty if both commands render the same, or if a line is not a command
// of strata.
[[nodiscard]] std::vector<std::string> differences(const std::string& recorded, const std::string& here);

// Pictures written by this program contain their command. Warns if it differs from the options of `command`, such as
// a forgotten --background, because that is not a mistake of a port.
void warn_of_other_command(const std::string& file, const RunOptions& run, std::string_view command);

// Expands `render --from FILE` or `layers --from FILE`: the words of the recorded command replace the two words, with
// its scene and profile as paths in that folder; an option that is given replaces the recorded one. --files-in remains,
// as the folder of a camera's file. Throws InputError if the command has any other option or name, and
// CLI::ValidationError for --files-in without --from.
void expand_from(std::vector<std::string>& words);

// Declares --from only for --help, because expand_from removes it before parsing. `files_in` is empty without --from.
void add_from_option(CLI::App& app, std::string& files_in);

}  // namespace strata::tools
