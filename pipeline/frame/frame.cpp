#include "pipeline/frame/frame.h"

#include "pipeline/vertices/prepare.h"

namespace strata::pipeline {

rasterizer::Rect Frame::rect() const noexcept { return transparent->geometry.state.viewport; }

}  // namespace strata::pipeline
