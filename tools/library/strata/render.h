// strata/render.h - a scene by an algorithm on a device: the picture, its layers, its fragments, every pass, and what
// happened at a pixel.
//
// Rule     A combination that the device cannot run gives no picture: a Rendering of it is_refused(), and whatever is
//          asked of it throws Refused with the missing feature; every other function here throws at once. Input of no
//          device throws InputError, which names the field. Calls on several threads do not disturb each other.
// Tests    tests/tools/library/render_test.cpp
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "strata/names.h"
#include "strata/picture.h"
#include "strata/scene.h"
#include "tools/oracle/history_report.h"
#include "tools/oracle/passes.h"

namespace strata {
inline namespace v0_1 {

using peeling::AuditResult;
using peeling::RenderOptions;
using pipeline::CapturedFragment;
using pipeline::Diagnostic;
using pipeline::Refused;

class Rendering {
  public:
    Rendering(const DeviceProfile& profile, peeling::RenderResult&& result);

    [[nodiscard]] bool is_refused() const noexcept { return refused_ != nullptr; }
    // What the device lacks, as a sentence; "" unless it is refused.
    [[nodiscard]] std::string refusal() const;

    // Each of these throws Refused where nothing was drawn.
    [[nodiscard]] const Image& color() const { return drawn().frame.color; }
    [[nodiscard]] const Image& depth() const { return drawn().frame.depth; }  // of the nearest surface, opaque or not
    [[nodiscard]] Picture picture() const;                                    // colour and depth, to be compared
    [[nodiscard]] std::string digest() const { return pipeline::digest(color()); }
    [[nodiscard]] const AuditResult& audit() const { return drawn().audit; }  // zeros without RenderOptions::audit
    [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return drawn().frame.diagnostics; }
    [[nodiscard]] int geometry_passes() const { return drawn().frame.passes.geometry; }

  private:
    [[nodiscard]] const peeling::RenderResult& drawn() const;
    std::shared_ptr<const Refused> refused_;
    peeling::RenderResult result_;
};

[[nodiscard]] Rendering render(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                               const RenderOptions& options = {});

struct Layer {
    Image color, depth;           // colour straight or times alpha, as Algorithm::premultiplied_layers says
    bool is_from_behind = false;  // taken by a peel from both ends at the far one
};

// Near to far.
[[nodiscard]] std::vector<Layer> layers(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                                        const RenderOptions& options = {});

// All fragments of transparent triangles, in submission order.
[[nodiscard]] std::vector<CapturedFragment> fragments(const Scene& scene, const Algorithm& algorithm,
                                                      const DeviceProfile& profile, const RenderOptions& options = {});

// Every pass with all targets as it leaves them; the last entry is the picture.
[[nodiscard]] std::vector<oracle::PassShown> passes(const Scene& scene, const Algorithm& algorithm,
                                                    const DeviceProfile& profile, const RenderOptions& options = {});

// What happened at the pixel, from the top left; oracle::to_text, to_json and to_svg tell it.
[[nodiscard]] oracle::History explain(const Scene& scene, int x, int y, const Algorithm& algorithm,
                                      const DeviceProfile& profile, const RenderOptions& options = {});

// An algorithm of the caller's own, on the devices that have what its passes use: `body` is run on regions of the frame
// (pipeline/region/region.h), of several threads at once and some of them twice. With `whole_frame` it runs once, on
// one thread.
[[nodiscard]] Algorithm own_algorithm(std::string name, std::function<void(pipeline::Region&)> body,
                                      bool whole_frame = false);

}  // namespace v0_1
}  // namespace strata
