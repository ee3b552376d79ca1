// pipeline/frame/run_settings.h - the options of a run: how it is executed, when it ends, by which depth it orders,
// what it simulates.
#pragma once
#include <cstdint>

namespace strata::pipeline {

// Over the whole frame, or tile by tile; replay without fragment memory rasterizes every pass
// (pipeline/region/executor.h).
enum class Execution : std::uint8_t { literal, replay };

// How occlusion queries end a peel (peeling/reference/keys-and-counts.md 3.1).
enum class TerminationRule : std::uint8_t { exact, paper, any, ratio, fixed };
struct Termination {
    TerminationRule rule = TerminationRule::exact;
    double ratio = 0;  // ratio: stop when the count is below ratio * width * height
    int passes = 0;    // fixed: this many geometry passes, no query
    friend bool operator==(const Termination&, const Termination&) = default;
};

// The depth by which an algorithm orders fragments (keys-and-counts.md 1.1).
enum class DepthKey : std::uint8_t { shader_z, stored_code };

// The form of a listing with errata: repaired with minimal changes, or as printed.
enum class Formulation : std::uint8_t { resolved, published };

enum class Effects : std::uint8_t { needed, all };  // all: simulate every stage even if nothing needs it; same bits

}  // namespace strata::pipeline
