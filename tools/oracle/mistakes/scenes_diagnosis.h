// tools/oracle/mistakes/scenes_diagnosis.h - which wrong machine made all pictures of a port, one of each of several
// scenes.
//
// Rule     Every scene is diagnosed by itself. A machine that is named in one of them, or explains all of its pixels
//          there, is judged in all the others: what fits the most scenes is named, of several the one with fewer
//          mistakes, then the one whose passes agree further. In a scene in which a mistake cannot be made, or hides,
//          the right machine stands for it. Half of the pixels of all scenes that are not the right machine's have to
//          be explained to the last code, and all within one.
// Tests    tests/tools/oracle/mistakes/scenes_diagnosis_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/mistakes/diagnosis.h"

namespace strata::oracle {

// What a port made of one scene. What is pointed to must live as long.
struct SceneEvidence {
    std::string name{};
    const Lineup* lineup = nullptr;
    const Picture* candidate = nullptr;
    const std::vector<PassPicture>* passes = nullptr;  // null where there are none
};

// A machine in all scenes.
struct ScenesFinding {
    std::vector<const Mistake*> mistakes{};  // none: the right machine
    std::vector<bool> fits{};                // a scene each
    std::uint64_t explained = 0;             // pixels that are not the right machine's, of all scenes
    int targets_alike = 0;                   // of passes, of all scenes that it fits
    std::vector<const Mistake*> alike{};     // other single mistakes that fit as well
};

struct ScenesDiagnosis {
    Verdict verdict{};  // none_of_mine: no machine fits every scene
    std::uint64_t pixels = 0, differing = 0;
    std::vector<Diagnosis> scenes{};
    std::vector<ScenesFinding> findings{};  // the best first; never empty
};

// At least one scene.
[[nodiscard]] ScenesDiagnosis diagnose_scenes(const std::vector<SceneEvidence>& scenes,
                                              const Tolerances& tolerances = {}, const ShowProgress& progress = {});

// A scene's name, and its right picture against the candidate.
struct SceneReport {
    std::string name{};
    Comparison comparison{};
};

// The verdict in the first line, a line for each scene, and the next best.
[[nodiscard]] std::string to_text(const ScenesDiagnosis& diagnosis, const std::vector<SceneReport>& reports);
[[nodiscard]] std::string to_json(const ScenesDiagnosis& diagnosis, const std::vector<SceneReport>& reports);

}  // namespace strata::oracle
