// tools/strata/samples_verdict.h - the verdict on a picture with several samples per pixel. If it is wrong, the other
// profiles and sample positions are tried.
//
// Rule     The picture is judged by the given rules; if it is wrong by the rules of each other profile, then by those
//          given with other sample positions. The first that it is right by is the verdict's. Of a file with straight
//          colours both forms are judged, unless the form is stated.
// Tests    tests/tools/compare_samples_test.cpp
#pragma once
#include <span>
#include <string>

#include "tools/oracle/run_input.h"
#include "tools/oracle/verdict/form.h"
#include "tools/oracle/verdict/resolved.h"

namespace strata::tools {

struct SamplesPicture {
    const oracle::Target& colors;
    bool is_form_stated = false;
    bool has_alpha = true;  // false: alpha is not compared
};

struct SamplesVerdict {
    oracle::verdict::ResolvedVerdict found{};
    oracle::verdict::Formed form{};  // of the picture's colours
    // What the picture is right by, if not by what was given: "the rules of profile llvmpipe". Empty: the given rules.
    std::string by{};
    std::string given{};             // the name of the given profile
    std::size_t wrong_by_given = 0;  // pixels
};

// `more`: profiles that are tried before the built-in ones. Throws Refused if the profile lacks the number of samples.
[[nodiscard]] SamplesVerdict judge_samples(const oracle::RunInput& input, const SamplesPicture& picture,
                                           std::span<const pipeline::DeviceProfile> more = {});

[[nodiscard]] std::string to_text(const SamplesVerdict& verdict);
[[nodiscard]] std::string to_json(const SamplesVerdict& verdict);

}  // namespace strata::tools
