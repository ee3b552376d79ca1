// tools/oracle/mistakes/experiment.h - a run that is about to be made, as values that a mistake may change.
//
// Rule     A mistake changes one field of the scene, of the machine or of the options, one step of the algorithm's own
//          run (an alteration), or the finished picture. It never brings an algorithm of its own.
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
#include "tools/oracle/picture.h"

namespace strata::oracle {

// Names of targets as the algorithm calls them; two of a pair have one name.
class Names {
  public:
    void add(pipeline::Target target, std::string_view name);
    [[nodiscard]] bool is(pipeline::Target target, std::string_view name) const;
    // The other target of that name where there are just two, else the target itself.
    [[nodiscard]] pipeline::Target partner(pipeline::Target target) const;

  private:
    std::vector<std::string> names_{};
};

// What is known of the right run before a wrong one is made.
struct RightRun {
    int passes = 0;           // geometry passes
    bool is_endless = false;  // it was stopped, and would have gone on
    int enough_passes =
        0;  // the least --max-passes that leaves the same picture; 0: it is not known, or one pass is all
};

struct Experiment {
    const pipeline::DrawList* list = nullptr;  // the caller's, or `own_list`
    pipeline::View view{};
    pipeline::DeviceProfile profile{};
    peeling::RenderOptions options{};
    const peeling::Algorithm* algorithm = nullptr;
    RightRun right{};
    std::vector<pipeline::Alteration> alterations{};
    std::vector<std::function<void(Picture&)>> afterwards{};  // what happens to the finished picture
    std::shared_ptr<Names> names = std::make_shared<Names>();
    std::shared_ptr<pipeline::DrawList> own_list{};
    std::shared_ptr<const pipeline::VertexAlteration> vertex_alteration{};  // the options' own

    // The scene, to be changed: a copy from the first call on.
    [[nodiscard]] pipeline::DrawList& scene();
    // Changes vertices behind all changes that there are.
    void alter_vertices(pipeline::VertexAlteration change);
};

// All alterations of an experiment as one; it must live while the experiment's run does.
[[nodiscard]] pipeline::Alteration combined(const Experiment& experiment);

}  // namespace strata::oracle
