// tools/web/workbench.h - what the page asks of the renderer: scenes, pictures, layers and histories, in JSON and plain arrays.
//
// Rule     A question is an object with "do"; its other fields have the names and meaning of the command's options, so that `strata render`
//          with the same gives the same digest. The answer is an object, too; one with "error" is a sentence for people. Arrays that
//          belong to an answer stay where they are until the next question of the same kind.
// Tests    tools/web/test.sh
#pragma once
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "peeling/render.h"
#include "scenes/scene.h"
#include "tools/strata/report/survey.h"

namespace strata::web {

class Workbench {
  public:
    // A .glb or .gltf that questions name as "scene".
    void keep_file(const std::string& name, std::vector<std::byte> bytes) { files_[name] = std::move(bytes); }

    // Throws nothing but std::bad_alloc.
    [[nodiscard]] std::string answer(const std::string& question);

  private:
    using Json = nlohmann::ordered_json;

    [[nodiscard]] Json answer_of(const Json& question);
    void open(const Json& question);
    [[nodiscard]] Json render(const Json& question);
    [[nodiscard]] Json layers(const Json& question);
    [[nodiscard]] Json explain(const Json& question);
    [[nodiscard]] scenes::Scene load(const std::string& name, const scenes::SceneOptions& options) const;

    std::map<std::string, std::vector<std::byte>> files_;
    std::string scene_key_;
    std::optional<scenes::Scene> scene_;
    pipeline::View view_;
    pipeline::DeviceProfile profile_;
    peeling::RenderOptions options_;
    pipeline::ColorSpace space_ = pipeline::ColorSpace::encoded;
    std::vector<std::uint8_t> picture_;  // r, g, b, a, straight
    std::vector<std::uint32_t> codes_;
    tools::Columns columns_;
    std::vector<std::uint32_t> numbers_[3];  // depth code, triangle, arrival
    std::vector<float> values_[5];           // depth, red, green, blue, alpha
};

}  // namespace strata::web
