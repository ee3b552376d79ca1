// scenes/files/deep_exr.cpp - a layered depth image: every fragment of every pixel in one deep EXR file.
//
// Rule     Channels R G B A (FLOAT, premultiplied), Z (FLOAT), Zbits and id (UINT32: depth code and primitive). Samples
//          stand in the order of `fragments`, which need not be that of Z.
#include <OpenImageIO/deepdata.h>

#include <cassert>
#include <numeric>

#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/image_formats.h"

namespace strata::scenes {
namespace {

using OIIO::TypeDesc;

enum Channel : int { red, green, blue, alpha, depth, depth_code, id, channel_count };
constexpr const char* names[channel_count] = {"R", "G", "B", "A", "Z", "Zbits", "id"};

OIIO::ImageSpec deep_spec(const DeepFragments& fragments, const Attributes& attributes) {
    OIIO::ImageSpec spec = base_spec(fragments.width, fragments.height, attributes);
    for (int c = 0; c < channel_count; ++c) {
        spec.channelnames.emplace_back(names[c]);
        spec.channelformats.emplace_back(c < depth_code ? TypeDesc::FLOAT : TypeDesc::UINT32);
    }
    spec.nchannels = channel_count;
    spec.deep = true;
    spec.attribute("compression", "zips");  // the strongest that deep images may have
    return spec;
}

void set_sample(OIIO::DeepData& data, std::int64_t pixel, int sample, const DeepFragments& fragments, std::size_t i) {
    const pipeline::Rgba& color = fragments.rgba[i];
    for (int c = red; c < alpha; ++c)
        data.set_deep_value(pixel, c, sample, color[static_cast<std::size_t>(c)] * color[3]);
    data.set_deep_value(pixel, alpha, sample, color[3]);
    data.set_deep_value(pixel, depth, sample, fragments.z[i]);
    data.set_deep_value(pixel, depth_code, sample, fragments.depth_code[i]);
    data.set_deep_value(pixel, id, sample, fragments.primitive[i]);
}

void append_sample(const OIIO::DeepData& data, std::int64_t pixel, int sample, const int (&index)[channel_count],
                   DeepFragments& fragments) {
    pipeline::Rgba color{};
    for (int c = red; c <= alpha; ++c) color[static_cast<std::size_t>(c)] = data.deep_value(pixel, index[c], sample);
    fragments.rgba.push_back(color);
    fragments.z.push_back(data.deep_value(pixel, index[depth], sample));
    fragments.depth_code.push_back(data.deep_value_uint(pixel, index[depth_code], sample));
    fragments.primitive.push_back(data.deep_value_uint(pixel, index[id], sample));
}

OIIO::DeepData deep_data(const OIIO::ImageSpec& spec, const DeepFragments& fragments) {
    OIIO::DeepData data{spec};
    data.set_all_samples(fragments.count);
    std::size_t fragment = 0;
    for (std::int64_t pixel = 0; pixel < data.pixels(); ++pixel)
        for (int sample = 0; sample < data.samples(pixel); ++sample)
            set_sample(data, pixel, sample, fragments, fragment++);
    return data;
}

}  // namespace

void write_deep(const std::string& path, const DeepFragments& fragments, const Attributes& attributes) {
    const FloatEnvironment environment;
    assert(std::accumulate(fragments.count.begin(), fragments.count.end(), std::size_t{0}) == fragments.z.size());
    if (image_file(path) != ImageFile::exr)
        throw InputError(path, "name", "a file name that ends in .exr", "another ending");
    const OIIO::ImageSpec spec = deep_spec(fragments, attributes);
    const OIIO::DeepData data = deep_data(spec, fragments);
    write_exr_by_name(path, [&](OIIO::ImageOutput& output, const std::string& name) {
        return output.open(name, spec) && output.write_deep_image(data) && output.close();
    });
}

DeepFragments read_deep(const std::string& path) {
    const FloatEnvironment environment;
    const auto input = open_exr(path);
    const OIIO::ImageSpec spec = input->spec();
    OIIO::DeepData data;
    if (!spec.deep || !input->read_native_deep_image(0, 0, data))
        throw InputError(path, "part 0", "a whole deep image", "none");
    int index[channel_count];
    for (int c = 0; c < channel_count; ++c) {
        index[c] = spec.channelindex(names[c]);
        if (index[c] < 0) throw InputError(path, "part 0", std::string{"a channel "} + names[c], "none");
    }
    DeepFragments fragments{.width = spec.width, .height = spec.height};
    for (std::int64_t pixel = 0; pixel < data.pixels(); ++pixel) {
        fragments.count.push_back(static_cast<std::uint32_t>(data.samples(pixel)));
        for (int sample = 0; sample < data.samples(pixel); ++sample)
            append_sample(data, pixel, sample, index, fragments);
    }
    return fragments;
}

}  // namespace strata::scenes
