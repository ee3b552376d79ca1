// tests/golden/golden.cpp - renders scenes by every algorithm and profile and prints or compares their digests
// (golden.h).
#include "tests/golden/golden.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "peeling/registry.h"
#include "peeling/render.h"

namespace strata::golden {

namespace {

int to_int(const std::string& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::invalid_argument("expected a number, found " + text);
    return value;
}

Simd to_simd(const std::string& name) {
    constexpr std::array names{"scalar", "avx2", "avx512"};  // in the enum's order
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::invalid_argument("expected an instruction set, found " + name);
    return static_cast<Simd>(found - names.begin());
}

std::string digest_or_dash(const pipeline::Image& image) { return image.codes.empty() ? "-" : pipeline::digest(image); }

std::string line(const GoldenScene& scene, const std::string& profile, const std::string& algorithm,
                 const peeling::RenderResult& result) {
    const bool is_done = result.outcome == peeling::Outcome::done;
    const std::string digests =
        is_done ? digest_or_dash(result.frame.color) + ' ' + digest_or_dash(result.frame.depth) : "- -";
    return scene.name + ' ' + profile + ' ' + algorithm + ' ' + digests + (is_done ? " done\n" : " refused\n");
}

std::vector<std::string> split_lines(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream stream(text);
    for (std::string one; std::getline(stream, one);) result.push_back(one);
    return result;
}

}  // namespace

Settings parse(int count, char** words) {
    Settings settings;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const std::string key = word.substr(0, word.find('='));
        const std::string value = word.substr(std::min(word.size(), key.size() + 1));
        if (key == "threads")
            settings.threads = to_int(value);
        else if (key == "tile")
            settings.tile_size = to_int(value);
        else if (word == "execution=literal" || word == "execution=replay")
            settings.execution = value == "literal" ? pipeline::Execution::literal : pipeline::Execution::replay;
        else if (key == "memory")
            settings.fragment_memory = to_int(value);
        else if (word == "effects=needed" || word == "effects=all")
            settings.effects = value == "all" ? pipeline::Effects::all : pipeline::Effects::needed;
        else if (key == "simd")
            settings.simd = to_simd(value);
        else if (key == "check")
            settings.check = value;
        else
            throw std::invalid_argument(
                "expected threads=, tile=, execution=, memory=, effects=, simd= or check=, found " + word);
    }
    return settings;
}

std::string lines(const GoldenScene& scene, const Settings& settings) {
    std::string text;
    for (const pipeline::DeviceProfile& profile : pipeline::builtin_profiles()) {
        // Profiles with binary32 planes (Mesa's and SwiftShader's) are left out: tools/lab/bench compares the fragments
        // of Mesa's with Mesa's own.
        if (profile.raster.plane_rule != rasterizer::PlaneRule::exact) continue;
        peeling::RenderOptions options;
        options.width = scene.width;
        options.height = scene.height;
        options.alpha = scene.alpha;
        options.threads = settings.threads;
        options.tile_size = settings.tile_size;
        options.execution = settings.execution;
        options.fragment_memory = static_cast<std::uint64_t>(settings.fragment_memory);
        options.effects = settings.effects;
        options.simd = has_simd(settings.simd) ? settings.simd : Simd::best;
        options.audit = false;
        peeling::Renderer renderer(scene.list, scene.view, profile, options);
        for (const peeling::Algorithm& algorithm : peeling::algorithms()) {
            text += line(scene, profile.name, algorithm.name, renderer.render(algorithm));
        }
    }
    return text;
}

int finish(const std::string& text, const Settings& settings) {
    if (settings.check.empty()) {
        std::cout << text << std::flush;
        return std::cout ? 0 : 3;
    }
    std::ifstream file(settings.check);
    std::stringstream content;
    content << file.rdbuf();
    const auto wanted = split_lines(content.str()), found = split_lines(text);
    int differences = 0;
    for (std::size_t i = 0; i < std::max(wanted.size(), found.size()); ++i) {
        const std::string expected = i < wanted.size() ? wanted[i] : "(nothing)",
                          got = i < found.size() ? found[i] : "(nothing)";
        if (expected != got && differences++ < 10) std::cout << "- " << expected << "\n+ " << got << '\n';
    }
    std::cout << differences << " of " << wanted.size() << " lines differ\n";
    return differences == 0 && !wanted.empty() ? 0 : 1;
}

}  // namespace strata::golden
