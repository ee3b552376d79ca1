// tests/faults/allocation_faults.cpp - lets every request for memory fail once, in every job of the library, and checks
// that each failure is handled.
//
//     build/release/tests/faults/allocation_faults --load --all # every request while scenes are built
//     build/release/tests/faults/allocation_faults --render # about 12 requests of each execution of a frame
//     build/release/tests/faults/allocation_faults --render --all # each of the first 2,000, then every tenth
//
// The expected result is that of the same job without a fault. A job whose request fails must end with std::bad_alloc,
// or with the expected result if it can do without that memory. When it is repeated it must give the expected result
// and hold as many blocks as before, so that nothing has leaked. Profiles and cameras are left out: the values of the
// JSON library request memory in their destructors, which ends a process that has none.
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/formats/image.h"
#include "scenes/scene.h"
#include "tests/faults/failing_memory.h"
#include "tests/golden/core_scenes.h"

namespace {

using namespace strata;

struct Job {
    std::string name;
    std::function<std::string()> run;  // its result as text
};

std::string shown(const peeling::RenderResult& result) {
    if (result.outcome == peeling::Outcome::refused) return "refused";
    return pipeline::digest(result.frame.color) + pipeline::digest(result.frame.depth) + ' ' +
           std::to_string(result.audit.layers_max);
}

// Adds the frames of the core scenes by every algorithm, on geforce3 and ideal where they run it, in three executions.
void add_renders(std::vector<Job>& jobs, const std::vector<golden::GoldenScene>& scenes) {
    struct Way {
        const char* name;
        pipeline::Execution execution;
        std::uint64_t memory;
    };
    static constexpr Way ways[] = {{"literal", pipeline::Execution::literal, 0},
                                   {"rasterized", pipeline::Execution::replay, 0},
                                   {"replay", pipeline::Execution::replay, 64 << 20}};
    for (const golden::GoldenScene& scene : scenes)
        for (const peeling::Algorithm& algorithm : peeling::algorithms())
            for (const char* const device : {"geforce3", "ideal"})
                for (const Way& way : ways) {
                    peeling::RenderOptions options;
                    options.width = options.height = 16;
                    options.threads = 1;
                    options.tile_size = 8;
                    options.alpha = scene.alpha;
                    options.execution = way.execution;
                    options.fragment_memory = way.memory;
                    const pipeline::DeviceProfile& profile = *pipeline::find_profile(device);
                    const auto run = [&scene, &algorithm, &profile, options] {
                        peeling::Renderer renderer{scene.list, scene.view, profile, options};
                        return shown(renderer.render(algorithm));
                    };
                    if (run() == "refused") continue;
                    jobs.push_back({scene.name + ' ' + algorithm.name + ' ' + device + ' ' + way.name, run});
                }
}

void add_loads(std::vector<Job>& jobs) {
    for (const char* const spec :
         {"planes:count=2", "teapot:tessellation=1", "random:triangles=20", "volume-beam:slices=2", "shadow-demo"})
        jobs.push_back({std::string{"load "} + spec,
                        [spec] { return std::to_string(scenes::load_scene(spec, {}).list.meshes.size()); }});
}

// The request at which a job is, as text, for the parent of a process that ends early. It is not allocated by operator
// new.
constexpr std::size_t at_work_bytes = 256;
char* const at_work =
    static_cast<char*>(mmap(nullptr, at_work_bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));

// The fault after the n-th request of the job has failed, as text; empty if there is none.
std::string fault_at(const Job& job, std::uint64_t n, const std::string& whole, std::int64_t held) {
    bool is_other = false;
    test::fail_request(n);
    try {
        is_other = job.run() != whole;
    } catch (const std::bad_alloc&) {  // expected
    } catch (const std::exception& error) {
        test::fail_request(0);
        return std::string{"ends with another exception: "} + error.what();
    }
    test::fail_request(0);
    if (is_other) return "another result";
    if (job.run() != whole) return "another result when done again";
    if (const std::int64_t now = test::blocks_held(); now != held) return std::to_string(now - held) + " blocks more";
    return {};
}

struct Tried {
    std::uint64_t points = 0, bad = 0;
};

Tried try_job(const Job& job, bool all) {
    const std::string whole = job.run();
    for (int again = 0; again < 2; ++again)
        static_cast<void>(job.run());  // memory that is kept for reuse is then
                                       // allocated
    const std::int64_t held = test::blocks_held();
    test::fail_request(0);
    static_cast<void>(job.run());
    const std::uint64_t count = test::requests();
    Tried tried;
    // About 12 requests of each job, or all of them.
    const std::uint64_t step = all ? 1 : std::max<std::uint64_t>(1, count / 12);
    for (std::uint64_t n = 1; n <= count; n += n >= 2000 ? std::max<std::uint64_t>(step, 10) : step) {
        std::snprintf(at_work, at_work_bytes, "%s, request %llu", job.name.c_str(), static_cast<unsigned long long>(n));
        const std::string fault = fault_at(job, n, whole, held);
        ++tried.points;
        if (fault.empty()) continue;
        if (tried.bad++ < 3) std::printf("%s: %s\n", at_work, fault.c_str());
    }
    return tried;
}

// Tries a job in a child process: if it ends the process, that is one fault, and the other jobs continue.
Tried try_apart(const Job& job, bool all) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
        const Tried tried = try_job(job, all);
        std::fflush(stdout);
        _exit(write(ends[1], &tried, sizeof tried) == sizeof tried ? 0 : 1);
    }
    close(ends[1]);
    Tried tried{1, 1};
    if (read(ends[0], &tried, sizeof tried) != sizeof tried) {
        std::printf("%s: ends the process\n", at_work);
        tried = {1, 1};
    }
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return tried;
}

}  // namespace

int main(int count, char** words) {
    const std::span<char*> given{words + 1, static_cast<std::size_t>(count - 1)};
    const auto has = [&](const char* word) {
        return std::ranges::any_of(given, [&](const char* one) { return std::strcmp(one, word) == 0; });
    };
    const bool loads = has("--load"), renders = has("--render"), all = has("--all");
    if (loads + renders + all != count - 1 || loads + renders == 0) {
        std::fprintf(stderr, "allocation_faults: expected --load or --render or both, and --all\n");
        return 2;
    }
    const auto scenes = golden::core_scenes();
    std::vector<Job> jobs;
    if (renders) add_renders(jobs, scenes);
    if (loads) add_loads(jobs);
    Tried sum;
    for (const Job& job : jobs) {
        const Tried tried = try_apart(job, all);
        sum.points += tried.points;
        sum.bad += tried.bad;
    }
    std::printf("%zu jobs, %llu requests failed, %llu bad\n", jobs.size(), static_cast<unsigned long long>(sum.points),
                static_cast<unsigned long long>(sum.bad));
    return sum.bad == 0 && sum.points > 0 ? 0 : 1;
}
