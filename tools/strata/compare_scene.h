// tools/strata/compare_scene.h - compare with a scene as the reference: is a picture of it right, whatever formats and
// roundings its port has?
#pragma once
#include <optional>
#include <string>

#include "tools/oracle/picture.h"
#include "tools/strata/options/options.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

// Whether `reference` names a scene and no picture: a built-in one, a pack, or a file that holds a model.
[[nodiscard]] bool is_scene(const std::string& reference);

struct SceneQuestion {
    RunOptions run{};       // of the scene; the size is the candidate's
    std::string algorithm;  // empty: any that is exact
    bool json = false;
    std::string report;  // empty: none
};

// The candidate's colours. InputError if it has none.
[[nodiscard]] const oracle::Target& colors_of(const oracle::Picture& candidate);
// The scene at the candidate's size.
[[nodiscard]] Session open_at_size(SceneQuestion& question, const oracle::Target& target);

// The picture that the algorithm draws, dual where none is named: in the candidate's size, with a depth where it has
// one.
[[nodiscard]] oracle::Picture drawn_picture(SceneQuestion question, const oracle::Picture& candidate);

// Writes the report, and prints the verdict. 0: right, 1: not.
[[nodiscard]] int compare_with_scene(SceneQuestion question, const oracle::Picture& candidate);

}  // namespace strata::tools
