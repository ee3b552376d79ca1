// pipeline/region/fragment_path.h - GeForce3's fragment path as a fragment program: texture shader, then register
// combiners.
//
// Rule     The state of a pass is a value; `apply` adds to it what the path needs. Coordinates come with the draw list
//          (PrepareOptions::units) or with the caller's TriangleSoup. A replaced depth is used instead of the
//          rasterizer's in depth units, stencil and depth test.
// Source   pipeline/reference/fragment-stages.md 1 (order); texture-shader.md 1; combiners.md 2 and 3.
// Tests    tests/pipeline/region/fragment_path_test.cpp, tests/peeling/listing2_test.cpp
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/geforce3/combiner.h"
#include "pipeline/geforce3/texture_shader.h"
#include "pipeline/lighting/fog_unit.h"
#include "pipeline/region/region.h"

namespace strata::pipeline {

// GeForce3's texture shader and register combiners, programmed for one pass. The stages and textures that it points to
// must outlive the pass. Without a shader every stage is NONE; default combiners give black, alpha 0. With fog the
// vertices have what fog_unit.h interpolates; a list with secondary colours provides that register.
struct FragmentPath {
    ShaderStages shader{};
    Combiners combiners;
    std::optional<FogRegisters> fog{};
};

class FragmentPathProgram {
  public:
    // Throws Refused if the profile has no NV_texture_shader, std::logic_error for combiner state that no device
    // supports.
    FragmentPathProgram(const Region& region, const FragmentPath& path);

    // Adds to `state` the values that the program reads, the depth targets that it samples, and whether it replaces
    // depth.
    void apply(PassState& state) const;
    void operator()(const FragmentBatch& in, const Loads& loads, Outputs& out);

  private:
    FragmentPath path_;
    ShaderOps ops_;
    std::uint32_t pixels_;
    bool has_secondary_;
    std::vector<ShaderDevice> devices_;  // by sample, whose depth targets it reads
    CombinerUnit combiners_;
    std::unique_ptr<ShaderResults> results_;
};

}  // namespace strata::pipeline
