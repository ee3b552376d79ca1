// tools/strata/options/options.h - the options that `render`, `layers` and other commands share.
#pragma once
#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/multisampling.h"
#include "peeling/render_options.h"
#include "rasterizer/base/simd.h"
#include "scenes/camera.h"
#include "scenes/files/image_io.h"
#include "scenes/scene.h"
#include "tools/request/picture_request.h"
#include "tools/strata/options/option.h"

namespace strata::tools {

using Algorithms = std::vector<const peeling::Algorithm*>;

// The options of a command: those of its picture, and what it reads, writes and may use.
struct RunOptions : PictureRequest {
    // The start of the process, as early as this program can read the clock; statistics report the seconds since.
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    std::string scene;
    const CLI::App* app = nullptr;  // its options of single algorithms are refused if no chosen algorithm reads them
    std::string default_algorithm = "dual";
    bool takes_one_algorithm = false;    // for the help; the command checks it
    Algorithms algorithms;               // at least one after parsing, without repetition
    std::string profile = "geforce8";    // a name or a file
    std::string files_in;                // --from: the folder of a camera's file; empty: the path is used unchanged
    bool names_camera_of_scene = false;  // --camera is a camera of the scene, not a file
    bool takes_own_view = false;         // no view option is given, and the scene contains a view
    std::optional<scenes::ClipConvention> pack_convention;  // of the view that the scene contains, if it is a pack
    bool takes_size_of_picture = false;  // the size is that of a candidate's picture, and --size may only confirm it
    std::optional<std::uint64_t> max_memory{};  // --max-memory in bytes; empty: the free memory of the computer
    std::string stats;                          // --stats; empty: none, "-": standard output
    std::string output;                         // -o; empty: none, "-": standard output
    std::optional<scenes::ImageFile> format;    // --format: the file format of a picture on standard output
};

// Adds the options of a group of the table (tools/request/option_fields.h), in its order. --help and messages are made
// from the table.
void add_options(CLI::App& app, PictureRequest& request, OptionGroup group);
// Adds one option of the table, by its name.
CLI::Option* add_option_of_table(CLI::App& app, PictureRequest& request, std::string_view name);
// The help of --size in a command in which it may only confirm a picture's size.
inline constexpr const char* help_of_picture_size =
    "the size in pixels that the picture must have (default: the picture's)";
// Adds SCENE, --scene, --color-space and --no-light.
void add_scene_options(CLI::App& app, std::string& scene, PictureRequest& request);

// Adds SCENE and all options on which result bits depend.
void add_picture_options(CLI::App& app, RunOptions& options);
// For a command that declares its scene option itself: sets SCENE, and reads the state of a pack.
void take_scene(RunOptions& options, const std::string& scene);
// Returns the algorithm of that name. Throws CLI::ValidationError for an unknown name.
[[nodiscard]] const peeling::Algorithm* to_algorithm(const std::string& name);

// Adds the options of execution and resources.
void add_execution_options(CLI::App& app, PictureRequest& request);
void add_profile_option(CLI::App& app, std::string& profile);

// Throws CLI::ValidationError if this processor lacks the instruction set.
void check_simd(Simd simd);

// Adds the options of outputs and resources: --stats, -o, --no-audit, --max-memory.
void add_output_options(CLI::App& app, RunOptions& options, const std::string& output_help);

void add_memory_option(CLI::App& app, RunOptions& options);  // --max-memory

// Adds --format, which is used with -o -.
void add_format_option(CLI::App& app, RunOptions& options, const std::string& help);

// Checks which options exclude each other, and fills in defaults that are lists. Both need all parsed options. Throws
// CLI::ValidationError.
void complete(RunOptions& options);

// The samples that a command renders: one with --sample, or all.

// The command that renders the same picture of one algorithm again, in a unique spelling. It contains every option on
// which a bit depends and that was given or differs from its default, and files without their folder; it does not
// contain outputs, threads, tiles and execution.
[[nodiscard]] std::string canonical_command(const std::string& verb, const RunOptions& options,
                                            const peeling::Algorithm& algorithm);
// The same for several algorithms.
[[nodiscard]] std::string canonical_command(const std::string& verb, const RunOptions& options,
                                            const Algorithms& algorithms);

[[nodiscard]] std::vector<std::string> algorithm_names();

}  // namespace strata::tools
