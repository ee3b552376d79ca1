// tools/oracle/passes/passes.h - reports every pass of an algorithm with the content of all targets after it.
//
// Rule     The run is literal, with the passes of the device. A pass is reported when it has ended and its queries are
//          answered, together with the clears and copies before it. Targets have the names that the algorithm gives
//          them; the second of one name is NAME.1, and so on: a pair that is swapped keeps its names. Under reversed
//          depth, depth targets are reported as depths; colour targets that contain depths contain keys
//          (rasterizer/rules/depth_key.h). The last entry is the published image.
//          With several samples per pixel targets contain all samples, counts are of samples, and the published image
//          is the resolved one. The targets of one pass are in memory at a time.
// Tests    tests/tools/oracle/passes/passes_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/frame_request.h"
#include "pipeline/frame/alteration.h"
#include "pipeline/frame/observer.h"
#include "tools/oracle/passes/target_parts.h"

namespace strata::oracle {

enum class ReportedPassKind : std::uint8_t { geometry, full_screen, published };
[[nodiscard]] std::string_view name(ReportedPassKind kind) noexcept;

struct Query {
    std::uint64_t count = 0;
    bool goes_on = false;
};

struct PassReport {
    int number = 0;  // from 0
    ReportedPassKind kind{};
    int iteration = 0;                  // 0: before the first iteration
    std::vector<std::string> before{};  // "clear front", "copy opaque_depth to nearest"
    std::vector<std::string> reads{}, writes{};
    std::uint64_t passed = 0, tallied = 0;  // fragments that passed all tests; events that the program counts
    std::vector<NamedImage> targets{};      // all existing targets, the opaque scene's first
    std::vector<Query> queries{};           // about the pass, answered before the next one
};

// Calls `on_pass` for one pass after another; it may keep the images. Throws Refused if the profile lacks a feature.
// `alteration`, unless null, makes a run with a mistake.
void passes(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
            const std::function<void(PassReport&&)>& on_pass, const pipeline::Alteration* alteration = nullptr);

// Names of targets by their numbers, for observers.
class TargetNames {
  public:
    void add(pipeline::Target target, std::string_view name);
    [[nodiscard]] std::string of(pipeline::Target target) const;

  private:
    std::vector<std::string> names_{"opaque_depth", "opaque_color"};
};

// Renders literally, without an audit, for an observer, and returns the published picture. Throws Refused.
pipeline::Image observe(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                        const pipeline::Observer& observer, const pipeline::Alteration* alteration = nullptr);

}  // namespace strata::oracle
