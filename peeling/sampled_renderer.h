// peeling/sampled_renderer.h - renders a frame of one or several samples per pixel in one call.
//
// Rule     Every sample is a frame of its own, composited by the algorithm; then the samples are resolved. Sample
//          shading: fragments are evaluated at the sample's position. Pixel shading (RasterState::interpolation): all
//          but coverage and the stored depth is evaluated at the pixel's centre or centroid. Counters, order errors,
//          diagnostics and work are summed over the samples; passes, layers, the fragments of the deepest pixel and
//          differences are the maximum of the samples. Layer k of the frame is resolved from layer k, from the same
//          end, of every sample; a sample without such a layer has codes of 0. Depth is the nearest of the samples.
// Source   pipeline/reference/fragment-stages.md 13
// Tests    tests/peeling/frame/sampled_renderer_test.cpp
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "peeling/multisampling.h"
#include "peeling/render.h"

namespace strata::peeling {

// True if what a sample's frame does depends on the others, so that the frames of all samples advance together: it
// loads what they store, or a query that is compared with a share of the frame, or a limit of passes over several
// loops, counts them all.
[[nodiscard]] bool is_joint(const Algorithm& algorithm, const RenderOptions& options,
                            const Multisampling& sampling) noexcept;

class SampledRenderer {
  public:
    // Throws InputError as Renderer does, and for another number of samples. `list` must outlive this object.
    SampledRenderer(const pipeline::DrawList& list, const pipeline::View& view, const pipeline::DeviceProfile& profile,
                    const RenderOptions& options, const Multisampling& multisampling);
    SampledRenderer(pipeline::DrawList&& list, const pipeline::View& view, const pipeline::DeviceProfile& profile,
                    const RenderOptions& options, const Multisampling& multisampling) = delete;
    ~SampledRenderer();

    // Renders and resolves. The result has a refusal where Renderer::render has one, if the profile lacks the number of
    // samples or the filter, and, for several samples, if the algorithm stores fragments in samples. `own_colors`,
    // unless null, receives the picture of each sample. `instruments`: none, or those of each sample, whose frames then
    // advance together, step by step and each on a thread of its own, so that all have the same passes. Throws
    // std::invalid_argument if some have an observer and others none.
    [[nodiscard]] RenderResult render(const Algorithm& algorithm, const std::function<void(double)>& progress = {},
                                      std::vector<pipeline::Image>* own_colors = nullptr,
                                      std::span<const pipeline::Instruments> instruments = {});

    // The frame of each sample without an audit, with its traces. Results with a refusal where it is refused.
    [[nodiscard]] std::vector<RenderResult> render_traced(const Algorithm& algorithm,
                                                          std::vector<std::vector<RegionTrace>>& traces);

    // The renderer of sample `number`, from 0 on. It keeps its prepared lists from frame to frame.
    [[nodiscard]] Renderer& sample(std::size_t number);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::peeling
