// peeling/frame_request.h - what a frame is drawn from: a list, a view, a device and options.
//
// Rule     A request is made once, complete, and never written again; a function that draws with other options takes a
//          copy, with(options).
#pragma once
#include <utility>

#include "peeling/render_options.h"
#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {
struct DeviceProfile;
}

namespace strata::peeling {

// Referenced objects must outlive the request and what is made from it.
struct FrameRequest {
    const pipeline::DrawList& list;
    const pipeline::View& view;
    const pipeline::DeviceProfile& profile;
    RenderOptions options;  // execution, audit and layers are set by the function that draws
    pipeline::ColorSpace space = pipeline::ColorSpace::encoded;  // of the list's colours and the frame's

    [[nodiscard]] FrameRequest with(RenderOptions others) const {
        return {list, view, profile, std::move(others), space};
    }
    // The same frame on another device.
    [[nodiscard]] FrameRequest on(const pipeline::DeviceProfile& other, RenderOptions others) const {
        return {list, view, other, std::move(others), space};
    }
};

}  // namespace strata::peeling
