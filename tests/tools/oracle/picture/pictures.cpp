#include "tests/tools/oracle/picture/pictures.h"

namespace strata::test {

oracle::TargetImage make_target(const std::string& part, oracle::Code code, int width, int height, int channels,
                                const std::function<Texel(int x, int y)>& texel) {
    oracle::TargetImage target{.part = part,
                               .name = channels == 1 ? "depth" : "color",
                               .meaning = channels == 1 ? oracle::Meaning::depth : oracle::Meaning::color,
                               .code = code,
                               .width = width,
                               .height = height,
                               .channels = channels};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Texel codes = texel(x, y);
            target.codes.insert(target.codes.end(), codes.begin(), codes.begin() + channels);
        }
    return target;
}

oracle::Picture make_picture(std::vector<oracle::TargetImage> targets) { return {"made.png", std::move(targets)}; }

bool is_in_ellipse(double x, double y) {
    const double u = (x + 0.5 - 19.3) / 13.1, v = (y + 0.5 - 15.2) / 9.7;
    return u * u + v * v < 1;
}

Texel ellipse_texel(int x, int y) {
    if (!is_in_ellipse(x, y)) return {10, 20, 30, 255};
    const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
    return {60 + 4 * i, 40 + 5 * j, 30 + (i * 7 + j * 13) % 190, 255};
}

oracle::Picture ellipse() { return make_picture({make_target("", oracle::Code::unorm8, 40, 30, 4, ellipse_texel)}); }

}  // namespace strata::test
