// tools/oracle/judge/asked_picture.h - a picture of a scene on which a judgement is asked, and what is known of it.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/oracle/compare/compare.h"
#include "tools/oracle/show_progress.h"

namespace strata::peeling {
struct Algorithm;
}
namespace strata::pipeline {
struct DeviceProfile;
}

namespace strata::oracle {

struct PassPicture;  // tools/oracle/emulations/pass_evidence.h

// Everything that it refers to must outlive the call only.
struct AskedPicture {
    const Picture& candidate;                         // with colours
    bool is_form_stated = false;                      // the caller states whether colours are straight or premultiplied
    bool has_alpha = true;                            // false: alpha is not compared
    const peeling::Algorithm* algorithm = nullptr;    // that the port runs; null: not known, and emulations run dual
    std::string camera = "the given camera";          // in words, for a hint that it may be another
    std::span<const pipeline::DeviceProfile> more{};  // profiles that are tried before the built-in ones
    // Of emulations: what is forgiven, the passes after which the port gives up (0: unknown), and its passes.
    Tolerances tolerances{};
    int limit = 0;
    const std::vector<PassPicture>* passes = nullptr;
    // If the frame had the other color space; empty: not asked. `is_narrow`: by rounding that leaves little open.
    std::function<bool(bool is_narrow)> is_right_in_other_space{};
    ShowProgress layers{}, view{}, emulations{}, pairs{};
};

// The candidate's colours. Throws InputError if it has none.
[[nodiscard]] const TargetImage& colors_of(const Picture& candidate);

}  // namespace strata::oracle
