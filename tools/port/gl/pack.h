// tools/port/gl/pack.h - reads a golden pack and writes a candidate (oracle/PACK.md), with the port's own reader.
#pragma once
#include <string>
#include <vector>

#include "tools/port/algorithms/job.h"
#include "tools/port/gl/mesh.h"

namespace strata::port {

// What a pack of all samples asks for.
struct PackSampling {
    int samples = 1;
    std::string interpolation = "sample", loads = "own", composites = "own";
};

// The data that the port uses. Reading rejects every feature of a pack that the port cannot draw.
struct Pack {
    IndexedMesh mesh;
    FrameSize size;
    TargetFormats formats;
    std::array<float, 4> background{0, 0, 0, 1};
    bool zero_to_one = false;  // clip depths
    bool is_reversed = false;  // depths: the nearest is the greatest
    PackSampling sampling{};
    std::vector<std::string> algorithms;  // the algorithms of its results
};

// Throws std::runtime_error with the file, the JSON pointer, the expected and the found value.
[[nodiscard]] Pack read_pack(const std::string& folder);

// The result of one algorithm: the picture, and targets and layers if they were recorded.
struct Candidate {
    std::string algorithm;
    PixelCodes picture;
    Record record;
};
// Writes a folder that must not exist. It appears under its name when it is complete.
void write_candidate(const std::string& folder, const std::string& made_by, const std::vector<Candidate>& candidates);

}  // namespace strata::port
