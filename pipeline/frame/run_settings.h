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

// The sample that a program's loads read: its own, sample 0, or all of them resolved
// (pipeline/reference/fragment-stages.md 13.5 and 13.3).
enum class LoadedSample : std::uint8_t { own, zero, resolved };

// How a picture is computed from its samples. box: the mean of a pixel's own samples. quincunx: NV20's filter for two
// samples per pixel, which also reads samples of the neighbouring pixels.
enum class Resolve : std::uint8_t { box, quincunx };

enum class Effects : std::uint8_t { needed, all };  // all: simulate every stage even if nothing needs it; same bits

}  // namespace strata::pipeline
