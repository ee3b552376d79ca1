#include "tests/fuzz/inputs.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>

#include "pipeline/device/profile.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/files/profile_json.h"
#include "tools/lab/invariance/invariance_plan.h"

namespace strata::fuzz {

namespace {

constexpr const char* input_name = "fuzz.json";

std::string text_of(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

void try_profile(Bytes bytes) {
    try {
        const pipeline::DeviceProfile profile = scenes::parse_profile(text_of(bytes), input_name);
        require(scenes::parse_profile(scenes::to_json(profile), input_name) == profile,
                "a profile reads back as it was");
    } catch (const InputError&) {
    }
}

void write_profiles(const std::filesystem::path& folder) {
    for (const pipeline::DeviceProfile& profile : pipeline::builtin_profiles())
        write(folder / profile.name, scenes::to_json(profile));
    write(folder / "of_a_base", R"({"base": "geforce8", "name": "x", "raster": {"subpixel_bits": 4}})");
}

void try_camera(Bytes bytes) {
    try {
        const pipeline::View view = scenes::parse_camera(text_of(bytes), input_name, 1.5);
        require(scenes::to_json(scenes::parse_camera(scenes::to_json(view), input_name, 1.5)) == scenes::to_json(view),
                "a camera reads back as it was");
    } catch (const InputError&) {
    }
}

void write_cameras(const std::filesystem::path& folder) {
    write(folder / "matrices", scenes::to_json(scenes::look_at({}, 1.5)));
    write(
        folder / "look_at",
        R"({"eye": [0, 0.5, 3], "center": [0, 0, 0], "up": [0, 1, 0], "fovy_degrees": 42, "near": 1.9, "far": "0x1.0cp+2"})");
}

void try_plan(Bytes bytes) {
    try {
        const auto cells = tools::parse_plan(text_of(bytes), input_name, {});
        require(!cells.empty(), "a plan has cells");
        for (std::size_t i = 1; i < std::min<std::size_t>(cells.size(), 64); ++i)
            require(std::find(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(i), cells[i]) ==
                        cells.begin() + static_cast<std::ptrdiff_t>(i),
                    "no cell comes twice");
    } catch (const InputError&) {
    }
}

void write_plans(const std::filesystem::path& folder) {
    write(folder / "grids",
          R"({"common": {"scene": "planes:gap=64,count=4", "size": "24x16", "profile": "ideal", "pair": "float32:exact",
 "depth_format": ["d24", "d32f"]}, "grids": [{"remedy": ["none", "bias:2", "epsilon:2ulp"], "near_far": ["orbit", "ratio:1000"]},
 {"profile": "geforce3", "algorithm": "front_to_back", "alpha": 0.5, "subpixel_bits": [4, 8], "split": ["rotated", "moved"]}]})");
    write(folder / "one",
          R"({"grids": [{"scene": "teapot", "orbit": "30,20", "vertex_path": "fused,double", "max_passes": 9}]})");
}

constexpr Input all[]{
    {"profile", try_profile, write_profiles}, {"camera", try_camera, write_cameras}, {"plan", try_plan, write_plans},
    {"pack", try_pack, write_packs},          {"exr", try_exr, write_exrs},          {"calls", try_calls, write_calls}};

}  // namespace

std::span<const Input> inputs() { return all; }

void require(bool holds, const char* promise) {
    if (!holds) throw std::logic_error(promise);
}

}  // namespace strata::fuzz
