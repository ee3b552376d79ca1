// tools/lab/hard_cases/hard_run.h - one hard case on one device at one depth format, with one algorithm after another.
// Rule     Each algorithm runs once with default settings. That run is audited and its fragments are counted
//          independently (composited.h). Then it runs in every other way that must not change a bit: literally, on two
//          threads, with all effects simulated, on each instruction set. Image, depths, passes, audit and diagnostics
//          must be those of the first run. Where a run takes seconds, the other ways are combined in one: literally,
//          on two threads, with all effects, without vector instructions. That is so if triangles times layers exceed
//          2^20, and for a frame of more than 2^24 pixels, which is only run with algorithms of one geometry pass.
//          The verdict is the first that holds:
//            failed    a NaN; a bit that another way of running changes; fragments lost or repeated without a
//                      diagnostic of exactly as many pixels; or an image beyond the case's bound for no such reason
//            breaks    fragments are lost, repeated, mixed or misplaced, and a diagnostic says so
//            degrades  every fragment of the device is composited once, but the device has other fragments or layers
//                      than exact geometry, or orders fragments of one key by submission, with an effect on the image;
//                      or the algorithm guarantees no order, and its image is beyond the bound
//            stable    none of these
// Tests    tests/tools/lab/hard_cases/hard_run_test.cpp
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "peeling/render_options.h"
#include "pipeline/device/profile.h"
#include "pipeline/frame/diagnostics.h"
#include "scenes/procedural/hard_cases/hard_case.h"
#include "tools/lab/hard_cases/composited.h"

namespace strata::peeling {
struct AuditResult;
struct RenderResult;
}  // namespace strata::peeling

namespace strata::tools {

class HardTruth;  // hard_truth.h

enum class HardVerdict : std::uint8_t { refused, stable, degrades, breaks, failed };
[[nodiscard]] std::string_view name_of(HardVerdict verdict) noexcept;
// In the order of tables.
inline constexpr std::array hard_verdicts{HardVerdict::stable, HardVerdict::degrades, HardVerdict::breaks,
                                          HardVerdict::failed, HardVerdict::refused};

struct HardRow {
    std::string refusal;  // the message; empty: it ran
    Composited found;
    std::vector<pipeline::Diagnostic> diagnostics;
    // From hard_truth.h, in 1/255: at pixels without and with fragments of equal keys.
    double difference = 0, difference_at_ties = 0;
    bool steps_planes = false;         // the device computes its planes in rounded steps; the truth does not
    double bound = 0;                  // of the image's error, by the case
    std::uint64_t nan_values = 0;      // in the image
    std::vector<std::string> unlike;   // ways of running that gave other bits
    std::vector<std::string> reasons;  // why the verdict is not `stable`
    HardVerdict verdict = HardVerdict::stable;
    std::string digest;  // of the image
};

// One case on one device. Not thread-safe.
class HardCaseRenderer {
  public:
    HardCaseRenderer(const scenes::HardCase& hard, const pipeline::DeviceProfile& profile, pipeline::DepthFormat depth);
    ~HardCaseRenderer();
    [[nodiscard]] HardRow run(const peeling::Algorithm& algorithm);

  private:
    struct Way;
    [[nodiscard]] std::vector<std::string> unlike_ways(const peeling::Algorithm& algorithm,
                                                       const peeling::RenderResult& first);

    const scenes::HardCase& hard_;
    pipeline::DeviceProfile profile_;
    scenes::Scene scene_;
    peeling::RenderOptions options_;
    std::unique_ptr<const HardTruth> truth_;
    std::vector<Way> ways_;
};

// The names of the ways in which every algorithm runs the case, the default first.
[[nodiscard]] std::vector<std::string> ways_of(const scenes::HardCase& hard);

// Size, depth range and one thread: the options common to all runs of the case.
[[nodiscard]] peeling::RenderOptions hard_options(const scenes::HardCase& hard,
                                                  std::optional<pipeline::DepthFormat> depth);

// True if the fault explains misplaced fragments.
[[nodiscard]] bool explains_misplaced(pipeline::Fault fault) noexcept;

// The complete result of the default run, for inspection.
[[nodiscard]] peeling::RenderResult picture_of(const scenes::HardCase& hard, const pipeline::DeviceProfile& profile,
                                               const peeling::Algorithm& algorithm);

// Sets the verdict of a row from its values alone.
void judge(HardRow& row, const scenes::HardCase& hard, const peeling::Algorithm& algorithm,
           const peeling::AuditResult& audit);

}  // namespace strata::tools
