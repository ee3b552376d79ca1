// scenes/files/png.cpp - PNG files: written from 8-bit colours that are not premultiplied (straight_color.cpp), read by
// the image module.
#include <algorithm>
#include <span>

#include "rasterizer/base/input_error.h"
#include "scenes/file_ending.h"
#include "scenes/files/image_decode.h"
#include "scenes/files/image_formats.h"
#include "scenes/files/text_file.h"
#include "scenes/images/png_encode.h"
#include "scenes/memory_limit.h"

namespace strata::scenes {
namespace {

using pipeline::Format;
using pipeline::Image;

// The largest image, 16384 x 16384 of 4 codes, has 2^30 bytes uncompressed, and 2^31 with 16 bits per code.
constexpr std::size_t max_png_bytes = std::size_t{1} << 31;

}  // namespace

void write_png(const std::string& path, const OutputColor& image) {
    const Image straight = as_straight_rgba8(image);
    PngPicture picture{.width = straight.width,
                       .height = straight.height,
                       .channels = 4,
                       .row =
                           [&](int y, std::uint8_t* codes) {
                               const auto* from = &straight.codes[straight.index(0, y, 0)];
                               std::copy_n(from, static_cast<std::size_t>(straight.width) * 4, codes);
                           },
                       .texts = prefixed(image.attributes)};
    picture.texts.emplace("Software", "strata");
    write_with(path, [&](const ByteSink& sink) {
        return encode_png(picture,
                          [&](const void* bytes, std::size_t size) { return sink.write(bytes, size) == size; });
    });
}

const char* reader_of(const std::string& path) {
    constexpr std::pair<std::string_view, const char*> readers[]{
        {".png", "png"}, {".jpg", "jpeg"},  {".jpeg", "jpeg"}, {".ppm", "pnm"}, {".pgm", "pnm"},  {".pbm", "pnm"},
        {".pnm", "pnm"}, {".tga", "targa"}, {".bmp", "bmp"},   {".hdr", "hdr"}, {".tif", "tiff"}, {".tiff", "tiff"}};
    for (const auto& [ending, reader] : readers)
        if (has_ending(path, ending)) return reader;
    return nullptr;
}

FileCodes read_codes(const std::string& path, const char* reader) {
    const std::string file = read_text_file(path, max_png_bytes);
    const Bytes bytes = std::as_bytes(std::span{file});
    const FileLocation location{path, ""};
    EncodedPicture picture{.bytes = bytes, .reader = reader};
    // Damage that libpng and libjpeg would report on their own is found before they read the file.
    const bool is_png = reader == std::string_view{"png"};
    if (is_png || reader == std::string_view{"jpeg"}) {
        const ImageHeader header = read_image_header(bytes, location);
        if (is_png != (header.kind == ImageKind::png))
            throw InputError(path, "format", is_png ? "a PNG" : "a JPEG", is_png ? "a JPEG" : "a PNG");
        if (is_png) check_png_place(bytes, location);
        picture.width = static_cast<int>(header.width);
        picture.height = static_cast<int>(header.height);
    }
    if (reader == std::string_view{"bmp"}) check_bmp_pixels(bytes, location);
    picture.check = [](const FileLocation& place, int width, int height, std::uint64_t bytes_a_pixel) {
        check_pixels(place.file, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), bytes_a_pixel);
    };
    return image_module().decode_codes(picture, location);
}

std::vector<FileImage> read_png(const std::string& path) {
    const std::string file = read_text_file(path, max_png_bytes);
    const Bytes bytes = std::as_bytes(std::span{file});
    const FileLocation location{path, ""};
    const ImageHeader header = read_image_header(bytes, location);  // chunks are whole: libpng prints nothing
    // PNG 11.2.2: bit depth and colour type, of which bit 1 means colour.
    if (header.kind != ImageKind::png || bytes[24] != std::byte{8} || (bytes[25] & std::byte{2}) == std::byte{0})
        throw InputError(path, "format", "a PNG with 8 bits per channel, RGB or RGBA", "another kind of image");
    check_png_place(bytes, location);
    const std::vector<std::uint8_t> codes = decode_image(bytes, header, location);
    Image image = Image::for_overwrite(Format::rgba8, static_cast<int>(header.width), static_cast<int>(header.height));
    std::copy_n(codes.data(), codes.size(), image.codes.data());
    return {{"", "color", std::move(image)}};
}

}  // namespace strata::scenes
