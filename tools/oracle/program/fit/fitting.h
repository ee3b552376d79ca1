// tools/oracle/program/fit/fitting.h - judges a picture by fitting a program to it: is the right program narrowly
// right, and if not, which edits explain what is seen?
//
// Rule     A picture is right if rounding alone explains it (score.h, is_narrow), cheaply, or if it does and no edit
//          explains it at less than 0.12 of its cost. Otherwise one edit is searched and proved, then two plain ones
//          (pairs.h), then a second one on top of the best that costs less than 0.8 of the right program; at last,
//          an edit that no property tells where it is made (at_random.h). Explanations
//          that predict the same picture are one, with several sentences, the plainest first.
// Numbers  Of pictures of more than 65,536 pixels every nth is searched, 32,768 in all; explanations are proved on all.
// Tests    tests/tools/oracle/program/found_test.cpp, right_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/oracle/program/fit/prove.h"

namespace strata::oracle::program {

struct Fitting {
    enum class State : std::uint8_t { right, explained, explained_in_part, not_explained };

    State state = State::not_explained;
    Fitness right{};             // of the right program
    std::vector<Proof> found{};  // that explain the picture, or a part of it; plainest first
    [[nodiscard]] bool is_right() const noexcept { return state == State::right; }
};

[[nodiscard]] Fitting fit(const Lists& lists);

// What explains the picture with one more edit on top of a program that explains a part of it.
[[nodiscard]] std::vector<Proof> with_one_more(const Lists& lists, const Proof& base, const Fitness& right);

// "of back faces and with depth at least 0.7"
[[nodiscard]] std::string joined_words(std::span<const Condition> conditions);
// "all fragments of back faces have alpha times 0.5"
[[nodiscard]] std::string describe(const Program& program);
// One sentence about the picture, and a line for each further explanation.
[[nodiscard]] std::string to_text(const Fitting& fitting);

}  // namespace strata::oracle::program
