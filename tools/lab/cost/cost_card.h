// tools/lab/cost/cost_card.h - estimates the time of a frame on the emulated graphics card from its published rates.
//
// Rule     The time of a frame is the longest of three: vertices of all geometry passes, fragments of all passes (a
//          full-screen pass has one per pixel), and bytes between stages and targets, each divided by the card's rate.
//          The three are assumed to overlap perfectly, so it is a lower bound.
// Source   scenes/reference/reports.md 10.3 lists every rate with its source and evidence mark.
// Tests    tests/tools/lab/cost/cost_card_test.cpp
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace strata::tools {

struct Card {
    std::string name;
    double vertices_a_second = 0, fragments_a_second = 0, bytes_a_second = 0;
};

// The card that a profile emulates: a GeForce3 for a profile with 8-bit targets and without programs, else a GeForce
// 8800 GTX.
[[nodiscard]] const Card& card_of(bool has_fragment_programs);

// The counted work of a frame, which does not depend on the machine that counts.
struct CardWork {
    std::uint64_t vertices = 0, fragments = 0, bytes = 0;
};
[[nodiscard]] double modelled_seconds(const Card& card, const CardWork& work);

// Carr et al. 2008, Table 1: seconds per frame for a scene file's name and an algorithm, if the paper timed both.
[[nodiscard]] std::optional<double> printed_seconds(const std::string& scene, const std::string& algorithm);

}  // namespace strata::tools
