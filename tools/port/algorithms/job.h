// tools/port/algorithms/job.h - an algorithm with its targets and programs created, so that only drawing is timed.
#pragma once
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "tools/port/gl/gpu_scene.h"

namespace strata::port {

// Formats of a job's targets; images of `depth` are depths, the others colours.
struct TargetFormats {
    PixelFormat color = rgba8;  // or rgba16f, rgba32f
    PixelFormat depth = d32f;   // or d16, d24
};

struct JobInput {
    const GpuScene& scene;
    FrameSize size;
    TargetFormats formats{};
    std::array<float, 4> background{0, 0, 0, 1};
    PortSettings settings{};
};

struct NamedTexture {
    std::string name;
    GLuint texture = 0;
    PixelFormat format;
};
struct NamedPicture {
    std::string name;
    PixelCodes image;
};

// Every target after a pass, as read back, and the result of the pass's query.
struct RecordedPass {
    std::string kind;  // geometry or full_screen
    std::vector<NamedPicture> targets;
    std::optional<std::uint64_t> query;
};

// The recorded passes and layers of a run.
struct Record {
    std::vector<RecordedPass> passes{};
    std::vector<std::array<PixelCodes, 2>> layers{};  // colour and depth, nearest first
};
// True if layers are recorded: not of all samples, because a depth of several samples has no resolve.
[[nodiscard]] bool keeps_layers(const Record* record);
// Does nothing without a record. Targets of several samples are read back with all of them, unless one is chosen.
void show_pass(Record* record, FrameSize size, const std::string& kind, std::initializer_list<NamedTexture> targets,
               std::optional<std::uint64_t> query = {});

// An algorithm that is ready to run: only `draw` is timed.
struct Job {
    std::string name;
    // From the first clear to finished pixels in client memory; returns the geometry passes, at most `max_passes`.
    // `record` may be nullptr.
    std::function<int(PixelCodes& picture, int max_passes, Record* record)> draw;
};

// depth, front_to_back, dual, weighted_average (by repeated squaring; and by GLSL's pow), coherent_stencil,
// depth_units, weighted_blended, moments (by functions of the port; moments_log: by the driver's log and exp),
// linked_list, and the sums of weighted averages.
[[nodiscard]] const std::vector<std::string>& job_names();

// Creates all targets and programs of the algorithm, which keeps a reference to the scene. Throws std::invalid_argument
// for a name that is not in job_names().
[[nodiscard]] Job make_job(const std::string& name, const JobInput& input);

// The jobs, for job.cpp. The first ones are in single_pass.cpp; count_fragments() returns the number of fragments of
// every pixel, without depth test.
[[nodiscard]] Job depth_job(const JobInput& input);
[[nodiscard]] Job weighted_average_job(const JobInput& input);
[[nodiscard]] Job weighted_average_pow_job(const JobInput& input);
[[nodiscard]] Job sums_job(const JobInput& input);
[[nodiscard]] std::vector<std::uint32_t> count_fragments(const GpuScene& scene, FrameSize size);

[[nodiscard]] Job front_to_back_job(const JobInput& input);     // front_to_back.cpp
[[nodiscard]] Job dual_job(const JobInput& input);              // dual.cpp
[[nodiscard]] Job coherent_stencil_job(const JobInput& input);  // coherent_stencil.cpp
[[nodiscard]] Job depth_units_job(const JobInput& input);       // depth_units.cpp
[[nodiscard]] Job weighted_blended_job(const JobInput& input);  // weighted.cpp
[[nodiscard]] Job moments_job(const JobInput& input);
[[nodiscard]] Job moments_log_job(const JobInput& input);
[[nodiscard]] Job linked_list_job(const JobInput& input);  // linked_list.cpp

}  // namespace strata::port
