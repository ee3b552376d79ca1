// pipeline/frame/frame.cpp - Frame::rect, which needs the definition of PreparedDraw (frame.h).
#include "pipeline/frame/frame.h"

#include "pipeline/vertices/prepare.h"

namespace strata::pipeline {

rasterizer::Rect Frame::rect() const noexcept { return transparent->geometry.state.viewport; }

}  // namespace strata::pipeline
