// tools/oracle/pack/target_json.h - writes a target into a pack: its codes as an array, and digests of the whole, of
// channels and of tiles.
//
// Rule     tools/oracle/pack/PACK.md. A target that has not changed since it was last written refers to its earlier
//          file.
// Tests    tests/tools/oracle/pack/golden_test.cpp
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/formats/image.h"
#include "scenes/packs/pack_files.h"

namespace strata::oracle {

inline constexpr int pack_tile_px = 16;

// The element type of its codes in a file.
[[nodiscard]] scenes::Element element_of(pipeline::Format format) noexcept;

// Converts a target to an array and back; as_image is empty if the array does not fit `format` and `samples`.
[[nodiscard]] scenes::NumberArray as_array(const pipeline::Image& image);
[[nodiscard]] std::optional<pipeline::Image> as_image(const scenes::NumberArray& array, pipeline::Format format,
                                                      int samples);

// Writes the targets of one algorithm.
class TargetWriter {
  public:
    // Files are written below `folder`, as in "expected/dual".
    TargetWriter(std::string folder, scenes::PackFiles& files) : folder_{std::move(folder)}, files_{files} {}

    // `place` is "" or ends with a slash. write_once refers to the last file of that target if its content is the same.
    [[nodiscard]] nlohmann::ordered_json write(const std::string& place, const std::string& name,
                                               const pipeline::Image& image);
    [[nodiscard]] nlohmann::ordered_json write_once(const std::string& place, const std::string& name,
                                                    const pipeline::Image& image);

  private:
    struct Written {
        std::string digest, file;
    };
    std::string folder_;
    scenes::PackFiles& files_;
    std::map<std::string, Written> last_{};
};

}  // namespace strata::oracle
