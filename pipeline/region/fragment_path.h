// pipeline/region/fragment_path.h - GeForce3's fragment path as a fragment program: texture shader, then register
// combiners.
//
// Rule     The state of a pass is a value; `apply` tells the pass what it needs. Coordinates come with the draw list
//          (PrepareOptions::units) or with a TriangleSoup of one's own. A replaced depth takes the place of the
//          rasterizer's in depth units, stencil and depth test.
// Source   fragment-stages.md 1 (order); texture-shader.md 1; combiners.md 2 and 3.
// Tests    tests/pipeline/region/fragment_path_test.cpp, tests/peeling/listing2_test.cpp
#pragma once
#include <memory>

#include "pipeline/geforce3/combiner.h"
#include "pipeline/geforce3/texture_shader.h"
#include "pipeline/region/region.h"

namespace strata::pipeline {

// The GeForce3's texture shader and register combiners, programmed for one pass. Stages and textures that it points to
// outlive the pass. Without a shader every stage is NONE; default combiners give black, alpha 0.
struct FragmentPath {
    ShaderStages shader{};
    Combiners combiners;
};

class FragmentPathProgram {
  public:
    // Throws Refused where the profile has no NV_texture_shader, std::logic_error for combiner state that no machine
    // runs.
    FragmentPathProgram(const Region& region, const FragmentPath& path);

    // Adds to `state` what the program looks at, the depth targets that it samples, and whether it replaces depth.
    void apply(PassState& state) const;
    void operator()(const FragmentBatch& in, const Loads& own, Outputs& out);

  private:
    FragmentPath path_;
    ShaderOps ops_;
    ShaderMachine machine_;
    CombinerUnit combiners_;
    std::unique_ptr<ShaderResults> results_;
};

}  // namespace strata::pipeline
