// tests/callgrind/callgrind_jobs.cpp - small fixed jobs of the core, in one thread with AVX2, whose instructions
// counts.sh counts. Run: callgrind_jobs --compiler | --list | JOB. Exit status 77: this processor lacks AVX2.
#include <iostream>
#include <string>
#include <string_view>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "rasterizer/base/simd.h"
#include "tests/golden/core_scenes.h"

namespace {

using namespace strata;

struct Job {
    std::string_view name, scene, algorithm;  // "depth_pass" is Renderer::depth_pass
};

constexpr Job jobs[]{{"soup-depth_pass", "soup", "depth_pass"},
                     {"soup-front_to_back", "soup", "front_to_back"},
                     {"soup-dual", "soup", "dual"},
                     {"stack-weighted_average", "stack", "weighted_average"},
                     {"textured-unsorted", "textured", "unsorted"}};

#if defined(__clang__)
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "gcc " __VERSION__;
#endif

peeling::RenderOptions options_for(const golden::GoldenScene& scene) {
    peeling::RenderOptions options;
    options.width = scene.width;
    options.height = scene.height;
    options.threads = 1;
    options.audit = false;
    options.simd = Simd::avx2;
    return options;
}

// Geometry and passes, from the draw list to the finished frame.
peeling::RenderResult draw(const golden::GoldenScene& scene, std::string_view algorithm) {
    peeling::Renderer renderer{scene.list, scene.view, *pipeline::find_profile("geforce8"), options_for(scene)};
    return algorithm == "depth_pass" ? renderer.depth_pass() : renderer.render(*peeling::find_algorithm(algorithm));
}

}  // namespace

// The function whose instructions callgrind counts.
extern "C" [[gnu::noinline]] void strata_counted_job(const golden::GoldenScene& scene, std::string_view algorithm,
                                                     peeling::RenderResult& result) {
    result = draw(scene, algorithm);
}

namespace {

int run(const Job& job) {
    if (!has_simd(Simd::avx2)) return 77;
    for (const golden::GoldenScene& scene : golden::core_scenes()) {
        if (scene.name != job.scene) continue;
        // This uncounted run sets up tables, profiles and allocators.
        peeling::RenderResult result = draw(scene, job.algorithm);
        strata_counted_job(scene, job.algorithm, result);
        return result.outcome == peeling::Outcome::done ? 0 : 1;
    }
    return 1;
}

}  // namespace

int main(int count, char** words) {
    const std::string_view word = count == 2 ? words[1] : "";
    if (word == "--compiler") std::cout << compiler << '\n';
    if (word == "--list")
        for (const Job& job : jobs) std::cout << job.name << '\n';
    if (word == "--compiler" || word == "--list") return 0;
    for (const Job& job : jobs)
        if (job.name == word) return run(job);
    std::cerr << "callgrind_jobs --compiler | --list | JOB\n";
    return 2;
}
