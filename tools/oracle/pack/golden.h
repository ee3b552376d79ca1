// tools/oracle/pack/golden.h - golden packs: derived from a scene and its state, written, read, and derived again to be
// checked.
//
// Rule     tools/oracle/PACK.md is the format. One derivation serves writing and checking; only what takes its files
//          differs.
// Tests    tests/tools/oracle/golden_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/render_options.h"
#include "pipeline/device/profile.h"
#include "scenes/packs/pack_files.h"
#include "scenes/scene.h"

namespace strata::oracle {

// What a pack is made of. The view is the scene's own.
struct Golden {
    scenes::Scene scene{};
    pipeline::ColorSpace color_space = pipeline::ColorSpace::encoded;
    pipeline::DeviceProfile profile{};
    peeling::RenderOptions options{};  // background in the frame's colour space
    std::vector<const peeling::Algorithm*> algorithms{};
    std::string command{};  // that makes the same pack
};

// Every file of the pack, manifest.json last. Throws Refused for what the profile lacks.
void derive(const Golden& golden, const scenes::PackFiles::Sink& sink);

// What stands beside the arrays (exr_copies.h).
enum class Copies : std::uint8_t { none, exr };

// Into a folder that is not there yet or is empty, else InputError. A failure leaves nothing behind.
void write_pack(const Golden& golden, const std::string& folder, Copies copies = Copies::none);

// `path` is a pack's folder or its manifest.
[[nodiscard]] Golden read_pack(const std::string& path);

// A file that is not what it ought to be.
struct PackFault {
    std::string file, sentence{};  // "byte 1234, row 3, column 5, channel 1: expected 17, found 18"
};

// Empty for a pack as it was written. Files are compared with what the manifest says of them, then with what is derived
// again. Derived on the instruction set `simd`, which this processor has.
[[nodiscard]] std::vector<PackFault> check_pack(const std::string& path, Simd simd = Simd::best);

}  // namespace strata::oracle
