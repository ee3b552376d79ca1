// tools/oracle/diagnosis/scenes_diagnosis.h - finds the mistake of a port from its images of several scenes.
//
// Rule     Every scene is diagnosed by itself. A finding that is reported for one of them, or explains all of its
//          pixels there, is judged in all others: the one that fits the most scenes is reported; of several the one
//          with fewer mistakes, then the one whose passes agree further. In a scene to which a mistake is not
//          applicable, or whose image it does not change, the correct run is used. All pixels of all scenes have to
//          be explained within one code, and not by accident (is_evidence).
// Tests    tests/tools/oracle/diagnosis/scenes_diagnosis_test.cpp
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/diagnosis/diagnosis.h"

namespace strata::oracle {

// A port's image of one scene. Objects that it points to must outlive the diagnosis.
struct SceneEvidence {
    std::string name{};
    const MistakeImages* mistake_images = nullptr;
    const Picture* candidate = nullptr;
    const std::vector<PassPicture>* passes = nullptr;  // null if there are none
};

// A finding for all scenes.
struct ScenesFinding {
    std::vector<const Mistake*> mistakes{};  // empty: the correct run
    std::vector<bool> fits{};                // one per scene
    std::uint64_t explained = 0;             // pixels of all scenes that differ from the correct image
    int targets_alike = 0;                   // in the passes of all scenes that it fits
    std::vector<const Mistake*> alike{};     // other single mistakes that fit equally well
};

struct ScenesDiagnosis {
    Conclusion conclusion{};                                     // unknown_mistake: no finding fits every scene
    std::uint64_t pixels = 0, differing = 0, differing_far = 0;  // as in Diagnosis
    std::vector<Diagnosis> scenes{};
    std::vector<ScenesFinding> findings{};  // the best first; never empty
};

// Requires at least one scene.
[[nodiscard]] ScenesDiagnosis diagnose_scenes(const std::vector<SceneEvidence>& scenes,
                                              const Tolerances& tolerances = {}, const ShowProgress& progress = {});

// A scene's name, and the comparison of its correct image with the candidate.
struct SceneReport {
    std::string name{};
    Comparison comparison{};
};

// The verdict in the first line, then one line per scene, and the next best findings.
[[nodiscard]] std::string to_text(const ScenesDiagnosis& diagnosis, const std::vector<SceneReport>& reports);
[[nodiscard]] std::string to_json(const ScenesDiagnosis& diagnosis, const std::vector<SceneReport>& reports);

}  // namespace strata::oracle
