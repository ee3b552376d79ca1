// tools/strata/compare/compare_scene.h - compares a candidate with a scene: is the picture right, apart from the
// formats and the rounding of the port that rendered it?
#pragma once
#include <optional>
#include <string>

#include "tools/oracle/picture/picture.h"
#include "tools/strata/options/options.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// True if `reference` names a scene rather than a picture: a built-in scene, a pack, or the file of a model.
[[nodiscard]] bool is_scene(const std::string& reference);

// The files of a verdict; empty names: none.
struct VerdictFiles {
    std::string report{}, heat{}, side{}, junit{};
};

struct SceneQuestion {
    RunOptions run{};       // of the scene; width and height are replaced by the candidate's
    std::string algorithm;  // empty: any exact algorithm
    bool json = false;
    VerdictFiles files{};
    bool is_form_stated = false;  // an option says whether the candidate's colours are straight or premultiplied
    bool has_alpha = true;        // alpha is compared, too
};

// "--orbit 30,20"
[[nodiscard]] std::string camera_in_words(const RunOptions& run);
// Opens the scene at the candidate's size. InputError names `file` if --size states another one.
[[nodiscard]] Session open_at_size(SceneQuestion& question, const oracle::TargetImage& target, const std::string& file);

// Renders the scene with the algorithm (dual if none is named) at the candidate's size; with a depth target if the
// candidate has one.
[[nodiscard]] oracle::Picture drawn_picture(SceneQuestion question, const oracle::Picture& candidate);

// Prints the verdict and writes the report. Returns 0 if the picture is right, 1 if not.
[[nodiscard]] int compare_with_scene(SceneQuestion question, const oracle::Picture& candidate);

}  // namespace strata::tools
