// tools/oracle/mistakes/catalogue.h - the deliberately wrong machines that a diagnosis tries, each one field or one
// line of a right one.
//
// Rule     The order is that of the lists: of several mistakes that make one picture the first is named. A mistake that
//          cannot be made on an experiment (no texture to turn over, no stencil to wrap) says so.
// Tests    tests/tools/oracle/mistakes/catalogue_test.cpp: each shows in a scene of the suite, and no two are alike in
//          all of them
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "tools/oracle/mistakes/experiment.h"

namespace strata::oracle {

// What a mistake changes.
enum class Place : std::uint8_t { scene, machine, steps, programs, picture };

struct Mistake {
    std::string name{};      // "one_pass_too_few"
    std::string sentence{};  // as it stands behind "the pixels are those of: "
    Place place{};
    // False: this experiment has nothing that the mistake could change.
    std::function<bool(Experiment& experiment)> make{};
    bool is_allowed = false;  // a right port may do so: an option of machine_options.h
};

[[nodiscard]] std::span<const Mistake> catalogue();
// Null if there is no such mistake.
[[nodiscard]] const Mistake* find_mistake(std::string_view name);

// The parts of the catalogue, a file each.
[[nodiscard]] std::span<const Mistake> mistakes_of_scene();
[[nodiscard]] std::span<const Mistake> mistakes_of_machine();
[[nodiscard]] std::span<const Mistake> mistakes_of_steps();
[[nodiscard]] std::span<const Mistake> mistakes_of_programs();
[[nodiscard]] std::span<const Mistake> mistakes_of_picture();

}  // namespace strata::oracle
