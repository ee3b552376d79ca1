// tools/strata/render/run.h - what `render` and `layers` do alike: load, run each algorithm, write its files, tell the
// statistics.
#pragma once
#include <functional>
#include <string>

#include "scenes/files/image_io.h"
#include "tools/strata/options/options.h"

namespace strata::peeling {
class Renderer;
struct RenderResult;
}  // namespace strata::peeling

namespace strata::tools {

// Everything that the algorithms of one command share.
struct Session {
    scenes::Scene scene;
    pipeline::DeviceProfile profile;
    pipeline::View view;
};

// A camera of the scene, or of a file, which is in `folder` unless that is empty. CLI::ValidationError where there is
// neither.
[[nodiscard]] pipeline::View view_named(const std::string& name, const scenes::Scene& scene, double aspect,
                                        const std::string& folder = "");

// Loads profile and scene, warns on standard error (of a scene in which nothing is transparent, too), finds the view,
// and makes --simd and --background the run's.
[[nodiscard]] Session open_session(RunOptions& options);

// One algorithm that ran. The references hold while the Writer runs.
struct Finished {
    const Session& session;
    const peeling::Algorithm& algorithm;
    peeling::Renderer& renderer;    // of the first sample
    peeling::RenderResult& result;  // the writer may take its layers
};

using Writer = std::function<void(const Finished&)>;  // writes one algorithm's files

// The exit status: 0 if at least one algorithm ran, else 2 with the refusals on standard error.
[[nodiscard]] int run_algorithms(RunOptions& options, const Writer& write);

// Where one algorithm's result goes: with several, its name stands before the ending (out.dual.exr).
[[nodiscard]] std::string path_for(const std::string& path, const RunOptions& options,
                                   const peeling::Algorithm& algorithm);

// What -o asks for: by its ending, or what --format says of standard output, where `fallback` is usual.
[[nodiscard]] scenes::ImageFile kind_of(const RunOptions& options, scenes::ImageFile fallback);

// The attributes of every file: command, profile, camera. The writer adds digests and formats.
[[nodiscard]] scenes::Attributes attributes_of(const std::string& verb, const RunOptions& options,
                                               const Finished& finished);

// A file that a command is to write; an empty path is none. Few may be "-", standard output.
enum class Piped : std::uint8_t { never, possibly };
struct Output {
    std::string option, path;
    std::vector<std::string> endings;
    Piped piped = Piped::never;
    [[nodiscard]] bool is_piped() const;
};

// Throws CLI::ValidationError unless each names a file with one of its endings in a folder that exists, and no two name
// the same file.
void check_outputs(const std::vector<Output>& outputs);

}  // namespace strata::tools
