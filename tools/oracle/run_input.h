// tools/oracle/run_input.h - the input of a run: a scene, a camera, a device profile and options.
#pragma once
#include "peeling/render_options.h"
#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {
struct DeviceProfile;
}

namespace strata::oracle {

// Referenced objects must outlive the run.
struct RunInput {
    const pipeline::DrawList& list;
    const pipeline::View& view;
    const pipeline::DeviceProfile& profile;
    peeling::RenderOptions options;  // execution, audit and layers are set by the function that runs it
    pipeline::ColorSpace space = pipeline::ColorSpace::encoded;  // of the scene's colours and the frame's
};

}  // namespace strata::oracle
