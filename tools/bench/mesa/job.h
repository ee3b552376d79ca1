// tools/bench/mesa/job.h - an algorithm with its targets and programs made: what is left is what the clock sees.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "pipeline/formats/format.h"
#include "tools/bench/mesa/gpu_scene.h"

namespace strata::mesa {

struct Job {
    std::string name;
    pipeline::Format format{};  // of the pixels: one word a pixel, rows from the top
    // From the first clear to finished pixels in client memory; returns the geometry passes, at most `max_passes`.
    std::function<int(std::vector<std::uint32_t>& pixels, int max_passes)> draw;
};

[[nodiscard]] const std::vector<std::string>& job_names();  // depth, front_to_back, dual, weighted_average

// `scene` must outlive the job.
[[nodiscard]] Job make_job(const std::string& name, const GpuScene& scene, Size size);

// single_pass.cpp; the last one counts the fragments of every pixel, without depth test
[[nodiscard]] Job depth_job(const GpuScene& scene, Size size);
[[nodiscard]] Job weighted_average_job(const GpuScene& scene, Size size);
[[nodiscard]] std::vector<std::uint32_t> count_fragments(const GpuScene& scene, Size size);

[[nodiscard]] Job front_to_back_job(const GpuScene& scene, Size size);  // front_to_back.cpp
[[nodiscard]] Job dual_job(const GpuScene& scene, Size size);           // dual.cpp

}  // namespace strata::mesa
