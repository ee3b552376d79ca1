// tools/oracle/judge/diagnose_picture.h - the mistake in a picture of a scene: by emulations, and by its layers where
// no emulation gives the picture.
//
// Rule     Emulations are tried first (diagnosis/diagnosis.h), with options of a right run before mistakes. A picture
//          that is right by its layers is right, even if a mistake has the same picture: `strata compare` says so, too.
//          Where no emulation gives the picture, the layers are asked whatever the algorithm is: a finding of theirs
//          is the finding, and their leads are shown.
// Tests    tests/tools/strata/diagnose/diagnose_command_test.cpp, tests/tools/library/diagnose_test.cpp
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "tools/oracle/diagnosis/diagnosis.h"

namespace strata::oracle {

struct DiagnosisQuestion {
    peeling::FrameRequest input;
    const peeling::Algorithm& algorithm;
    const Picture& candidate;
    Tolerances tolerances{};
    bool is_form_stated = false;                      // the caller states whether colours are straight or premultiplied
    std::string camera = "the given camera";          // in words, for a hint
    int limit = 0;                                    // geometry passes after which the candidate gives up; 0: unknown
    std::span<const pipeline::DeviceProfile> more{};  // profiles that are tried before the built-in ones
    const std::vector<PassPicture>* passes = nullptr;  // the candidate's
    ShowProgress layers{};                             // progress of the verdict by layers, which is the last step
};

struct PictureDiagnosis {
    Diagnosis found{};
    Comparison comparison{};  // of the right picture with the candidate
    Picture right{};
    std::shared_ptr<const std::vector<Mistake>> options{};  // findings point to these, or to the catalogue
};

// Throws Refused if the device lacks a feature. Everything that `question` refers to must outlive the call only.
[[nodiscard]] PictureDiagnosis diagnose_picture(const DiagnosisQuestion& question, const ShowProgress& emulations = {},
                                                const ShowProgress& pairs = {});

}  // namespace strata::oracle
