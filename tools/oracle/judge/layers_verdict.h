// tools/oracle/judge/layers_verdict.h - what the layers say of a picture, with one sample per pixel or several.
//
// Tests    tests/tools/library/judge_test.cpp
#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/judge/asked_picture.h"
#include "tools/oracle/verdict/picture_verdict.h"
#include "tools/oracle/verdict/resolved.h"

namespace strata::oracle {

struct LayersVerdict {
    std::optional<verdict::PictureVerdict> single{};  // of one sample per pixel; else:
    std::optional<verdict::ResolvedVerdict> samples{};

    [[nodiscard]] bool is_right() const noexcept;
    [[nodiscard]] bool is_undecided() const noexcept;
    [[nodiscard]] bool is_explained() const noexcept;       // a mistake explains the whole picture
    [[nodiscard]] bool is_by_other_rules() const noexcept;  // of another profile or origin than those given
    [[nodiscard]] std::uint64_t lost_at_ties() const noexcept;
    [[nodiscard]] const std::vector<std::uint32_t>& wrong_colors() const noexcept;  // pixels, ascending
    [[nodiscard]] verdict::Colors colors() const;
    // Sentences: the mistakes that explain the whole picture, and what explains some of the wrong pixels.
    [[nodiscard]] std::vector<std::string> mistakes(const pipeline::DrawList& list) const;
    [[nodiscard]] std::vector<std::string> leads(const pipeline::DrawList& list) const;
    void drop_leads();
    // The first line is the verdict.
    [[nodiscard]] std::string text(const pipeline::DrawList& list) const;
    [[nodiscard]] nlohmann::ordered_json json(const peeling::FrameRequest& input) const;
};

// Throws Refused if the device lacks the number of samples.
[[nodiscard]] LayersVerdict judge_layers(const peeling::FrameRequest& input, const AskedPicture& asked);

}  // namespace strata::oracle
