// tools/port/main.cpp - strata_port: draws a golden pack with OpenGL and writes a candidate.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "tools/port/algorithms/frame.h"
#include "tools/port/gl/context.h"
#include "tools/port/gl/pack.h"

namespace strata::port {

namespace {

struct PortOptions {
    std::string pack, output, driver = "llvmpipe", mistakes, origin = "upper-left";
    std::vector<std::string> algorithms;
    int threads = 2, max_passes = 200, samples = 1, sample = -1;
    std::string interpolation = "sample";
    bool list = false, picture_only = false;
};

void list_mistakes(const PortOptions& options) {
    for (const PortMistake& mistake : options.samples > 1 ? sampled_mistakes() : mistakes())
        fmt::print("{:<26}{:<18}{}\n", mistake.name, mistake.algorithm, mistake.words);
}

// The requested algorithms, or all of the pack's that the port supports.
std::vector<std::string> chosen(const PortOptions& options, const Pack& pack) {
    if (!options.algorithms.empty()) return options.algorithms;
    std::vector<std::string> found;
    for (const std::string& name : pack.algorithms)
        if (std::ranges::find(job_names(), name) != job_names().end()) found.push_back(name);
    if (found.empty())
        throw std::runtime_error(options.pack + ": expected a result of an algorithm that the port has, found none");
    return found;
}

// What is read back sample by sample.
void check_sampled(const PortOptions& options, const Pack& pack, const std::vector<std::string>& algorithms) {
    if (options.sample >= options.samples)
        throw std::runtime_error(fmt::format("--sample: expected a number below --samples, found {}", options.sample));
    if (!(pack.formats.depth == d32f))
        throw std::runtime_error("--samples: expected a pack with d32f depth, found " +
                                 std::string(pack.formats.depth.name));
    for (const std::string& name : algorithms)
        if (name != "front_to_back" && name != "dual" && name != "weighted_average" && name != "linked_list")
            throw std::runtime_error(
                "--samples: expected front_to_back, dual, weighted_average or linked_list, found " + name);
}

// A pack of all samples says how many, where programs run, and what they load, unless options do.
void take_sampling(const PackSampling& pack, PortOptions& options, SampleExpressions& loads) {
    if (pack.samples == 1 || options.samples > 1) return;
    options.samples = pack.samples;
    options.interpolation = pack.interpolation;
    if (pack.loads == "zero") loads.geometry = "0";
    if (pack.composites == "zero") loads.full_screen = "0";
}

// A peel from the front alone has reversed depth: the other algorithms' programs compare or blend depths that grow.
void reverse_depth(PortSettings& settings, const std::vector<std::string>& algorithms) {
    for (const std::string& name : algorithms)
        if (name != "front_to_back")
            throw std::runtime_error("depth_order: expected front_to_back alone with reversed depth, found " + name);
    settings.depth_func = GL_GREATER;
    settings.behind = "z < peeled";
    settings.farthest = 0;
}

int run(PortOptions options) {
    const Pack pack = read_pack(options.pack);
    const std::vector<std::string> algorithms = chosen(options, pack);
    PortSettings settings = settings_with(options.mistakes);
    if (options.origin == "lower-left") settings.origin = GL_LOWER_LEFT;
    if (pack.is_reversed) reverse_depth(settings, algorithms);
    take_sampling(pack.sampling, options, settings.sampled.loads);
    const bool has_targets = options.samples == 1 || options.sample >= 0 || pack.sampling.samples > 1;
    const HeadlessContext context(options.driver, options.threads);
    if (options.samples > 1) {
        check_sampled(options, pack, algorithms);
        ShadingRate& shading = settings.sampled.shading;
        if (options.interpolation != "sample") shading = ShadingRate::pixel;
        set_samples(options.samples, options.sample < 0 ? settings.sampled.shown : options.sample, shading,
                    settings.sampled.loads);
        settings.interpolation = shading == ShadingRate::sample        ? "smooth sample"
                                 : options.interpolation == "centroid" ? "smooth centroid"
                                                                       : "smooth";
    }
    set_window(pack.size, settings, pack.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    if (pack.formats.color == srgb8) glEnable(GL_FRAMEBUFFER_SRGB);
    const GpuScene scene(pack.mesh, pack.size, settings);
    std::vector<Candidate> candidates;
    for (const std::string& name : algorithms) {
        const JobInput input{.scene = scene,
                             .size = pack.size,
                             .formats = pack.formats,
                             .background = pack.background,
                             .settings = settings};
        Candidate& candidate = candidates.emplace_back(Candidate{name, {}, {}});
        const int passes = make_job(name, input)
                               .draw(candidate.picture, options.max_passes,
                                     options.picture_only || !has_targets ? nullptr : &candidate.record);
        check_errors(name);
        fmt::print("{}: {} geometry passes\n", name, passes);
    }
    write_candidate(options.output, "strata_port, " + context.renderer(), candidates);
    return 0;
}

void add_options(CLI::App& app, PortOptions& o) {
    app.add_option("PACK", o.pack, "a golden pack (oracle/PACK.md)");
    app.add_option("-o,--output", o.output, "the candidate: a folder that does not exist");
    app.add_option("--algorithm", o.algorithms, "of the pack's, with commas between (default: all that the port has)")
        ->delimiter(',')
        ->check(CLI::IsMember(job_names()));
    app.add_option("--driver", o.driver, "llvmpipe, llvmpipe_sse (without fused multiply-add), softpipe, or hardware")
        ->check(CLI::IsMember(driver_names()));
    app.add_option("--threads", o.threads, "threads that rasterize (default 2)")->check(CLI::Range(1, 16));
    app.add_option("--samples", o.samples, "samples per pixel (default: the pack's, or 1)")->check(CLI::Range(1, 32));
    app.add_option(
           "--interpolate", o.interpolation,
           "where geometry passes run their programs: once per sample, or once per pixel at its centre or centroid, "
           "where they load sample 0 (default sample)")
        ->check(CLI::IsMember({"sample", "centre", "centroid"}));
    app.add_option("--sample", o.sample, "what is written is this sample (default: the resolved picture)")
        ->check(CLI::Range(0, 31));
    app.add_option("--origin", o.origin,
                   "the corner at which the window's memory begins; rows are written in memory's order (default "
                   "upper-left)")
        ->check(CLI::IsMember({"upper-left", "lower-left"}));
    app.add_option("--mistake", o.mistakes, "be wrong: names with commas between");
    app.add_flag("--mistakes", o.list, "list them; with --samples those of several samples");
    app.add_option("--max-passes", o.max_passes, "geometry passes at most (default 200)")->check(CLI::PositiveNumber);
    app.add_flag("--picture-only", o.picture_only, "write neither targets nor layers");
}

}  // namespace

}  // namespace strata::port

int main(int count, char** words) {
    CLI::App app{"Draws a golden pack by OpenGL and writes a candidate.", "strata_port"};
    strata::port::PortOptions options;
    strata::port::add_options(app, options);
    try {
        app.parse(count, words);
        if (options.list) return strata::port::list_mistakes(options), 0;
        if (options.pack.empty() || options.output.empty()) throw CLI::RequiredError("PACK and -o");
        return strata::port::run(options);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "strata_port: %s\n", error.what());
        return 2;
    }
}
