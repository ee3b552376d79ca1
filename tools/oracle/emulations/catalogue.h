// tools/oracle/emulations/catalogue.h - the catalogue of deliberate mistakes that a diagnosis tries; each changes one
// field or one line of a correct run.
//
// Rule     The order is that of the lists: if several mistakes give the same image, the first is reported. `make`
//          returns false if a mistake is not applicable to an experiment (no texture to flip, no stencil to wrap).
// Tests    tests/tools/oracle/emulations/catalogue_test.cpp: each changes the image of at least one scene of the suite,
//          and no two give equal images in all of them
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "tools/oracle/emulations/altered_run.h"

namespace strata::oracle {

// What a mistake changes.
enum class ChangedPart : std::uint8_t { scene, device, steps, programs, samples, picture };

struct Mistake {
    std::string name{};         // "one_pass_too_few"
    std::string description{};  // the text that follows "the pixels are those of: "
    ChangedPart part{};
    // Returns false if the experiment has nothing that the mistake could change.
    std::function<bool(AlteredRun& experiment)> make{};
    bool is_allowed = false;  // a correct port may do this: an option of allowed_options.h
};

[[nodiscard]] std::span<const Mistake> catalogue();
// Null if there is no mistake of that name.
[[nodiscard]] const Mistake* find_mistake(std::string_view name);

// The parts of the catalogue, one file each; those of single algorithms come first.
[[nodiscard]] std::span<const Mistake> mistakes_of_scene();
[[nodiscard]] std::span<const Mistake> mistakes_of_device();
[[nodiscard]] std::span<const Mistake> mistakes_of_steps();
[[nodiscard]] std::span<const Mistake> mistakes_of_programs();
[[nodiscard]] std::span<const Mistake> mistakes_of_fixed_passes();
[[nodiscard]] std::span<const Mistake> mistakes_of_reported_ports();
[[nodiscard]] std::span<const Mistake> mistakes_of_samples();
[[nodiscard]] std::span<const Mistake> mistakes_of_picture();

}  // namespace strata::oracle
