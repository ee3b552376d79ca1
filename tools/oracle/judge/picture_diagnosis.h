// tools/oracle/judge/picture_diagnosis.h - a picture compared with all emulations: what they show, and the right one.
#pragma once
#include <memory>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/diagnosis/diagnosis.h"
#include "tools/oracle/judge/asked_picture.h"

namespace strata::oracle {

struct PictureDiagnosis {
    Diagnosis found{};
    Comparison comparison{};  // of the right picture with the candidate
    Picture right{};
    std::shared_ptr<const std::vector<Mistake>> options{};  // findings point to these, or to the catalogue
};

// Throws Refused if the device lacks a feature.
[[nodiscard]] PictureDiagnosis diagnose_picture(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                                const AskedPicture& asked);

}  // namespace strata::oracle
