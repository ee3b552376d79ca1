// tools/port/pack.h - what a port reads of a golden pack, and what it writes: oracle/PACK.md, by a reader of the port's
// own.
#pragma once
#include <string>
#include <vector>

#include "tools/port/algorithms/job.h"
#include "tools/port/mesh.h"

namespace strata::port {

// What the buffers of a pack say. Everything else that a pack can say and the port cannot draw is refused when it is
// read.
struct Pack {
    Mesh mesh;
    Size size;
    TargetFormats formats;
    std::array<float, 4> background{0, 0, 0, 1};
    bool zero_to_one = false;             // clip depths
    std::vector<std::string> algorithms;  // that it has results of
};

// Throws std::runtime_error with file, place, what was expected and what was found.
[[nodiscard]] Pack read_pack(const std::string& folder);

// What one algorithm made: the picture, and targets and layers if there is a record of them.
struct Candidate {
    std::string algorithm;
    Image picture;
    Record record;
};
// Writes a folder that must not exist. It appears under its name when it is complete.
void write_candidate(const std::string& folder, const std::string& made_by, const std::vector<Candidate>& candidates);

}  // namespace strata::port
