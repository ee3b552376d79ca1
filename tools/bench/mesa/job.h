// tools/bench/mesa/job.h - an algorithm with its targets and programs made: what is left is what the clock sees.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "pipeline/formats/format.h"
#include "tools/bench/mesa/gpu_scene.h"

namespace strata::mesa {

// What a job's targets store; the pictures of `depth` are depths, those of the others colours.
struct TargetFormats {
    pipeline::Format color = pipeline::Format::rgba8;  // or rgba16f, rgba32f
    pipeline::Format depth = pipeline::Format::d32f;   // or d16, d24
};

// One algorithm that is ready to run: only `draw` is timed.
struct Job {
    std::string name;
    // Of the pixels: rows from the top, channels r g b a as they lie in memory, the lowest bits first.
    pipeline::Format format{};
    // From the first clear to finished pixels in client memory; returns the geometry passes, at most `max_passes`.
    std::function<int(std::vector<std::uint32_t>& pixels, int max_passes)> draw;
};

// depth, front_to_back, dual, weighted_average, and the sums that the last one makes its colours of.
[[nodiscard]] const std::vector<std::string>& job_names();

// Makes all targets and programs of the algorithm, which keeps a reference to `scene`. Throws
// std::invalid_argument for a name that is not in job_names().
[[nodiscard]] Job make_job(const std::string& name, const GpuScene& scene, Size size, const TargetFormats& formats);

// The jobs by themselves, for job.cpp. Those of single_pass.cpp come first; count_fragments()
// answers the fragments of every pixel, without depth test.
[[nodiscard]] Job depth_job(const GpuScene& scene, Size size, const TargetFormats& formats);
[[nodiscard]] Job weighted_average_job(const GpuScene& scene, Size size, const TargetFormats& formats);
[[nodiscard]] Job sums_job(const GpuScene& scene, Size size, const TargetFormats& formats);
[[nodiscard]] std::vector<std::uint32_t> count_fragments(const GpuScene& scene, Size size);

[[nodiscard]] Job front_to_back_job(const GpuScene& scene, Size size,
                                    const TargetFormats& formats);                           // front_to_back.cpp
[[nodiscard]] Job dual_job(const GpuScene& scene, Size size, const TargetFormats& formats);  // dual.cpp

}  // namespace strata::mesa
