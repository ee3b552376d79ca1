// tools/request/view_fields.cpp - the options of the scene that is read and of the view.
#include <algorithm>

#include "tools/request/choices.h"
#include "tools/request/groups.h"
#include "tools/request/make_field.h"

namespace strata::tools {

namespace {

using scenes::SceneOptions;

bool set_size(PictureRequest& request, std::string_view text) {
    const auto size = to_size(text);
    if (!size) return false;
    request.render.width = size->width;
    request.render.height = size->height;
    return request.states_size = true;
}

void copy_size(PictureRequest& to, const PictureRequest& from) {
    to.render.width = from.render.width;
    to.render.height = from.render.height;
    to.states_size = from.states_size;
}

std::string size_text(const PictureRequest& request) {
    return fmt::format("{}x{}", request.render.width, request.render.height);
}

// The alphas of "glass=0.3,water=0.5".
std::optional<std::vector<scenes::MaterialAlpha>> to_material_alphas(std::string_view text) {
    std::vector<scenes::MaterialAlpha> materials;
    for (const std::string& part : split(text, ',')) {
        const std::size_t is = part.rfind('=');
        const auto alpha = is == std::string::npos ? std::nullopt : to_share(std::string_view(part).substr(is + 1));
        if (!alpha || is == 0) return std::nullopt;
        materials.push_back({part.substr(0, is), *alpha});
    }
    return materials;
}

// "0.5" for everything, or an alpha for each of some materials.
bool set_alpha(PictureRequest& request, std::string_view text) {
    const auto everything = to_share(text);
    const auto materials = everything ? std::optional{std::vector<scenes::MaterialAlpha>{}} : to_material_alphas(text);
    if (!materials) return false;
    request.render.alpha = everything;
    request.scene_options.alpha = *materials;
    return true;
}

void copy_alpha(PictureRequest& to, const PictureRequest& from) {
    to.render.alpha = from.render.alpha;
    to.scene_options.alpha = from.scene_options.alpha;
}

std::string alpha_text(const PictureRequest& request) {
    if (request.render.alpha) return fmt::format("{}", *request.render.alpha);
    std::string text;
    for (const scenes::MaterialAlpha& one : request.scene_options.alpha)
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", one.material, one.alpha);
    return text;
}

// A name that a file or a camera may have.
std::optional<std::string> to_name(std::string_view text) {
    return text.empty() ? std::nullopt : std::optional<std::string>{text};
}

std::string background_text(const pipeline::Rgba& b) {
    if (b == pipeline::Rgba{}) return "none";
    const std::string rgb = fmt::format("{},{},{}", b[0], b[1], b[2]);
    return b[3] == 1.0f ? rgb : fmt::format("{},{}", rgb, b[3]);
}

}  // namespace

std::vector<OptionField> view_fields() {
    using enum OptionGroup;
    std::vector<OptionField> all{
        choice<&PictureRequest::origin>(
            origin, "origin", origins,
            "the corner at which the device's memory begins; lower-left: OpenGL without glClipControl "
            "(default: the profile's own)"),
        number<&PictureRequest::scene_options, &SceneOptions::scene>(
            reading, {"scene", "N", "which scene of a glTF file (default: the file's own)", "a whole number from 0"},
            to_count),
        choice<&PictureRequest::scene_options, &SceneOptions::color_space>(
            reading, "color-space", color_spaces,
            "blend sRGB values as they are, or decoded to linear light (default encoded)"),
        flag<&PictureRequest::scene_options, &SceneOptions::light>(reading, "light", "draw every material unlit"),
        flag<&PictureRequest::scene_options, &SceneOptions::recentre>(
            reading, "recentre", "move the middle of the scene's bounds to the origin, as engines do with maps"),
        choice<&PictureRequest::scene_options, &SceneOptions::polygon_mode>(
            reading, "polygon-mode", polygon_modes,
            "glPolygonMode: draw triangles filled, as their sides or as their corners (default fill)"),
        joint(view,
              {"size", "WIDTHxHEIGHT", "pixels (default 1024x1024)",
               "WIDTHxHEIGHT such as 640x480, each from 1 to 16384"},
              set_size, size_text, copy_size),
        field<&PictureRequest::orbit>(
            view,
            {"orbit", "AZ,EL", "look at the scene's bounds from these degrees (default 30,20)",
             "azimuth and elevation in degrees such as 30,20"},
            to_orbit, [](const Orbit& orbit) { return fmt::format("{},{}", orbit.azimuth, orbit.elevation); }),
        field<&PictureRequest::camera>(
            view, {"camera", "NAME|FILE", "a camera of the scene, or a JSON file with one", "a camera's name or file"},
            to_name, [](const std::string& name) { return name; }),
        joint(view,
              {"alpha", "A|MATERIAL=A[,...]",
               "draw everything as transparent, its own alpha times A, or these materials alone",
               "a number from 0 to 1, or MATERIAL=A with commas between"},
              set_alpha, alpha_text, copy_alpha),
        field<&PictureRequest::background>(
            view,
            {"background", "R,G,B[,A]|none", "sRGB values from 0 to 1, and alpha; none is 0,0,0,0 (default 0,0,0,1)",
             background_expected},
            to_background, background_text),
    };
    for (OptionField& field : all) field.is_usual = true;
    return all;
}

}  // namespace strata::tools
