// tools/oracle/emulations/altered_run.h - the input of a run, as values that a mistake may change.
//
// Rule     A mistake changes one field of the scene, of the device or of the options, one step of the algorithm's run
//          (an alteration), the samples of a pixel, or the finished image. It never replaces the algorithm.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/render_options.h"
#include "pipeline/device/profile.h"
#include "pipeline/frame/alteration.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/prepare.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

// Names of targets as given by the algorithm; the two targets of a pair have the same name.
class Names {
  public:
    void add(pipeline::Target target, std::string_view name);
    [[nodiscard]] bool is(pipeline::Target target, std::string_view name) const;
    // The other target of that name if there are exactly two, else the target itself.
    [[nodiscard]] pipeline::Target partner(pipeline::Target target) const;

  private:
    std::vector<std::string> names_{};
};

// Facts about the correct run, which is made first.
struct RightRun {
    int passes = 0;           // geometry passes
    bool is_endless = false;  // it was stopped by a limit before it ended
    int enough_passes = 0;    // the least --max-passes that gives the same image; 0: unknown, or there is only one pass
};

struct AlteredRun {
    const pipeline::DrawList* list = nullptr;  // the caller's list, or `own_list`
    pipeline::View view{};
    pipeline::DeviceProfile profile{};
    peeling::RenderOptions options{};
    const peeling::Algorithm* algorithm = nullptr;
    RightRun right{};
    std::vector<pipeline::Alteration> alterations{};
    // Of several samples per pixel: makes the image of the samples' images instead of the resolve.
    std::function<pipeline::Image(const std::vector<pipeline::Image>& samples)> resolve{};
    std::vector<std::function<void(Picture&)>> afterwards{};  // changes to the finished image
    std::shared_ptr<Names> names = std::make_shared<Names>();
    std::shared_ptr<pipeline::DrawList> own_list{};
    std::shared_ptr<const pipeline::VertexAlteration> vertex_alteration{};  // owns the one in the options

    // The scene, to be changed; the first call makes a copy.
    [[nodiscard]] pipeline::DrawList& scene();
    // Adds a change of the vertices after all previous ones.
    void alter_vertices(pipeline::VertexAlteration change);
};

// All alterations of an experiment as one; it must live while the experiment runs.
[[nodiscard]] pipeline::Alteration combined(const AlteredRun& experiment);

}  // namespace strata::oracle
