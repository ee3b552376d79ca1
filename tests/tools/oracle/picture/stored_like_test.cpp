// Tests how rendered colours are converted to those of a file against the writer of PNG files.
#include "tools/oracle/picture/stored_like.h"

#include <bit>
#include <catch2/catch.hpp>
#include <random>

#include "scenes/files/image_io.h"
#include "tests/tools/oracle/picture/own_file.h"

using namespace strata;
using namespace strata::oracle;

namespace {

// Premultiplied colours from a little below 0 to a little above their alpha.
pipeline::Image random_colors(pipeline::Format format) {
    pipeline::Image image{format, 61, 53};
    std::mt19937 random{7};
    std::uniform_real_distribution<float> share{-0.02f, 1.05f};
    for (std::size_t i = 0; i < image.codes.size(); i += 4) {
        const float alpha = random() % 4 == 0 ? 1.0f : std::clamp(share(random), 0.0f, 1.0f);
        for (std::size_t c = 0; c < 4; ++c) {
            const float value = c < 3 ? share(random) * alpha : alpha;
            const Code code = code_of(format);
            image.codes[i + c] = nearest(code, double{value});
        }
    }
    return image;
}

}  // namespace

TEST_CASE("a rendered target stored like a PNG has the codes that the writer of PNG files writes") {
    for (const pipeline::Format format : {pipeline::Format::rgba8, pipeline::Format::rgba16f, pipeline::Format::rgba32f,
                                          pipeline::Format::srgb8_alpha8, pipeline::Format::rgb10_a2})
        for (const pipeline::ColorSpace space : {pipeline::ColorSpace::encoded, pipeline::ColorSpace::linear}) {
            const pipeline::Image image = random_colors(format);
            TargetImage rendered = as_target(image, "color");
            rendered.alpha_form = AlphaForm::premultiplied;
            const test::OwnFile file{".png"};
            scenes::write_image(file.path(), {.color = image, .premultiplied = true, .space = space});
            const Picture read = read_picture(file.path());
            REQUIRE(read.targets[0].holds_encoded);
            const auto stored = stored_like(rendered, read.targets[0], space);
            const bool is_same = format == pipeline::Format::rgba8 && space == pipeline::ColorSpace::encoded;
            INFO(pipeline::info(format).name << ", linear: " << (space == pipeline::ColorSpace::linear));
            REQUIRE(stored.has_value() != is_same);
            if (!stored) continue;
            CHECK(stored->codes == read.targets[0].codes);
            CHECK(stored->alpha_form == AlphaForm::straight);
        }
}

// 255 times 0.7 in binary32 is 178.499997: codes 178 and 179 are right, and no others.
TEST_CASE("a value in the middle between two codes has either one and no other value has") {
    using pipeline::ColorSpace;
    TargetImage rendered{.name = "color", .code = Code::single, .width = 2, .height = 1, .channels = 4};
    for (const float value : {0.7f, 0.7f, 0.7f, 1.0f, 0.25f, 0.25f, 0.25f, 1.0f})
        rendered.codes.push_back(std::bit_cast<std::uint32_t>(value));
    TargetImage file{.name = "color", .width = 2, .height = 1, .channels = 3, .holds_encoded = true};
    const auto differing = [&](std::vector<std::uint32_t> codes) {
        file.codes = std::move(codes);
        return differing_at_ties(rendered, file, ColorSpace::encoded);
    };
    CHECK(differing({178, 178, 178, 64, 64, 64}) == 0u);
    CHECK(differing({178, 179, 178, 64, 64, 64}) == 1u);
    CHECK(differing({179, 179, 179, 64, 64, 64}) == 1u);
    CHECK_FALSE(differing({177, 178, 178, 64, 64, 64}));
    CHECK_FALSE(differing({180, 178, 178, 64, 64, 64}));
    CHECK_FALSE(differing({178, 178, 178, 63, 64, 64}));
    CHECK_FALSE(differing({178, 178, 178, 64, 64, 65}));
    CHECK_FALSE(differing_at_ties(rendered, rendered, ColorSpace::encoded));
}

TEST_CASE("targets compared with an EXR or with plain numbers are left as they were rendered") {
    const pipeline::Image image = random_colors(pipeline::Format::rgba16f);
    TargetImage rendered = as_target(image, "color");
    rendered.alpha_form = AlphaForm::premultiplied;
    const test::OwnFile file{".exr"};
    scenes::write_image(file.path(), {.color = image, .premultiplied = true, .space = pipeline::ColorSpace::linear});
    CHECK_FALSE(stored_like(rendered, read_picture(file.path()).targets[0], pipeline::ColorSpace::linear));
    CHECK_FALSE(stored_like(rendered, as_target(image, "color"), pipeline::ColorSpace::linear));
}
