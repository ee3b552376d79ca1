// tools/request/choices.h - the accepted words of options that are enumerations, and their values.
#pragma once
#include "pipeline/device/profile_fields.h"
#include "pipeline/formats/resolve.h"
#include "pipeline/frame/run_settings.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/fog.h"
#include "pipeline/vertices/polygon_mode.h"
#include "rasterizer/base/simd.h"
#include "tools/request/words.h"

namespace strata::tools {

inline const std::vector<Choice<pipeline::DepthFormat>> depth_formats{{"d16", pipeline::DepthFormat::d16},
                                                                      {"d24", pipeline::DepthFormat::d24},
                                                                      {"d32f", pipeline::DepthFormat::d32f},
                                                                      {"d16f", pipeline::DepthFormat::d16f},
                                                                      {"d24f", pipeline::DepthFormat::d24f}};

inline const std::vector<Choice<pipeline::Format>> color_formats{
    {"rgba8", pipeline::Format::rgba8},       {"rgba16f", pipeline::Format::rgba16f},
    {"rgba32f", pipeline::Format::rgba32f},   {"srgb8_alpha8", pipeline::Format::srgb8_alpha8},
    {"rgb10_a2", pipeline::Format::rgb10_a2}, {"r11g11b10f", pipeline::Format::r11g11b10f}};

inline const std::vector<Choice<pipeline::Format>> count_formats{{"r16f", pipeline::Format::r16f},
                                                                 {"r32f", pipeline::Format::r32f}};

// Uses the same names for depth paths as profile files.
[[nodiscard]] inline std::vector<Choice<rasterizer::DepthPath>> depth_paths() {
    std::vector<Choice<rasterizer::DepthPath>> paths;
    for (const pipeline::ProfileField& field : pipeline::profile_fields()) {
        if (field.key != "raster.depth_path") continue;
        for (std::size_t i = 0; i < field.choices.size(); ++i) {
            paths.push_back({std::string(field.choices[i]), static_cast<rasterizer::DepthPath>(i)});
        }
    }
    return paths;
}

// The words in the order of the enum.
[[nodiscard]] inline std::vector<Choice<pipeline::VertexPath>> vertex_paths() {
    std::vector<Choice<pipeline::VertexPath>> paths;
    for (const std::string_view name : pipeline::vertex_path_names)
        paths.push_back({std::string(name), static_cast<pipeline::VertexPath>(paths.size())});
    return paths;
}

inline const std::vector<Choice<pipeline::ColorSpace>> color_spaces{{"encoded", pipeline::ColorSpace::encoded},
                                                                    {"linear", pipeline::ColorSpace::linear}};

inline const std::vector<Choice<pipeline::Execution>> executions{{"literal", pipeline::Execution::literal},
                                                                 {"replay", pipeline::Execution::replay}};

inline const std::vector<Choice<pipeline::Formulation>> formulations{{"resolved", pipeline::Formulation::resolved},
                                                                     {"published", pipeline::Formulation::published}};

inline const std::vector<Choice<Simd>> simds{
    {"scalar", Simd::scalar}, {"avx2", Simd::avx2}, {"avx512", Simd::avx512}, {"best", Simd::best}};

inline const std::vector<Choice<pipeline::FogMode>> fog_modes{
    {"linear", pipeline::FogMode::linear}, {"exp", pipeline::FogMode::exp}, {"exp2", pipeline::FogMode::exp2}};

inline const std::vector<Choice<pipeline::PolygonMode>> polygon_modes{{"fill", pipeline::PolygonMode::fill},
                                                                      {"line", pipeline::PolygonMode::line},
                                                                      {"point", pipeline::PolygonMode::point}};

inline const std::vector<Choice<pipeline::Effects>> effects{{"needed", pipeline::Effects::needed},
                                                            {"all", pipeline::Effects::all}};

inline const std::vector<Choice<rasterizer::DepthOrder>> depth_orders{{"less", rasterizer::DepthOrder::less},
                                                                      {"greater", rasterizer::DepthOrder::greater}};

inline const std::vector<Choice<rasterizer::ClipDepth>> clip_depths{
    {"minus-one-to-one", rasterizer::ClipDepth::minus_one_to_one}, {"zero-to-one", rasterizer::ClipDepth::zero_to_one}};

inline const std::vector<Choice<pipeline::Origin>> origins{{"upper-left", pipeline::Origin::upper_left},
                                                           {"lower-left", pipeline::Origin::lower_left}};

// Samples are counted per pixel; tile sizes are pixels per side.
inline const std::vector<Choice<pipeline::Resolve>> resolves{{"box", pipeline::Resolve::box},
                                                             {"quincunx", pipeline::Resolve::quincunx}};
inline const std::vector<Choice<bool>> shadings{{"sample", false}, {"pixel", true}};
inline const std::vector<Choice<rasterizer::Interpolation>> interpolations{
    {"centre", rasterizer::Interpolation::centre}, {"centroid", rasterizer::Interpolation::centroid}};
inline const std::vector<Choice<pipeline::LoadedSample>> loaded_samples{{"own", pipeline::LoadedSample::own},
                                                                        {"0", pipeline::LoadedSample::zero},
                                                                        {"resolved", pipeline::LoadedSample::resolved}};
inline const std::vector<Choice<int>> sample_counts{{"1", 1}, {"2", 2}, {"4", 4}, {"8", 8}};
inline const std::vector<Choice<int>> tile_sizes{{"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}, {"128", 128}};

}  // namespace strata::tools
