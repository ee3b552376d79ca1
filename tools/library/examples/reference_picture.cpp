// Compares a picture in a renderer's memory with the reference. Here the memory contains the reference with one pixel
// changed.
#include <strata/strata.h>

#include <cstdio>

int main() try {
    const float corners[] = {-1, -1, 0, 1, -1, 0, -1, 1, 0.5f};
    strata::Scene scene;
    scene.add({.name = "front", .positions = {corners, 3}, .color = {1, 0, 0, 0.5f}});
    const strata::Rendering wanted =
        strata::render(scene, strata::algorithm("dual"), strata::profile("geforce8"), {.width = 64, .height = 48});
    auto pixels = strata::to_memory(wanted.color());
    pixels[4 * (40 * 64 + 5)] ^= std::byte{1};

    const auto mine = strata::from_memory(pixels.data(), pixels.size(), "64x48:rgba8");
    const auto found = strata::compare(strata::picture_of(wanted.color()), mine);
    std::printf("%s\n%s", wanted.digest().c_str(), strata::oracle::to_text(found).c_str());
    return found.equal ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
