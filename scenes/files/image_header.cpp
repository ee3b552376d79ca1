// scenes/files/image_header.cpp - reads the size of a PNG or JPEG and checks it before a decoder runs. See
// image_decode.h.
#include <algorithm>
#include <array>

#include "scenes/files/image_decode.h"

namespace strata::scenes {
namespace {

constexpr std::array<unsigned char, 8> png_signature{0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
constexpr std::uint64_t deflate_ratio = 1032;  // the largest expansion of a deflate stream
constexpr int max_jpeg_scans = 64;             // each scan is a pass over the whole image: few bytes, much time

std::uint32_t byte_at(Bytes bytes, std::size_t at) { return std::to_integer<std::uint32_t>(bytes[at]); }
std::uint32_t big_endian16(Bytes bytes, std::size_t at) { return byte_at(bytes, at) << 8 | byte_at(bytes, at + 1); }
std::uint32_t big_endian32(Bytes bytes, std::size_t at) {
    return big_endian16(bytes, at) << 16 | big_endian16(bytes, at + 2);
}

// The bytes decide the format; the caller compares it with the type that a file states.
bool is_png(Bytes bytes) {
    return bytes.size() >= png_signature.size() &&
           std::equal(png_signature.begin(), png_signature.end(), bytes.begin(),
                      [](unsigned char s, std::byte b) { return s == std::to_integer<unsigned char>(b); });
}
bool is_jpeg(Bytes bytes) { return bytes.size() >= 3 && big_endian16(bytes, 0) == 0xffd8 && byte_at(bytes, 2) == 0xff; }

// `least_bytes` is the size of the smallest file that can contain an image of this size: a larger claim is rejected
// before memory for its texels is allocated.
void check_size(const ImageHeader& header, std::uint64_t least_bytes, std::size_t bytes, const FileLocation& location) {
    const std::string size = std::to_string(header.width) + " x " + std::to_string(header.height);
    if (header.width == 0 || header.height == 0) location.fail("IMAGE_DATA_INVALID", "an image with texels", size);
    if (header.width > max_image_side || header.height > max_image_side)
        location.fail("VALUE_NOT_IN_RANGE", "an image of at most 16384 x 16384", size);
    if (least_bytes > bytes)
        location.fail("IMAGE_UNEXPECTED_EOS",
                      "at least " + std::to_string(least_bytes) + " bytes for " + size + " texels",
                      std::to_string(bytes) + " bytes");
}

// The checksum covers the chunk's type and data, PNG 5.5; the table has its value for each byte.
constexpr std::array<std::uint32_t, 256> crc_table = [] {  // PNG annex D
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
        std::uint32_t c = n;
        for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
        table[n] = c;
    }
    return table;
}();

std::uint32_t crc32(Bytes bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const std::byte b : bytes) crc = crc_table[(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff] ^ (crc >> 8);
    return ~crc;
}

// Requires whole chunks with correct checksums up to IEND: libpng, which prints messages of its own, never sees
// accidental damage.
void check_png_chunks(Bytes bytes, const FileLocation& location) {
    constexpr std::size_t frame = 12;  // length, type, checksum
    constexpr std::uint32_t iend = 0x49454e44;
    for (std::size_t at = png_signature.size();;) {
        const std::size_t left = bytes.size() - at;
        if (left < frame || big_endian32(bytes, at) > left - frame)
            location.fail("IMAGE_UNEXPECTED_EOS", "PNG chunks up to IEND", "an end within a chunk");
        const std::size_t length = big_endian32(bytes, at);
        if (crc32(bytes.subspan(at + 4, length + 4)) != big_endian32(bytes, at + 8 + length))
            location.fail("IMAGE_DATA_INVALID", "PNG chunks with right checksums",
                          "a wrong checksum at byte " + std::to_string(at + 8 + length));
        if (big_endian32(bytes, at + 4) == iend) return;
        at += frame + length;
    }
}

ImageHeader png_header(Bytes bytes, const FileLocation& location) {
    // A PNG begins with the signature of 8 bytes and the chunk IHDR, PNG 11.2.2.
    constexpr std::size_t ihdr = 8, end = 33;  // length, "IHDR", 13 bytes, checksum
    if (bytes.size() < end)
        location.fail("IMAGE_UNEXPECTED_EOS", "a PNG header", std::to_string(bytes.size()) + " bytes");
    if (big_endian32(bytes, ihdr) != 13 || big_endian32(bytes, ihdr + 4) != 0x49484452)
        location.fail("IMAGE_DATA_INVALID", "an IHDR chunk of 13 bytes first", "another chunk");
    const ImageHeader header{ImageKind::png, big_endian32(bytes, ihdr + 8), big_endian32(bytes, ihdr + 12)};
    const std::uint64_t bits = byte_at(bytes, ihdr + 16);  // at least one channel of that many bits per texel
    // The size of the unpacked rows, counted as one channel: a lower bound if the file has several channels.
    const std::uint64_t raw = (std::uint64_t{header.width} * bits + 7) / 8 * header.height;
    check_size(header, raw / deflate_ratio, bytes.size(), location);
    check_png_chunks(bytes, location);
    return header;
}

bool is_frame(std::uint32_t marker) {  // SOF0 to SOF15 except DHT, JPG, DAC
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// The next marker at or after `at`, which is moved past it; 0 at the end. Stuffed zeros and restart markers are data.
std::uint32_t next_marker(Bytes bytes, std::size_t& at) {
    while (at + 1 < bytes.size()) {
        const std::uint32_t code = byte_at(bytes, at + 1);
        const bool is_marker =
            byte_at(bytes, at) == 0xff && code != 0x00 && code != 0xff && !(code >= 0xd0 && code <= 0xd7);
        ++at;
        if (!is_marker) continue;
        ++at;
        return code;
    }
    return 0;
}

// Iterates over all marker segments: the frame gives the size, and the scans are counted, because a small progressive
// file can require any number of passes over the image.
ImageHeader jpeg_header(Bytes bytes, const FileLocation& location) {
    ImageHeader header{ImageKind::jpeg, 0, 0};
    constexpr std::uint32_t scan = 0xda, end_of_image = 0xd9;
    int scans = 0;
    std::size_t at = 2;
    for (std::uint32_t marker = next_marker(bytes, at); marker != end_of_image; marker = next_marker(bytes, at)) {
        if (marker == 0 || at + 8 > bytes.size())
            location.fail("IMAGE_UNEXPECTED_EOS", "an end-of-image marker", "none");
        if (is_frame(marker)) {
            if (header.width != 0) location.fail("IMAGE_DATA_INVALID", "one frame header (SOF)", "a second one");
            header = {ImageKind::jpeg, big_endian16(bytes, at + 5), big_endian16(bytes, at + 3)};
            // A block of 64 samples takes at least a bit, so a byte holds at most 512 samples.
            check_size(header, std::uint64_t{header.width} * header.height / 512, bytes.size(), location);
            const std::uint32_t channels = byte_at(bytes, at + 7);
            if (channels != 1 && channels != 3)
                location.fail("IMAGE_DATA_INVALID", "a JPEG of 1 or 3 channels", std::to_string(channels));
        }
        if (marker == scan && ++scans > max_jpeg_scans)
            location.fail("IMAGE_DATA_INVALID", "at most " + std::to_string(max_jpeg_scans) + " scans", "more scans");
        // TEM, 0x01, has no length; every other marker here has a 16-bit length that includes itself.
        if (marker != 0x01) at += big_endian16(bytes, at);
    }
    if (header.width == 0 || scans == 0)
        location.fail("IMAGE_DATA_INVALID", "a frame header (SOF) and a scan (SOS)", "no such marker");
    return header;
}

}  // namespace

// PNG 11.3.5.3 of the extensions: x and y, signed, and a unit, 0 for pixels. Chunks are whole.
void check_png_place(Bytes bytes, const FileLocation& location) {
    constexpr std::uint32_t offsets = 0x6f464673, data = 0x49444154;
    for (std::size_t at = png_signature.size(); at + 12 <= bytes.size(); at += 12 + big_endian32(bytes, at)) {
        const std::uint32_t kind = big_endian32(bytes, at + 4);
        if (kind == data) return;
        if (kind != offsets || big_endian32(bytes, at) != 9 || byte_at(bytes, at + 16) != 0) continue;
        const auto x = static_cast<std::int32_t>(big_endian32(bytes, at + 8)),
                   y = static_cast<std::int32_t>(big_endian32(bytes, at + 12));
        if (x != 0 || y != 0)
            throw InputError(location.file, "place", "a picture at 0,0 of its page",
                             std::to_string(x) + "," + std::to_string(y) +
                                 " (chunk oFFs: it was cropped; magick IN.png +repage OUT.png drops the place)");
    }
}

// BITMAPFILEHEADER has the offset of the pixels at byte 10. A header of 40 bytes or more follows, or
// BITMAPCOREHEADER of 12.
void check_bmp_pixels(Bytes bytes, const FileLocation& location) {
    const auto word16 = [&](std::size_t at) { return byte_at(bytes, at) | byte_at(bytes, at + 1) << 8; };
    const auto word32 = [&](std::size_t at) { return std::uint64_t{word16(at)} | std::uint64_t{word16(at + 2)} << 16; };
    constexpr std::size_t of_core_header = 26, of_info_header = 54;
    if (bytes.size() < of_core_header)
        location.fail("IMAGE_UNEXPECTED_EOS", "a BMP header", std::to_string(bytes.size()) + " bytes");
    const bool is_core = word32(14) == 12;
    std::uint64_t end = word32(10) + 1;
    if (is_core || bytes.size() >= of_info_header) {
        const std::uint64_t width = is_core ? word16(18) : word32(18), rows = is_core ? word16(20) : word32(22);
        const std::uint64_t bits = word16(is_core ? 24 : 28), compression = is_core ? 0 : word32(30);
        const std::uint64_t height = rows >> 31 == 0 ? rows : (std::uint64_t{1} << 32) - rows;  // negative: top down
        constexpr std::uint64_t none = 0, bit_fields = 3;
        // Rows end at a multiple of 4 bytes. Factors below 2^32, 2^16 and 2^32: the product is checked by division.
        const std::uint64_t row = (width * bits + 31) / 32 * 4;
        if ((compression == none || compression == bit_fields) && (height == 0 || row <= bytes.size() / height))
            end = word32(10) + row * height;
        else if (compression == none || compression == bit_fields)
            end = std::uint64_t{bytes.size()} + 1;
    }
    if (end > bytes.size())
        location.fail("IMAGE_UNEXPECTED_EOS",
                      "a BMP whose pixels end within the file's " + std::to_string(bytes.size()) + " bytes",
                      "pixels that begin at byte " + std::to_string(word32(10)));
}

ImageHeader read_image_header(Bytes bytes, const FileLocation& location) {
    if (is_png(bytes)) return png_header(bytes, location);
    if (is_jpeg(bytes)) return jpeg_header(bytes, location);
    location.fail("IMAGE_UNRECOGNIZED_FORMAT", "a PNG or JPEG image", "another format");
}

}  // namespace strata::scenes
