// tools/oracle/judge/judge.h - the one judge of a picture of a scene: is it right, and if not, what made it?
//
// Rule     `strata compare`, `strata diagnose`, the C++ library, Python and the reports print its answer, and decide
//          nothing. The layers are asked first. Emulations decide what the layers leave open: a picture that is that of
//          a right run with other options is right, one that is that of a mistake is wrong. Of algorithms whose layers
//          are in no order emulations are asked first. More effort names more mistakes; it never changes a picture from
//          right to wrong or back.
// Tests    tests/tools/library/judge_test.cpp, tests/tools/strata/compare/one_judge_test.cpp
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/judge/asked_picture.h"

namespace strata::oracle {

struct LayersVerdict;
struct PictureDiagnosis;

// single: layers, and single emulations of what they leave open (emulated.h). all: every emulation, and pairs of them.
// Both fit a program to what is still open (program/fit/fitting.h), of at most 1,000,000 fragments.
enum class Effort : std::uint8_t { single, all };

enum class JudgedState : std::uint8_t {
    right,
    right_otherwise,    // by the rules of another profile or origin, or with other options
    undecided,          // a right port may leave the picture, but not all mistakes were excluded
    explained,          // wrong; mistakes explain the whole picture
    explained_in_part,  // wrong; something explains some of the wrong pixels
    not_explained
};
[[nodiscard]] std::string_view name(JudgedState state) noexcept;

struct Judgement {
    JudgedState state = JudgedState::not_explained;
    bool is_right = false, is_undecided = false;
    std::string sentence{};                                // "right: ...", "not decided: ..." or "wrong: ..."
    std::vector<std::string> mistakes{};                   // each explains the whole picture
    std::vector<std::string> forgotten{};                  // which option of the view looks forgotten (forgotten.h)
    std::vector<std::string> leads{};                      // what explains some of the wrong pixels
    std::string text{}, json{};                            // as the commands print them
    std::shared_ptr<const LayersVerdict> layers{};         // null if passes decided alone
    std::shared_ptr<const PictureDiagnosis> emulations{};  // of all effort
};

// Objects that `input` refers to must outlive the judgement. Throws InputError for a picture without colours, and
// Refused if the device lacks a feature.
[[nodiscard]] Judgement judge(const peeling::FrameRequest& input, const AskedPicture& asked, Effort effort);

}  // namespace strata::oracle
