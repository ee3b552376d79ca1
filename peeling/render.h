// peeling/render.h - renders a draw list into a finished frame with its statistics, in one call. Used by tools and
// tests.
//
// Rule     Options that are invalid on every profile throw InputError. A combination that this profile lacks gives a
//          refusal that names the feature, checked in the order of pipeline/reference/devices.md 9.2. Defaults are
//          those of devices.md 11. Kernels run on the instruction set that the options name, in the calling thread and
//          in the workers. With several samples per pixel the picture and the layers are resolved, and depth is the
//          nearest of the samples; counts are sums over the samples.
// Tests    tests/peeling/comparison_test.cpp, frame/refusals_test.cpp, frame/samples_test.cpp
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "peeling/audit/audit_result.h"
#include "peeling/frame_request.h"
#include "peeling/registry.h"
#include "pipeline/frame/captured_fragment.h"
#include "pipeline/frame/frame_result.h"
#include "pipeline/frame/instruments.h"

namespace strata::rasterizer {
struct SetupCounters;
}
namespace strata::peeling {

struct RegionTrace;  // peeling/audit/region_trace.h

enum class Outcome : std::uint8_t { done, refused };

struct Seconds {
    double geometry = 0, passes = 0;
    double audit = 0;  // time of the audit while regions ran, as its share of the wall clock
};

// If `refusal` is set nothing was drawn, and frame and audit are empty.
struct RenderResult {
    Outcome outcome = Outcome::done;
    std::optional<pipeline::Refusal> refusal;
    pipeline::FrameResult frame;
    AuditResult audit;
    Seconds seconds;
};

struct FrameFragments {
    // Sample by sample, each in submission order; `pixel` is row-major in the frame.
    std::vector<pipeline::CapturedFragment> all;
    std::vector<std::uint32_t> opaque;  // per pixel of each sample: the opaque surface's depth in the algorithm's key
    std::size_t samples = 1;            // of a pixel
    [[nodiscard]] FrameFragments of_sample(std::size_t sample) const;
    static constexpr std::uint64_t bytes_per_fragment = 64;  // per fragment, including the copy that the file writer
                                                             // makes
};

// Holds the work that is done once for all algorithms of a command: transform, clipping, set-up and binning.
class Renderer {
  public:
    // Throws InputError, which names the field, for options that are invalid on every profile and for a list whose
    // parts are inconsistent. The list must outlive the renderer.
    explicit Renderer(const FrameRequest& request);
    Renderer(const pipeline::DrawList& list, const pipeline::View& view, const pipeline::DeviceProfile& profile,
             const RenderOptions& options)
        : Renderer(FrameRequest{list, view, profile, options}) {}
    Renderer(pipeline::DrawList&& list, const pipeline::View& view, const pipeline::DeviceProfile& profile,
             const RenderOptions& options) = delete;  // a temporary list would dangle
    ~Renderer();

    // If the profile cannot run a combination the result has a refusal; no exception is thrown. Throws InputError if
    // the fragments of one pixel do not fit into the audit's memory.
    [[nodiscard]] RenderResult render(const Algorithm& algorithm, const std::function<void(double)>& progress = {},
                                      const pipeline::Instruments& instruments = {});

    // Renders without an audit; `traces` receives the trace of every region.
    [[nodiscard]] RenderResult render_traced(const Algorithm& algorithm, std::vector<RegionTrace>& traces,
                                             const pipeline::Instruments& instruments = {});

    // One depth pass of the same triangles drawn as opaque (LESS, no colour), as a baseline for the cost of peeling.
    // The depths are in frame.depth.
    [[nodiscard]] RenderResult depth_pass(const std::function<void(double)>& progress = {},
                                          const pipeline::Instruments& instruments = {});

    // Every fragment of the frame, with key and colour, as written by `strata layers --deep`. Throws Refused, and
    // InputError if the fragments take more than the audit's memory.
    [[nodiscard]] FrameFragments fragments(const Algorithm& algorithm);

    [[nodiscard]] pipeline::DepthFormat depth_format() const noexcept;
    [[nodiscard]] pipeline::Format color_format() const noexcept;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::peeling
