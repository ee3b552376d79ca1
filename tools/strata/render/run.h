// tools/strata/render/run.h - the common part of `render` and `layers`: loads scene and profile, runs each algorithm,
// writes its files, prints the statistics.
#pragma once
#include <functional>
#include <string>

#include "peeling/frame_request.h"
#include "scenes/files/image_io.h"
#include "tools/strata/options/options.h"

namespace strata::oracle {
struct TargetImage;
}

namespace strata::peeling {
class Renderer;
struct RenderResult;
}  // namespace strata::peeling

namespace strata::tools {

// The objects that all algorithms of one command share.
struct Session {
    scenes::Scene scene;
    pipeline::DeviceProfile profile;
    pipeline::View view;
    // The session must outlive the request.
    [[nodiscard]] peeling::FrameRequest request(const peeling::RenderOptions& options,
                                                pipeline::ColorSpace space = pipeline::ColorSpace::encoded) const {
        return {scene.list, view, profile, options, space};
    }
};

// The scene's camera of that name, or the camera in a file, which is in `folder` unless that is empty. Throws
// CLI::ValidationError if neither exists.
[[nodiscard]] pipeline::View view_named(const std::string& name, const scenes::Scene& scene, double aspect,
                                        const std::string& folder = "");

// Loads profile and scene, prints warnings (for example if nothing is transparent), finds the view, and applies --simd
// and --background.
[[nodiscard]] Session open_session(RunOptions& options);

// Sets the size to the picture's. InputError names its file if --size states another one.
void take_size(RunOptions& options, const oracle::TargetImage& picture, const std::string& file);

// One algorithm that has run. The references are valid only while the Writer runs.
struct CompletedRun {
    const Session& session;
    const peeling::Algorithm& algorithm;
    peeling::Renderer& renderer;
    peeling::RenderResult& result;  // the writer may move its layers out
};

using Writer = std::function<void(const CompletedRun&)>;  // writes one algorithm's files

// Returns the exit status: 0 if at least one algorithm ran, else 2 with the refusals on standard error.
[[nodiscard]] int run_algorithms(RunOptions& options, const Writer& write);

// The output path of one algorithm; with several algorithms, its name is inserted before the ending (out.dual.exr).
[[nodiscard]] std::string path_for(const std::string& path, const RunOptions& options,
                                   const peeling::Algorithm& algorithm);

// The file format of -o, by its ending. For standard output it is that of --format, or `fallback`.
[[nodiscard]] scenes::ImageFile kind_of(const RunOptions& options, scenes::ImageFile fallback);

// The attributes of every file: command, profile, camera. The writer of the file adds digests and formats.
[[nodiscard]] scenes::Attributes attributes_of(const std::string& verb, const RunOptions& options,
                                               const CompletedRun& finished);

// An output file of a command; an empty path means none. `StandardOutput` says whether it may be "-", standard output.
enum class StandardOutput : std::uint8_t { never, possibly };
struct OutputFile {
    std::string option, path;
    std::vector<std::string> endings;
    StandardOutput piped = StandardOutput::never;
    [[nodiscard]] bool is_piped() const;
};

// Throws CLI::ValidationError unless each path has one of the allowed endings and is in a folder that exists, and no
// two paths name the same file.
void check_outputs(const std::vector<OutputFile>& outputs);

}  // namespace strata::tools
