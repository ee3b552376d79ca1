// tools/strata/options/options.h - the options that `render`, `layers` and `scene` share.
#pragma once
#include <CLI/CLI.hpp>
#include <chrono>
#include <string>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/render_options.h"
#include "pipeline/formats/resolve.h"
#include "rasterizer/base/simd.h"
#include "scenes/camera.h"
#include "scenes/files/image_io.h"
#include "scenes/scene.h"
#include "tools/strata/options/values.h"

namespace strata::tools {

// The options of a command; every field has the default of reports.md 6.
struct RunOptions {
    // The process's own start, as far as this program sees it: statistics tell the seconds since.
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    std::string scene;
    scenes::SceneOptions scene_options;
    std::string default_algorithm = "dual";
    std::vector<const peeling::Algorithm*> algorithms;  // at least one after parsing, none twice
    std::string profile = "geforce8";                   // a name or a file
    std::optional<pipeline::Origin> origin;             // --origin; none: the profile's
    std::string camera;                                 // --camera; empty: the orbit
    std::string files_in;  // of --from: the folder of a camera's file; empty: the path as given
    std::optional<Orbit> orbit;
    std::optional<pipeline::Rgba>
        background;                      // --background: sRGB and straight; none: what `render` has, black or a pack's
    bool names_camera_of_scene = false;  // --camera turned out to be one of the scene's, not a file
    bool takes_own_view = false;         // neither is given, and the scene turned out to have a view of its own
    scenes::ClipConvention view_convention;  // of a view that comes with the scene
    peeling::RenderOptions render;
    int samples = 1;            // --samples: 1, 2, 4 or 8 a pixel, each shaded by itself
    std::optional<int> sample;  // --sample: the frame of this one alone
    pipeline::Resolve resolve = pipeline::Resolve::box;
    bool resolves = false;            // the command takes frames of all samples
    bool keeps_no_fragments = false;  // --execution tiled: replay without memory, whatever --fragment-memory says
    std::optional<std::uint64_t> max_memory{};  // --max-memory in bytes; none: what the machine has free
    Simd simd = Simd::best;
    std::string stats;                        // --stats; empty: none, "-": standard output
    std::string output;                       // -o; empty: none, "-": standard output
    std::optional<scenes::ImageFile> format;  // --format: what a picture to standard output is
};

// SCENE, --scene, --color-space, --no-light.
void add_scene_options(CLI::App& app, std::string& scene, scenes::SceneOptions& options);

// Adds SCENE and all options that a result bit depends on.
void add_picture_options(CLI::App& app, RunOptions& options);
// For a command that asks for a scene in its own way: SCENE is this one, and a pack's state is taken.
void take_scene(RunOptions& options, const std::string& scene);
// One algorithm by its name. Throws CLI::ValidationError.
[[nodiscard]] const peeling::Algorithm* to_algorithm(const std::string& name);

// Adds the options that no bit depends on (--execution, --fragment-memory, --simd, --effects, --tile, --threads).
void add_execution_options(CLI::App& app, RunOptions& options);

// Parts of both, for a command that takes lists of the rest.
void add_reading_options(CLI::App& app, scenes::SceneOptions& options);    // --scene, --color-space, --no-light
void add_machine_options(CLI::App& app, peeling::RenderOptions& options);  // --depth-format ... --stochastic-seed
void add_order_options(CLI::App& app, peeling::RenderOptions& options);    // --formulation, --sorted, --sort
void add_profile_option(CLI::App& app, std::string& profile);
void add_origin_option(CLI::App& app, std::optional<pipeline::Origin>& origin);
void add_view_options(CLI::App& app, RunOptions& options);      // --size ... --background
void add_resource_options(CLI::App& app, RunOptions& options);  // --fragment-memory, --tile, --threads

// Lets an --execution option take the word `tiled`, with a warning: replay that keeps no fragments.
void accept_tiled(CLI::Option& execution, RunOptions& options);

// Throws CLI::ValidationError where this processor lacks the set.
void check_simd(Simd simd);

// Where results go and what they may take: --stats, -o, --no-audit, --max-memory.
void add_output_options(CLI::App& app, RunOptions& options, const std::string& output_help);

// --format, beside -o -.
void add_format_option(CLI::App& app, RunOptions& options, const std::string& help);

// Checks exclusions and fills in defaults that are lists, which needs all options together. Throws
// CLI::ValidationError.
void complete(RunOptions& options);

// The command that makes the same picture of one algorithm again, in one spelling: every option that a bit depends on
// and that was given or differs from its default; files without their folder; neither outputs nor threads, tiles and
// execution.
[[nodiscard]] std::string canonical_command(const std::string& verb, const RunOptions& options,
                                            const peeling::Algorithm& algorithm);
// The same of several.
[[nodiscard]] std::string canonical_command(const std::string& verb, const RunOptions& options,
                                            const std::vector<const peeling::Algorithm*>& algorithms);

[[nodiscard]] std::vector<std::string> algorithm_names();

}  // namespace strata::tools
