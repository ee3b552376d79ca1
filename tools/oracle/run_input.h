// tools/oracle/run_input.h - what a run is made from: a scene, a camera, a device and what a caller chooses.
#pragma once
#include "peeling/render_options.h"

namespace strata::pipeline {
struct DeviceProfile;
}

namespace strata::oracle {

// References must live as long as the run.
struct RunInput {
    const pipeline::DrawList& list;
    const pipeline::View& view;
    const pipeline::DeviceProfile& profile;
    peeling::RenderOptions options;  // execution, audit and layers are set by those who run
};

}  // namespace strata::oracle
