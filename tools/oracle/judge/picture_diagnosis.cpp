// tools/oracle/judge/picture_diagnosis.cpp - renders every emulation and compares it with the picture
// (picture_diagnosis.h).
#include "tools/oracle/judge/picture_diagnosis.h"

#include "tools/oracle/emulations/allowed_options.h"
#include "tools/oracle/picture/stored_like.h"

namespace strata::oracle {

PictureDiagnosis diagnose_picture(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                  const AskedPicture& asked) {
    const MistakeRenderer renderer{input, algorithm, has_depth(asked.candidate) ? Depths::made : Depths::left_out,
                                   asked.limit};
    PictureDiagnosis result{.options = std::make_shared<const std::vector<Mistake>>(
                                allowed_options(algorithm, renderer.right_run(), asked.more))};
    const MistakeImages images{renderer, asked.emulations, *result.options};
    result.found = images.diagnose(asked.candidate, asked.tolerances, asked.pairs, asked.passes);
    result.right = stored_like(renderer.right(), asked.candidate, input.space);
    result.comparison = compare(result.right, asked.candidate, asked.tolerances);
    return result;
}

}  // namespace strata::oracle
