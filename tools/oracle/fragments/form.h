// tools/oracle/fragments/form.h - decides whether the colours of a picture file are straight or premultiplied.
//
// Rule     PNG, TGA, BMP and TIFF have straight colours by definition, but many programs store premultiplied ones in
//          them. If alpha makes a difference, both forms are compared with a sample of the scene's pixels, and the one
//          with fewer wrong pixels is used.
// Tests    tests/tools/oracle/search/alpha_test.cpp
#pragma once
#include <optional>
#include <string>

#include "tools/oracle/fragments/sample.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle::verdict {

struct Formed {
    TargetImage target{};  // premultiplied
    ChannelUse use{};
    bool is_chosen = false;  // alpha makes a difference, and no option states the form
    [[nodiscard]] Colors colors() const { return Colors{target, use}; }
    [[nodiscard]] std::string description() const;  // "" if the form was not chosen
};

// The target with codes of 8 bits if its floats are all values of such codes: a target of 8 bits that a file of floats
// holds. Empty otherwise.
[[nodiscard]] std::optional<TargetImage> in_codes(const TargetImage& target);

// `is_stated`: an option states the target's form; no other form is tried.
[[nodiscard]] Formed formed(const SceneFragments& scene, const TargetImage& target, bool is_stated);

}  // namespace strata::oracle::verdict
