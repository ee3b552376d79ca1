// pipeline/region/frame_pictures.h - the pictures of a frame's result, written region by region.
//
// Rule     Regions are disjoint, so threads that write them do not conflict. With several samples per pixel the picture
//          and the depth are resolved; Quincunx reads samples of neighbouring pixels and is computed at the end.
// Source   pipeline/reference/fragment-stages.md 13.3 and 13.4.
// Tests    tests/peeling/frame/samples_test.cpp
#pragma once
#include "pipeline/frame/frame_result.h"
#include "pipeline/stages/target_handle.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

struct Frame;
class Region;

class FramePictures {
  public:
    // Makes the pictures of `result`, which must outlive this object.
    FramePictures(const Frame& frame, FrameResult& result);

    void write(Region& region, Target published);
    void write_nearest(Region& region);
    // Copies a part of the frame to its position.
    void copy_into(const Image& part, const rasterizer::Rect& at, Image& whole) const;
    // Copies what a region shows to another region of the same size.
    void copy(const rasterizer::Rect& from, const rasterizer::Rect& to);
    void finish();

  private:
    const Frame& frame_;
    FrameResult& result_;
};

}  // namespace strata::pipeline
