// strata/render.h - renders a scene with an algorithm on a device: the picture, its layers, its fragments, every pass,
// and the history of a pixel.
//
// Rule     If the device cannot run a combination, render() returns a Rendering that is_refused(); its accessors, and
//          all other functions here, throw Refused with the missing feature. Input that is invalid on every device
//          throws InputError, which names the field. Concurrent calls on several threads are safe.
// Tests    tests/tools/library/render_test.cpp
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "strata/names.h"
#include "strata/picture.h"
#include "strata/scene.h"
#include "tools/oracle/explain/history_report.h"
#include "tools/oracle/passes/passes.h"

namespace strata {
inline namespace v0_1 {

using peeling::AuditResult;
using peeling::Multisampling;
using peeling::RenderOptions;
using pipeline::CapturedFragment;
using pipeline::Diagnostic;
using pipeline::Refused;

// The options of a frame by their names and texts on the command line: {{"samples", "4"}, {"depth-format", "d24"}}.
// The profile completes them; the option "origin" is set in it. Throws InputError, which names the option; Refused if
// the profile lacks the samples of the option "sample". The options of the scene and of its camera are not of a frame.
using NamedOptions = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] RenderOptions options_of(const NamedOptions& named, DeviceProfile& profile);

class Rendering {
  public:
    Rendering(const DeviceProfile& profile, peeling::RenderResult&& result);

    [[nodiscard]] bool is_refused() const noexcept { return refused_ != nullptr; }
    // The feature that the device lacks, as a sentence; "" unless it is refused.
    [[nodiscard]] std::string refusal() const;

    // Each of these throws Refused if the rendering was refused.
    [[nodiscard]] const Image& color() const { return drawn().frame.color; }
    // Of the nearest surface, opaque or transparent.
    [[nodiscard]] const Image& depth() const { return drawn().frame.depth; }
    [[nodiscard]] Picture picture() const;  // colour and depth, for comparisons
    [[nodiscard]] std::string digest() const { return pipeline::digest(color()); }
    [[nodiscard]] const AuditResult& audit() const { return drawn().audit; }  // all zero without RenderOptions::audit
    [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return drawn().frame.diagnostics; }
    [[nodiscard]] int geometry_passes() const { return drawn().frame.passes.geometry; }

  private:
    [[nodiscard]] const peeling::RenderResult& drawn() const;
    std::shared_ptr<const Refused> refused_;
    peeling::RenderResult result_;
};

// With several samples per pixel colour and depth are resolved, and counts are those of all samples
// (peeling/render.h).
[[nodiscard]] Rendering render(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                               const RenderOptions& options = {});

struct Layer {
    Image color, depth;           // colour premultiplied or not, as in Algorithm::premultiplied_layers
    bool is_from_behind = false;  // peeled from the far end, by an algorithm that peels both ends
};

// The layers from near to far; those of several samples are resolved.
[[nodiscard]] std::vector<Layer> layers(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                                        const RenderOptions& options = {});

// All fragments of transparent triangles, in submission order.
[[nodiscard]] std::vector<CapturedFragment> fragments(const Scene& scene, const Algorithm& algorithm,
                                                      const DeviceProfile& profile, const RenderOptions& options = {});

// Every pass with the contents of all targets after it, of all samples; the last entry is the picture.
[[nodiscard]] std::vector<oracle::PassReport> passes(const Scene& scene, const Algorithm& algorithm,
                                                     const DeviceProfile& profile, const RenderOptions& options = {});

// The history of pixel x, y, from the top left; oracle::to_text, to_json and to_svg format it.
[[nodiscard]] oracle::History explain(const Scene& scene, int x, int y, const Algorithm& algorithm,
                                      const DeviceProfile& profile, const RenderOptions& options = {});
// The histories of the pixel's samples, and its resolved value.
[[nodiscard]] oracle::SampledHistory explain_samples(const Scene& scene, int x, int y, const Algorithm& algorithm,
                                                     const DeviceProfile& profile, const RenderOptions& options);

// A user-defined algorithm, for the devices that have the features used by its passes. `body` is called for regions of
// the frame (pipeline/region/region.h), on several threads at once, and for some regions twice. With `whole_frame` it
// is called once, on one thread.
[[nodiscard]] Algorithm own_algorithm(std::string name, std::function<void(pipeline::Region&)> body,
                                      bool whole_frame = false);

}  // namespace v0_1
}  // namespace strata
