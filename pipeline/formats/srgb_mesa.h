// pipeline/formats/srgb_mesa.h - the linear values of the 256 sRGB codes as Mesa's software drivers have them.
//
// Rule     llvmpipe: code k up to 15 is k f32(1 / (12.6 * 255)), above that the cubic (k^2 c2 + c0) + (k^2 c3 + c1) k,
//          with each product and sum rounded to binary32, or fused where the processor fuses. softpipe: the value of
//          srgb.h in 8 significant decimal digits, rounded to binary32.
// Source   pipeline/reference/texturing.md 3.5 (measured; gallivm/lp_bld_format_srgb.c, util/format_srgb.py).
// Tests    tests/pipeline/textures/texel_lerps_test.cpp
#pragma once
#include <array>
#include <cstdint>

#include "rasterizer/base/fused.h"
#include "rasterizer/base/numerics.h"

namespace strata::pipeline {

// clang-format off
inline constexpr std::array<float, 256> srgb_in_8_digits{
    0.0000000e+09f, 3.0352698e-04f, 6.0705397e-04f, 9.1058095e-04f, 1.2141079e-03f, 1.5176349e-03f, 1.8211619e-03f,
    2.1246889e-03f, 2.4282159e-03f, 2.7317429e-03f, 3.0352698e-03f, 3.3465358e-03f, 3.6765073e-03f, 4.0247170e-03f,
    4.3914420e-03f, 4.7769535e-03f, 5.1815167e-03f, 5.6053916e-03f, 6.0488330e-03f, 6.5120908e-03f, 6.9954102e-03f,
    7.4990320e-03f, 8.0231930e-03f, 8.5681256e-03f, 9.1340587e-03f, 9.7212173e-03f, 1.0329823e-02f, 1.0960094e-02f,
    1.1612245e-02f, 1.2286488e-02f, 1.2983032e-02f, 1.3702083e-02f, 1.4443844e-02f, 1.5208514e-02f, 1.5996293e-02f,
    1.6807376e-02f, 1.7641954e-02f, 1.8500220e-02f, 1.9382361e-02f, 2.0288563e-02f, 2.1219010e-02f, 2.2173885e-02f,
    2.3153366e-02f, 2.4157632e-02f, 2.5186860e-02f, 2.6241222e-02f, 2.7320892e-02f, 2.8426040e-02f, 2.9556834e-02f,
    3.0713444e-02f, 3.1896033e-02f, 3.3104767e-02f, 3.4339807e-02f, 3.5601315e-02f, 3.6889450e-02f, 3.8204372e-02f,
    3.9546235e-02f, 4.0915197e-02f, 4.2311411e-02f, 4.3735029e-02f, 4.5186204e-02f, 4.6665086e-02f, 4.8171824e-02f,
    4.9706566e-02f, 5.1269458e-02f, 5.2860647e-02f, 5.4480276e-02f, 5.6128490e-02f, 5.7805430e-02f, 5.9511238e-02f,
    6.1246054e-02f, 6.3010018e-02f, 6.4803267e-02f, 6.6625939e-02f, 6.8478170e-02f, 7.0360096e-02f, 7.2271851e-02f,
    7.4213568e-02f, 7.6185381e-02f, 7.8187422e-02f, 8.0219820e-02f, 8.2282707e-02f, 8.4376212e-02f, 8.6500462e-02f,
    8.8655586e-02f, 9.0841711e-02f, 9.3058963e-02f, 9.5307467e-02f, 9.7587347e-02f, 9.9898728e-02f, 1.0224173e-01f,
    1.0461648e-01f, 1.0702310e-01f, 1.0946171e-01f, 1.1193243e-01f, 1.1443537e-01f, 1.1697067e-01f, 1.1953843e-01f,
    1.2213877e-01f, 1.2477182e-01f, 1.2743768e-01f, 1.3013648e-01f, 1.3286832e-01f, 1.3563333e-01f, 1.3843162e-01f,
    1.4126329e-01f, 1.4412847e-01f, 1.4702727e-01f, 1.4995979e-01f, 1.5292615e-01f, 1.5592646e-01f, 1.5896084e-01f,
    1.6202938e-01f, 1.6513219e-01f, 1.6826940e-01f, 1.7144110e-01f, 1.7464740e-01f, 1.7788842e-01f, 1.8116424e-01f,
    1.8447499e-01f, 1.8782077e-01f, 1.9120168e-01f, 1.9461783e-01f, 1.9806932e-01f, 2.0155625e-01f, 2.0507874e-01f,
    2.0863687e-01f, 2.1223076e-01f, 2.1586050e-01f, 2.1952620e-01f, 2.2322796e-01f, 2.2696587e-01f, 2.3074005e-01f,
    2.3455058e-01f, 2.3839757e-01f, 2.4228112e-01f, 2.4620133e-01f, 2.5015828e-01f, 2.5415209e-01f, 2.5818285e-01f,
    2.6225066e-01f, 2.6635560e-01f, 2.7049779e-01f, 2.7467731e-01f, 2.7889426e-01f, 2.8314874e-01f, 2.8744084e-01f,
    2.9177065e-01f, 2.9613827e-01f, 3.0054379e-01f, 3.0498731e-01f, 3.0946892e-01f, 3.1398871e-01f, 3.1854678e-01f,
    3.2314321e-01f, 3.2777810e-01f, 3.3245154e-01f, 3.3716362e-01f, 3.4191442e-01f, 3.4670406e-01f, 3.5153260e-01f,
    3.5640014e-01f, 3.6130678e-01f, 3.6625260e-01f, 3.7123768e-01f, 3.7626212e-01f, 3.8132601e-01f, 3.8642943e-01f,
    3.9157248e-01f, 3.9675523e-01f, 4.0197778e-01f, 4.0724021e-01f, 4.1254261e-01f, 4.1788507e-01f, 4.2326767e-01f,
    4.2869050e-01f, 4.3415364e-01f, 4.3965717e-01f, 4.4520119e-01f, 4.5078578e-01f, 4.5641102e-01f, 4.6207700e-01f,
    4.6778380e-01f, 4.7353150e-01f, 4.7932018e-01f, 4.8514994e-01f, 4.9102085e-01f, 4.9693300e-01f, 5.0288646e-01f,
    5.0888132e-01f, 5.1491767e-01f, 5.2099557e-01f, 5.2711513e-01f, 5.3327640e-01f, 5.3947949e-01f, 5.4572446e-01f,
    5.5201140e-01f, 5.5834039e-01f, 5.6471151e-01f, 5.7112483e-01f, 5.7758044e-01f, 5.8407842e-01f, 5.9061884e-01f,
    5.9720179e-01f, 6.0382734e-01f, 6.1049557e-01f, 6.1720656e-01f, 6.2396039e-01f, 6.3075714e-01f, 6.3759687e-01f,
    6.4447968e-01f, 6.5140564e-01f, 6.5837482e-01f, 6.6538730e-01f, 6.7244316e-01f, 6.7954247e-01f, 6.8668531e-01f,
    6.9387176e-01f, 7.0110189e-01f, 7.0837578e-01f, 7.1569350e-01f, 7.2305513e-01f, 7.3046074e-01f, 7.3791041e-01f,
    7.4540421e-01f, 7.5294222e-01f, 7.6052450e-01f, 7.6815115e-01f, 7.7582222e-01f, 7.8353779e-01f, 7.9129794e-01f,
    7.9910274e-01f, 8.0695226e-01f, 8.1484657e-01f, 8.2278575e-01f, 8.3076988e-01f, 8.3879901e-01f, 8.4687323e-01f,
    8.5499261e-01f, 8.6315721e-01f, 8.7136712e-01f, 8.7962240e-01f, 8.8792312e-01f, 8.9626935e-01f, 9.0466117e-01f,
    9.1309865e-01f, 9.2158186e-01f, 9.3011086e-01f, 9.3868573e-01f, 9.4730654e-01f, 9.5597335e-01f, 9.6468625e-01f,
    9.7344529e-01f, 9.8225055e-01f, 9.9110210e-01f, 1.0000000e+00f};
// clang-format on

inline namespace strict {

template <bool is_fused>
[[nodiscard]] constexpr float multiply_add(float a, float b, float c) noexcept {
    if constexpr (is_fused) return rasterizer::fused_multiply_add(a, b, c);
    const float product = a * b;
    return product + c;
}

template <bool is_fused>
[[nodiscard]] constexpr float srgb_by_cubic(std::uint32_t code) noexcept {
    const auto x = static_cast<float>(static_cast<std::int32_t>(code));
    if (code <= 15) return x * (1.0f / (12.6f * 255.0f));
    constexpr float c0 = 0.0023f, c1 = 0.0030f / 255.0f, c2 = 0.6935f / (255.0f * 255.0f),
                    c3 = 0.3012f / (255.0f * 255.0f * 255.0f);
    const float square = x * x;
    const float even = multiply_add<is_fused>(square, c2, c0), odd = multiply_add<is_fused>(square, c3, c1);
    return multiply_add<is_fused>(odd, x, even);
}

template <bool is_fused>
inline constexpr std::array<float, 256> srgb_cubic = [] {
    std::array<float, 256> table{};
    for (std::uint32_t code = 0; code < 256; ++code) table[code] = srgb_by_cubic<is_fused>(code);
    return table;
}();

}  // namespace strict
}  // namespace strata::pipeline
