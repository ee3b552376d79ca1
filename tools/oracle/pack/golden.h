// tools/oracle/pack/golden.h - golden packs: derives a pack from a scene and its state, writes, reads and checks it.
//
// Rule     The format is tools/oracle/pack/PACK.md. Writing and checking use the same derivation with different sinks
//          for its files.
// Tests    tests/tools/oracle/pack/golden_test.cpp
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "peeling/algorithms/algorithm.h"
#include "peeling/frame_request.h"
#include "pipeline/device/profile.h"
#include "scenes/packs/pack_files.h"
#include "scenes/scene.h"

namespace strata::oracle {

// The input of a pack. The view is the scene's own.
struct Golden {
    scenes::Scene scene{};
    pipeline::ColorSpace color_space = pipeline::ColorSpace::encoded;
    pipeline::DeviceProfile profile{};
    peeling::RenderOptions options{};  // background in the frame's colour space
    std::vector<const peeling::Algorithm*> algorithms{};
    std::string command{};  // the command that writes the same pack

    [[nodiscard]] peeling::FrameRequest request() const {
        return {scene.list, scene.own_view.value(), profile, options, color_space};
    }
};

// Passes every file of the pack to `sink`, manifest.json last. Throws Refused if the profile lacks a feature.
void derive(const Golden& golden, const scenes::PackFiles::Sink& sink,
            const std::function<void(double share)>& progress = {});

// Copies written in addition to the arrays (exr_copies.h).
enum class Copies : std::uint8_t { none, exr };

// InputError unless the folder is missing or empty. Removed after a failure.
// `progress` gets the share of the algorithms whose results are written.
void write_pack(const Golden& golden, const std::string& folder, Copies copies = Copies::none,
                const std::function<void(double share)>& progress = {});

// `path` is a pack's folder or its manifest.
[[nodiscard]] Golden read_pack(const std::string& path);

// A file that differs from the expected one.
struct PackFault {
    std::string file, message{};  // "byte 1234, row 3, column 5, channel 1: expected 17, found 18"
};

// Empty if the pack is unchanged. Files are compared with the manifest's list, then with a new derivation on the
// instruction set `simd`, which this processor must have.
[[nodiscard]] std::vector<PackFault> check_pack(const std::string& path, Simd simd = Simd::best);

}  // namespace strata::oracle
