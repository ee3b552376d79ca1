// pipeline/frame/frame.cpp - the functions of Frame that need the definition of PreparedDraw (frame.h).
#include "pipeline/frame/frame.h"

#include "pipeline/vertices/prepare.h"

namespace strata::pipeline {

rasterizer::Rect Frame::rect() const noexcept { return transparent->geometry.state.viewport; }
int Frame::samples() const noexcept { return static_cast<int>(transparent->samples()); }

}  // namespace strata::pipeline
