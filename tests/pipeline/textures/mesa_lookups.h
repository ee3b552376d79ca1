// The red channel of lookups in a texture of 7 x 5 (texture_of of texel_lerps_test.cpp) whose axes mirror, or whose
// codes are sRGB, as Mesa 22.3.6 drew them: llvmpipe, llvmpipe without fused multiply-add, softpipe.
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/formats/texture.h"

namespace strata::testing::lerps_model {

struct MesaLookup {
    pipeline::TextureFilter filter;
    pipeline::TextureWrap wrap_s, wrap_t;
    bool decodes_srgb;
    std::uint32_t s, t;
    std::array<std::uint32_t, 3> red;
};

namespace lookups {
using enum pipeline::TextureFilter;
using enum pipeline::TextureWrap;
inline constexpr MesaLookup by_mesa[] = {
    {nearest, repeat, mirrored_repeat, false, 0x40249249, 0x40333333, {0x3f7dfdff, 0x3f7dfdff, 0x3f179798}},
    {nearest, repeat, mirrored_repeat, false, 0x42049249, 0xc0accccd, {0x3f4acacc, 0x3f4acacc, 0x3e0c8c8d}},
    {nearest, repeat, mirrored_repeat, false, 0xbf5b6db7, 0xbf4ccccd, {0x3f149495, 0x3f149495, 0x3f09898a}},
    {nearest, repeat, mirrored_repeat, false, 0x41892492, 0xc209999a, {0x3f4acacc, 0x3f4acacc, 0x3e0c8c8d}},
    {nearest, mirrored_repeat, mirrored_repeat, false, 0xbf5b6db7, 0xbecccccd, {0x3f60e0e2, 0x3f60e0e2, 0x3f119192}},
    {nearest, mirrored_repeat, mirrored_repeat, false, 0xbedb6db7, 0xbe4ccccd, {0x3f7bfbfd, 0x3f7bfbfd, 0x3ededee0}},
    {nearest, mirrored_repeat, mirrored_repeat, false, 0xbf124925, 0xbecccccd, {0x3e38b8b9, 0x3e38b8b9, 0x3e34b4b5}},
    {nearest, mirrored_repeat, mirrored_repeat, false, 0x40000000, 0xbecccccd, {0x3f4acacc, 0x3f4acacc, 0x3ecacacc}},
    {nearest, mirrored_repeat, clamp_to_edge, false, 0xbe124925, 0x3e4ccccd, {0x3f179798, 0x3f179798, 0x3ecacacc}},
    {nearest, mirrored_repeat, clamp_to_edge, false, 0xbe924925, 0xbecccccd, {0x3e949495, 0x3e949495, 0x3e149495}},
    {nearest, mirrored_repeat, clamp_to_edge, false, 0xbe924925, 0x3ecccccd, {0x3ef8f8fa, 0x3ef8f8fa, 0x3e0c8c8d}},
    {nearest, mirrored_repeat, clamp_to_edge, false, 0xbe124925, 0xbdcccccd, {0x3e149495, 0x3e149495, 0x00000000}},
    {linear, repeat, mirrored_repeat, false, 0xc1ab43a2, 0xc2028b39, {0x3f21c0ab, 0x3f21c0ac, 0x3f21c0ca}},
    {linear, repeat, mirrored_repeat, false, 0xbf7a72a5, 0x4190afeb, {0x3e9b330f, 0x3e9b3310, 0x3e9b330a}},
    {linear, repeat, mirrored_repeat, false, 0x409f68e6, 0x410a3a61, {0x3f2744e5, 0x3f2744e5, 0x3f2744ec}},
    {linear, repeat, mirrored_repeat, false, 0xbc76f823, 0xbf655f16, {0x3eda4470, 0x3eda4470, 0x3eda4472}},
    {linear, mirrored_repeat, mirrored_repeat, false, 0x3ebdb96b, 0xbe299ba6, {0x3ef00a41, 0x3ef00a40, 0x3ef00a43}},
    {linear, mirrored_repeat, mirrored_repeat, false, 0xbf23274a, 0x3eb1b114, {0x3e544ba9, 0x3e544ba8, 0x3e544baa}},
    {linear, mirrored_repeat, mirrored_repeat, false, 0x3f3ea813, 0xbf2393c3, {0x3eb03e43, 0x3eb03e44, 0x3eb03e43}},
    {linear, mirrored_repeat, mirrored_repeat, false, 0x3fc61a7c, 0x421a4050, {0x3f3dc85d, 0x3f3dc85c, 0x3f3dc85c}},
    {linear, mirrored_repeat, clamp_to_edge, false, 0xbe509f0f, 0x3ef50caf, {0x3e6905b7, 0x3e6905b6, 0x3e6905b4}},
    {linear, mirrored_repeat, clamp_to_edge, false, 0x3fe3574f, 0x3f3218c3, {0x3f3f95c9, 0x3f3f95ca, 0x3f3f95c8}},
    {linear, mirrored_repeat, clamp_to_edge, false, 0xbf2a3353, 0x3f1ba771, {0x3ec9da83, 0x3ec9da82, 0x3ec9da82}},
    {linear, mirrored_repeat, clamp_to_edge, false, 0x40321566, 0xc07c9e3d, {0x3f38e781, 0x3f38e780, 0x3f38e780}},
    {nearest, repeat, repeat, true, 0xbff3a422, 0xbe0fa4ab, {0x3e97d3b9, 0x3e97d3b8, 0x3e979f6f}},
    {nearest, repeat, repeat, true, 0x41b4db2a, 0x4110665e, {0x3e97d3b9, 0x3e97d3b8, 0x3e979f6f}},
    {nearest, repeat, repeat, true, 0xc078a652, 0x3ee51db0, {0x3f16eead, 0x3f16eead, 0x3f1732cc}},
    {nearest, repeat, repeat, true, 0xc1d6232a, 0xc1410f0c, {0x3e806815, 0x3e806815, 0x3e8014bf}},
    {nearest, repeat, clamp_to_edge, true, 0x4197e73f, 0xc18568f9, {0x3f3ab1cf, 0x3f3ab1d0, 0x3f3aff7a}},
    {nearest, repeat, clamp_to_edge, true, 0x3f4799d2, 0xbeee9278, {0x3ef810f0, 0x3ef810ef, 0x3ef86593}},
    {nearest, repeat, clamp_to_edge, true, 0x3fbd985e, 0x407ccbb5, {0x3e307633, 0x3e307633, 0x3e2f8e41}},
    {nearest, repeat, clamp_to_edge, true, 0x4189a740, 0xc016ae83, {0x3c958d89, 0x3c958d89, 0x3c978dc6}},
    {nearest, mirrored_repeat, mirrored_repeat, true, 0x00000000, 0xbf19999a, {0x3ce7d187, 0x3ce7d186, 0x3ce8ddba}},
    {nearest, mirrored_repeat, mirrored_repeat, true, 0xc0524e6a, 0xbfcd9a81, {0x3cd5a909, 0x3cd5a90a, 0x3cd6f7d5}},
    {nearest, mirrored_repeat, mirrored_repeat, true, 0xc13d6ee1, 0x41531faa, {0x3e806815, 0x3e806815, 0x3e8014bf}},
    {nearest, mirrored_repeat, mirrored_repeat, true, 0xbfd522c3, 0x3fc6066d, {0x3e4f3c98, 0x3e4f3c98, 0x3e4e64c3}},
    {nearest, clamp_to_edge, clamp_to_edge, true, 0x420a145b, 0xc214e660, {0x3f3ab1cf, 0x3f3ab1d0, 0x3f3aff7a}},
    {nearest, clamp_to_edge, clamp_to_edge, true, 0x3f924925, 0xbfcccccd, {0x3f3ab1cf, 0x3f3ab1d0, 0x3f3aff7a}},
    {nearest, clamp_to_edge, clamp_to_edge, true, 0xbd49f226, 0x3f15e4c4, {0x3f16eead, 0x3f16eead, 0x3f1732cc}},
    {nearest, clamp_to_edge, clamp_to_edge, true, 0xbd9b09ba, 0x3f0bd368, {0x3f16eead, 0x3f16eead, 0x3f1732cc}},
    {linear, repeat, repeat, true, 0x00000000, 0xbf666666, {0x3ebab1ce, 0x3ebab1cf, 0x3ebaff7a}},
    {linear, repeat, repeat, true, 0xbf13b940, 0xc1e1a4c8, {0x3ebafd67, 0x3ebafd68, 0x3ebaae48}},
    {linear, repeat, repeat, true, 0xbe54f1f9, 0x3ffde39c, {0x3e8a710a, 0x3e8a710a, 0x3e8a5a43}},
    {linear, repeat, repeat, true, 0x3ea84409, 0x3ea3f036, {0x3efbd682, 0x3efbd682, 0x3efc2730}},
    {linear, repeat, clamp_to_edge, true, 0x00000000, 0x3f666666, {0x3e4357e0, 0x3e4357de, 0x3e42d2ca}},
    {linear, repeat, clamp_to_edge, true, 0x42139dad, 0x41501b02, {0x3db6f7e6, 0x3db6f7e5, 0x3db5a58d}},
    {linear, repeat, clamp_to_edge, true, 0xc01df1f2, 0x40419d8d, {0x3e28dd01, 0x3e28dd01, 0x3e27f567}},
    {linear, repeat, clamp_to_edge, true, 0xbf5cec07, 0x3f37fbe5, {0x3e908cc1, 0x3e908cc1, 0x3e90c67e}},
    {linear, mirrored_repeat, mirrored_repeat, true, 0xbf15bea4, 0xbf33b2e3, {0x3f140362, 0x3f140363, 0x3f13fa09}},
    {linear, mirrored_repeat, mirrored_repeat, true, 0x3f65d42d, 0xbf7a04b9, {0x3db937a0, 0x3db9379f, 0x3db7e142}},
    {linear, mirrored_repeat, mirrored_repeat, true, 0x00000000, 0x3ecccccd, {0x3eb877cc, 0x3eb877cc, 0x3eb8836c}},
    {linear, mirrored_repeat, mirrored_repeat, true, 0x4026b931, 0xc0462595, {0x3e1799bd, 0x3e1799bd, 0x3e16b2e7}},
    {linear, clamp_to_edge, clamp_to_edge, true, 0x4008b98f, 0xbec61fb2, {0x3f3ab1cf, 0x3f3ab1d0, 0x3f3aff7a}},
    {linear, clamp_to_edge, clamp_to_edge, true, 0x4017b199, 0xc0513cd6, {0x3f3ab1cf, 0x3f3ab1d0, 0x3f3aff7a}},
    {linear, clamp_to_edge, clamp_to_edge, true, 0x00000000, 0x3f19999a, {0x3e9e2d39, 0x3e9e2d39, 0x3e9e79ba}},
    {linear, clamp_to_edge, clamp_to_edge, true, 0xbf467e84, 0x3e3f60b5, {0x3d691e86, 0x3d691e86, 0x3d6795c5}},
};
}  // namespace lookups

}  // namespace strata::testing::lerps_model
