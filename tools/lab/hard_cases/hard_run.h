// tools/lab/hard_cases/hard_run.h - one hard case on one device at one depth format, by one algorithm after the other.
//
// Rule     Each algorithm runs once by default settings. That run is audited and its fragments are counted again
//          (composited.h). Then it runs in every other way that no bit may depend on: literally, on two threads, with
//          all effects simulated, on each instruction set. Picture, depths, passes, audit and diagnostics must be those
//          of the first run. Where triangles times layers exceed 2^20, a run that rasterizes every pass takes seconds:
//          there the literal run is the one with all effects. A frame of more than 2^24 pixels is for algorithms of one
//          geometry pass, and the other ways are one: literally, on two threads, with all effects, without vector
//          instructions. Verdict, the first that holds:
//            failed    a NaN, a bit that another way of running changes, fragments lost or repeated without a
//                      diagnostic of exactly as many pixels, or a picture beyond the case's bound for no such reason
//            breaks    fragments lost, repeated, mixed or misplaced, as a diagnostic says
//            degrades  every fragment of the device is composited once, but the device has other fragments or layers
//                      than exact geometry, or orders fragments of one key by their arrival, and that shows; or the
//                      algorithm promises no order, and its picture is beyond the bound
//            stable    none of these
// Tests    tests/tools/hard_cases/hard_run_test.cpp
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
// In the order in which tables have them.
inline constexpr std::array hard_verdicts{HardVerdict::stable, HardVerdict::degrades, HardVerdict::breaks,
                                          HardVerdict::failed, HardVerdict::refused};

struct HardRow {
    std::string refusal;  // the sentence; empty: it ran
    Composited found;
    std::vector<pipeline::Diagnostic> diagnostics;
    // From hard_truth.h, in 1/255: where no two fragments have one key, and where some have.
    double difference = 0, difference_at_ties = 0;
    bool steps_planes = false;         // the device rounds its planes step by step; the truth does not
    double bound = 0;                  // of it
    std::uint64_t nan_values = 0;      // of the picture
    std::vector<std::string> unlike;   // ways of running that gave other bits
    std::vector<std::string> reasons;  // why the verdict is not `stable`
    HardVerdict verdict = HardVerdict::stable;
    std::string digest;  // of the picture
};

// One case on one device; not for several threads at once.
class HardMachine {
  public:
    HardMachine(const scenes::HardCase& hard, const pipeline::DeviceProfile& profile, pipeline::DepthFormat depth);
    ~HardMachine();
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

// The names of the ways in which every algorithm runs the case, the default way first.
[[nodiscard]] std::vector<std::string> ways_of(const scenes::HardCase& hard);

// The frame, the depth range and one thread: how every machine sees the case.
[[nodiscard]] peeling::RenderOptions hard_options(const scenes::HardCase& hard,
                                                  std::optional<pipeline::DepthFormat> depth);

// Whether the fault explains fragments in wrong places.
[[nodiscard]] bool misplaces(pipeline::Fault fault) noexcept;

// The picture and everything else of the default run, for who wants to look at it.
[[nodiscard]] peeling::RenderResult picture_of(const scenes::HardCase& hard, const pipeline::DeviceProfile& profile,
                                               const peeling::Algorithm& algorithm);

// What a row says, from its figures alone.
void judge(HardRow& row, const scenes::HardCase& hard, const peeling::Algorithm& algorithm,
           const peeling::AuditResult& audit);

}  // namespace strata::tools
