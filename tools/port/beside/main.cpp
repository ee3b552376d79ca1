// tools/port/beside/main.cpp - strata_port_beside: draws a scene with the port and prints one line of JSON per job; on
// request compares fragments and pictures with Strata's.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/files/image_io.h"
#include "scenes/files/profile_json.h"
#include "tools/port/algorithms/frame.h"
#include "tools/port/beside/reference.h"
#include "tools/port/gl/context.h"

namespace strata::port {

namespace {

using nlohmann::ordered_json;

// The command line. Empty texts: not given. `budget` and `warm_up` are in seconds.
struct BesideOptions {
    std::string scene, camera, size = "1024x1024", driver = "llvmpipe", profile, coverage, image, mistakes;
    std::optional<float> alpha;
    std::vector<std::string> algorithms;
    int threads = 2, repeat = 3;
    double budget = 10, warm_up = 0.3;
    bool check = false, compare = false;
    int each_pass = 0;
    TargetFormats formats;
};

// Throws InputError unless the text is WIDTHxHEIGHT and nothing else, both from 1.
FrameSize parse_size(const std::string& text) {
    FrameSize size;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2 || size.width < 1 ||
        size.height < 1)
        throw InputError("the command line", "--size", "WIDTHxHEIGHT", "'" + text + "'");
    return size;
}

// Loads the scene with the view of `strata render`: a camera file's, or the orbit 30,20.
Subject load(const BesideOptions& options) {
    Subject subject;
    subject.size = parse_size(options.size);
    subject.alpha = options.alpha;
    subject.threads = options.threads;
    subject.scene = scenes::load_scene(options.scene, {});
    const double aspect = double(subject.size.width) / subject.size.height;
    subject.view = options.camera.empty() ? scenes::orbit_view(subject.scene.bounds, 30, 20, aspect)
                                          : scenes::load_camera(options.camera, aspect);
    return subject;
}

// The largest difference of two codes at the same pixel and channel: in 1/255 for colours. Codes of float depths are
// their bits, which for depths from 0 to 1 differ by units in the last place.
std::uint32_t largest_difference(const pipeline::Image& a, const pipeline::Image& b) {
    std::uint32_t largest = 0;
    for (std::size_t i = 0; i < a.codes.size(); ++i)
        largest = std::max(largest, a.codes[i] > b.codes[i] ? a.codes[i] - b.codes[i] : b.codes[i] - a.codes[i]);
    return largest;
}

// The number of pixels in which a code differs.
std::size_t pixels_that_differ(const pipeline::Image& a, const pipeline::Image& b) {
    const auto channels = static_cast<std::size_t>(a.channels());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.codes.size(); i += channels)
        differ += std::equal(&a.codes[i], &a.codes[i] + channels, &b.codes[i]) ? 0 : 1;
    return differ;
}

// The first difference of the two pictures, with both codes.
ordered_json first_difference(const pipeline::Image& theirs, const pipeline::Image& ours, FrameSize size) {
    const auto channels = static_cast<std::size_t>(ours.channels()), width = static_cast<std::size_t>(size.width);
    const auto [their, our] = std::ranges::mismatch(theirs.codes, ours.codes);
    const std::size_t pixel = static_cast<std::size_t>(our - ours.codes.begin()) / channels;
    const auto codes = [&](const pipeline::Image& image) {
        return std::vector(&image.codes[pixel * channels], &image.codes[pixel * channels] + channels);
    };
    return {{"x", pixel % width}, {"y", pixel / width}, {"mesa", codes(theirs)}, {"strata", codes(ours)}};
}

// Wall-clock seconds of one run. It ends by reading the pixels back, so nothing remains in llvmpipe's queues.
double seconds_of(const Job& job, PixelCodes& pixels, int most_passes, int& passes) {
    const auto start = std::chrono::steady_clock::now();
    passes = job.draw(pixels, most_passes, nullptr);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Two passes compile every program and touch every target; further warm-up runs follow for `warm_up`. Then runs are
// timed until `budget` is spent.
ordered_json measure(const Job& job, const BesideOptions& options, PixelCodes& pixels) {
    // More passes than any scene has layers.
    constexpr int all = 1000000;
    ordered_json seconds = ordered_json::array();
    int passes = 0;
    for (double warm = seconds_of(job, pixels, 2, passes); warm < options.warm_up;)
        warm += seconds_of(job, pixels, all, passes);
    double spent = 0;
    for (int i = 0; i < options.repeat && (i == 0 || spent < options.budget); ++i) {
        seconds.push_back(seconds_of(job, pixels, all, passes));
        spent += seconds.back().get<double>();
    }
    return {{"algorithm", job.name}, {"geometry_passes", passes}, {"seconds", seconds}};
}

// Compares peels that stop after 1, 2, 3 ... geometry passes on both sides, so that their pictures show every layer.
ordered_json compare_each_pass(const Job& job, const BesideOptions& options, const Subject& subject,
                               const pipeline::DeviceProfile& profile, int passes) {
    PixelCodes pixels;
    std::size_t differ = 0, pictures = 0;
    for (int most = 1; most < std::min(passes, options.each_pass + 1); ++most, ++pictures) {
        static_cast<void>(job.draw(pixels, most, nullptr));
        const Rendered ours = render(subject, profile, job.name, options.formats, most);
        differ += pixels_that_differ(as_image(pixels), ours.image);
    }
    return {{"pictures", pictures}, {"differ", differ}};
}

// Measures a job and prints its line of JSON immediately, because the caller pairs runs of two programs.
void run(const Job& job, const BesideOptions& options, const Subject& subject, const pipeline::DeviceProfile& profile) {
    PixelCodes pixels;
    ordered_json line = measure(job, options, pixels);
    const pipeline::Image image = as_image(pixels);
    line["digest"] = pipeline::digest(image);
    if (options.compare) {
        const Rendered ours = render(subject, profile, job.name, options.formats);
        line["strata"] = {{"geometry_passes", ours.geometry_passes},
                          {"differ", pixels_that_differ(image, ours.image)},
                          {"largest_difference", largest_difference(image, ours.image)}};
        if (line["strata"]["differ"] != 0) line["strata"]["first"] = first_difference(image, ours.image, subject.size);
    }
    if (options.each_pass > 0)
        line["each_pass"] = compare_each_pass(job, options, subject, profile, line["geometry_passes"].get<int>());
    fmt::print("{}\n", line.dump());
    std::fflush(stdout);
    if (!options.image.empty() && pixels.format == rgba8) scenes::write_image(options.image, {.color = image});
}

// The number of pixels in which the two programs draw different numbers of fragments.
std::size_t check(const GpuScene& scene, const rasterizer::TriangleSoup& soup, const BesideOptions& options,
                  FrameSize size, const pipeline::DeviceProfile& profile) {
    const std::vector<std::uint32_t> theirs = count_fragments(scene, size);
    const auto [ours, clipped] = count_fragments(soup, profile, size);
    std::size_t differ = 0, first = 0;
    std::uint64_t fragments = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        fragments += theirs[i];
        if (ours[i] != theirs[i] && differ++ == 0) first = i;
    }
    ordered_json line{{"pixels", ours.size()}, {"differ", differ}, {"fragments", fragments}, {"clipped", clipped}};
    const auto width = static_cast<std::size_t>(size.width);
    if (differ > 0)
        line["first"] = {
            {"x", first % width}, {"y", first / width}, {"llvmpipe", theirs[first]}, {"strata", ours[first]}};
    fmt::print("{}\n", ordered_json{{"coverage", line}}.dump());
    if (options.coverage.empty()) return differ;
    std::ofstream file(options.coverage, std::ios::binary);
    file.write(reinterpret_cast<const char*>(theirs.data()),
               static_cast<std::streamsize>(theirs.size() * sizeof(theirs[0])));
    if (!file.flush()) throw std::runtime_error(options.coverage + ": could not be written");
    return differ;
}

int run_all(const BesideOptions& options) {
    const Subject subject = load(options);
    const pipeline::DeviceProfile profile =
        scenes::load_profile(options.profile.empty() ? options.driver : options.profile);
    const rasterizer::TriangleSoup soup = clip_vertices(subject);
    const HeadlessContext context(options.driver, options.threads);
    std::fprintf(stderr, "%s\n", context.renderer().c_str());
    const PortSettings settings = settings_with(options.mistakes);
    set_window(subject.size, settings, GL_NEGATIVE_ONE_TO_ONE);
    const GpuScene scene(mesh_of(soup), subject.size, settings);
    for (const std::string& name : options.algorithms) {
        const JobInput input{.scene = scene, .size = subject.size, .formats = options.formats, .settings = settings};
        run(make_job(name, input), options, subject, profile);
    }
    // --coverage alone writes the counts; a difference is a failure only with --check.
    const bool counts = options.check || !options.coverage.empty();
    return counts && check(scene, soup, options, subject.size, profile) > 0 && options.check ? 1 : 0;
}

void add_options(CLI::App& app, BesideOptions& o) {
    app.add_option("SCENE", o.scene, "a scene as `strata render` takes it")->required();
    app.add_option("--camera", o.camera, "a camera file (default: the orbit 30,20)");
    app.add_option("--alpha", o.alpha, "every material transparent, its alpha times this");
    app.add_option("--size", o.size, "WIDTHxHEIGHT (default 1024x1024)");
    app.add_option("--threads", o.threads, "threads that rasterize (default 2)")->check(CLI::Range(1, 16));
    app.add_option("--algorithm", o.algorithms,
                   "of depth, front_to_back, dual, weighted_average, weighted_average_pow, sums, with commas between")
        ->delimiter(',')
        ->check(CLI::IsMember(job_names()));
    app.add_option("--repeat", o.repeat, "times of each (default 3)")->check(CLI::PositiveNumber);
    app.add_option("--warm-up", o.warm_up, "seconds that each runs before it is timed (default 0.3)")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--budget", o.budget, "seconds of an algorithm after which it is not repeated (default 10)");
    app.add_option("--profile", o.profile, "Strata's device for --check and --compare (default: the driver's)");
    app.add_option("--driver", o.driver, "llvmpipe, llvmpipe_sse (without fused multiply-add) or softpipe")
        ->check(CLI::IsMember(driver_names()));
    app.add_flag("--check", o.check, "compare the number of fragments of every pixel; exit status 1 if one differs");
    const std::map<std::string, PixelFormat> colors{{"rgba8", rgba8}, {"rgba16f", rgba16f}, {"rgba32f", rgba32f}};
    const std::map<std::string, PixelFormat> depths{{"d16", d16}, {"d24", d24}, {"d32f", d32f}};
    app.add_option_function<std::string>(
           "--color", [&o, colors](const std::string& name) { o.formats.color = colors.at(name); },
           "the format of colours: rgba8 (default), rgba16f or rgba32f")
        ->check(CLI::IsMember(colors));
    app.add_option_function<std::string>(
           "--depth", [&o, depths](const std::string& name) { o.formats.depth = depths.at(name); },
           "the format of depths: d32f (default), d24 or d16")
        ->check(CLI::IsMember(depths));
    app.add_option("--mistake", o.mistakes, "names of `strata_port --mistakes`, with commas between");
    app.add_option("--each-pass", o.each_pass, "compare the pictures after 1, 2 ... so many passes, too")
        ->check(CLI::NonNegativeNumber);
    app.add_flag("--compare", o.compare, "compare passes and pictures with Strata's");
    app.add_option("--coverage", o.coverage, "write the number of fragments of every pixel: u32, rows from the top");
    app.add_option("--image", o.image, "write the last colour picture, .png or .exr");
}

}  // namespace

}  // namespace strata::port

int main(int count, char** words) {
    CLI::App app{"Peels by OpenGL, beside Strata's.", "strata_port_beside"};
    strata::port::BesideOptions options;
    strata::port::add_options(app, options);
    try {
        app.parse(count, words);
        return strata::port::run_all(options);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const strata::InputError& error) {
        std::fprintf(stderr, "strata_port_beside: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "strata_port_beside: %s\n", error.what());
        return 3;
    }
}
