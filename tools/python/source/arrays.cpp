// source/arrays.cpp - converts codes of pictures to NumPy arrays, and arrays to pictures.
#include <algorithm>
#include <bit>
#include <cstring>

#include "bindings.h"

namespace strata::python {

namespace {

template <class Narrow>
py::array packed(const py::dtype& type, const std::vector<py::ssize_t>& shape, const std::uint32_t* codes,
                 std::size_t count) {
    py::array array(type, shape);
    auto* to = static_cast<Narrow*>(array.mutable_data());
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<Narrow>(codes[i]);
    return array;
}

template <class Owner>
py::array of_codes(const char* type, const std::vector<py::ssize_t>& shape, const std::uint32_t* codes,
                   std::size_t count, const Owner& owner) {
    const py::dtype element{std::string{type}};
    switch (element.itemsize()) {
        case 1: return packed<std::uint8_t>(element, shape, codes, count);
        case 2: return packed<std::uint16_t>(element, shape, codes, count);
        default: return shared_array(element, shape, {}, codes, owner);
    }
}

const char* type_of(pipeline::Format format) {
    switch (pipeline::info(format).type) {
        case pipeline::ChannelType::unorm8:
        case pipeline::ChannelType::stencil: return "u1";
        case pipeline::ChannelType::unorm10: return "u2";
        case pipeline::ChannelType::half: return "f2";
        case pipeline::ChannelType::single: return "f4";
        case pipeline::ChannelType::depth: break;
    }
    switch (pipeline::depth_format(format)) {
        case pipeline::DepthFormat::d16:
        case pipeline::DepthFormat::d16f: return "u2";
        case pipeline::DepthFormat::d24:
        case pipeline::DepthFormat::d24f: return "u4";
        case pipeline::DepthFormat::d32f: break;
    }
    return "f4";
}

const char* type_of(oracle::Code code) {
    switch (code) {
        case oracle::Code::unorm8: return "u1";
        case oracle::Code::unorm10:
        case oracle::Code::unorm16: return "u2";
        case oracle::Code::half: return "f2";
        case oracle::Code::single: return "f4";
        case oracle::Code::unorm24:
        case oracle::Code::integer: break;
    }
    return "u4";
}

oracle::Code code_of(const py::array& array, bool is_depth) {
    const py::dtype type = array.dtype();
    const bool is_native = type.byteorder() == '=' || type.byteorder() == '<' || type.byteorder() == '|';
    const auto is = [&](char kind, py::ssize_t size) {
        return is_native && type.kind() == kind && type.itemsize() == size;
    };
    if (is('u', 1)) return oracle::Code::unorm8;
    if (is('u', 2)) return oracle::Code::unorm16;
    if (is('u', 4)) return is_depth ? oracle::Code::unorm24 : oracle::Code::integer;
    if (is('f', 2)) return oracle::Code::half;
    if (is('f', 4)) return oracle::Code::single;
    throw InputError("picture", "dtype", "uint8, uint16, uint32, float16, float32 or float64",
                     py::str(static_cast<py::handle>(type)).cast<std::string>());
}

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

}  // namespace

py::array as_array(const std::shared_ptr<const Image>& image) {
    std::vector<py::ssize_t> shape{image->height, image->width};
    if (image->samples > 1) shape.push_back(image->samples);
    if (image->channels() > 1) shape.push_back(image->channels());
    return of_codes(type_of(image->format), shape, image->codes.data(), image->codes.size(), image);
}

py::array as_array(oracle::TargetImage&& target) {
    const auto kept = std::make_shared<const oracle::TargetImage>(std::move(target));
    std::vector<py::ssize_t> shape{kept->height, kept->width};
    if (kept->channels > 1) shape.push_back(kept->channels);
    return of_codes(type_of(kept->code), shape, kept->codes.data(), kept->codes.size(), kept);
}

namespace {

// In the machine's order of bytes; float64 as float32, booleans as bytes.
py::array with_stored_type(const py::array& given) {
    const py::dtype type = given.dtype();
    const bool is_native = type.byteorder() != (std::endian::native == std::endian::little ? '>' : '<');
    const bool is_double = type.kind() == 'f' && type.itemsize() == 8;
    if (is_double) return given.attr("astype")("float32");
    return is_native ? given : py::array{given.attr("astype")(type.attr("newbyteorder")("="))};
}

}  // namespace

Picture picture_of_array(const py::array& any, const std::string& meaning) {
    const py::array given = with_stored_type(any);
    const bool is_plane = given.ndim() == 2 || (given.ndim() == 3 && given.shape(2) == 1);
    if (meaning != "" && meaning != "color" && meaning != "depth")
        throw InputError("picture", "meaning", "color or depth", "'" + meaning + "'");
    const auto fits = [](py::ssize_t side) { return side >= 1 && side <= 16384; };
    if ((given.ndim() != 2 && given.ndim() != 3) || !fits(given.shape(0)) || !fits(given.shape(1)) ||
        (given.ndim() == 3 && (given.shape(2) < 1 || given.shape(2) > 4)))
        throw InputError("picture", "shape", "(rows, columns) or (rows, columns, channels), at most 16384 and 4",
                         shape_text(given));
    const bool is_wide = given.dtype().itemsize() == 4;
    const bool is_depth = meaning == "depth" || (meaning == "" && is_plane && is_wide);
    if (is_depth && !is_plane) throw InputError("picture", "shape", "(rows, columns) of a depth", shape_text(given));
    oracle::TargetImage target{.name = is_depth ? "depth" : "color",
                               .meaning = is_depth ? oracle::Meaning::depth : oracle::Meaning::color,
                               .code = code_of(given, is_depth),
                               .width = static_cast<int>(given.shape(1)),
                               .height = static_cast<int>(given.shape(0)),
                               .channels = given.ndim() == 3 ? static_cast<int>(given.shape(2)) : 1};
    const py::array array = py::array::ensure(given, py::array::c_style);
    const auto size = static_cast<std::size_t>(array.itemsize());
    target.codes.resize(static_cast<std::size_t>(array.size()));
    const auto* bytes = static_cast<const std::byte*>(array.data());
    for (std::size_t i = 0; i < target.codes.size(); ++i) std::memcpy(&target.codes[i], bytes + i * size, size);
    return {"array", {std::move(target)}};
}

}  // namespace strata::python
