// tools/oracle/passes/target_parts.h - targets of any format as parts of an EXR file.
//
// Rule     Half and binary32 channels are R G B A with their own bits. 8-bit ones are R G B A as values and Rbits ...
//          as codes, depths Z as a value and Zbits as the code, stencils S as the code: UINT32 all three. A target of
//          several samples is a part for each: NAME.sample0 ... Attributes: strata:format.color or strata:format.depth,
//          and strata:digest of the whole target.
// Tests    tests/tools/oracle/passes/passes_test.cpp
#pragma once
#include <span>
#include <string>

#include "pipeline/formats/image.h"

namespace strata::oracle {

struct NamedImage {
    std::string name;
    pipeline::Image image;
};

// All of one size, at least one, no two of one name.
void write_targets(const std::string& path, std::span<const NamedImage> targets);

}  // namespace strata::oracle
