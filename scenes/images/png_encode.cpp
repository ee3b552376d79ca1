// scenes/images/png_encode.cpp - passes rows and texts to libpng (png_encode.h).
#include "scenes/images/png_encode.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace strata::scenes {
namespace {

// The data behind the pointer that libpng passes to callbacks. libpng leaves errors with longjmp, so a function that
// may be jumped over has no object with a destructor, and no exception may pass through libpng.
struct Writing {
    const PngPicture& picture;
    const std::function<bool(const void*, std::size_t)>& put;
    std::vector<std::uint8_t> row;
    std::vector<png_text> texts;
    std::array<char, 128> message{};
    std::exception_ptr thrown;
};

[[noreturn]] void failed(png_structp png, png_const_charp message) {
    auto& message_kept = static_cast<Writing*>(png_get_error_ptr(png))->message;
    const std::string_view text = message;
    std::copy_n(text.data(), std::min(text.size(), message_kept.size() - 1), message_kept.data());
    png_longjmp(png, 1);
}

void warned(png_structp, png_const_charp) {}

// Runs a call that may throw or return false, and reports failure by libpng's error function.
template <class Call>
void guarded(png_structp png, Writing& writing, Call call) {
    bool done = false;
    try {
        done = call();
    } catch (...) {
        writing.thrown = std::current_exception();
    }
    if (!done) png_error(png, "the file cannot be written");
}

void put(png_structp png, png_bytep bytes, std::size_t size) {
    auto& writing = *static_cast<Writing*>(png_get_io_ptr(png));
    guarded(png, writing, [&] { return writing.put(bytes, size); });
}

void flush(png_structp) {}

bool write(png_structp png, png_infop info, Writing& writing) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &writing, put, flush);
    png_set_compression_level(png, 6);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    const PngPicture& picture = writing.picture;
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), 8,
                 picture.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_text(png, info, writing.texts.data(), static_cast<int>(writing.texts.size()));
    png_write_info(png, info);
    for (int y = 0; y < picture.height; ++y) {
        guarded(png, writing, [&] { return picture.row(y, writing.row.data()), true; });
        png_write_row(png, writing.row.data());
    }
    png_write_end(png, nullptr);
    return true;
}

}  // namespace

std::string encode_png(const PngPicture& picture, const std::function<bool(const void*, std::size_t)>& put) {
    Writing writing{.picture = picture, .put = put, .row = {}, .texts = {}, .message = {}, .thrown = {}};
    writing.row.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels));
    for (const auto& [keyword, text] : picture.texts) {
        png_text entry{};
        entry.compression = PNG_TEXT_COMPRESSION_NONE;
        // libpng copies both and changes neither.
        entry.key = const_cast<char*>(keyword.c_str());
        entry.text = const_cast<char*>(text.c_str());
        entry.text_length = text.size();
        writing.texts.push_back(entry);
    }
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writing, failed, warned);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    const bool done = info != nullptr && write(png, info, writing);
    png_destroy_write_struct(&png, &info);
    if (writing.thrown) std::rethrow_exception(writing.thrown);
    if (done) return "";
    return writing.message[0] == '\0' ? "libpng could not begin" : writing.message.data();
}

std::string png_bytes(const pipeline::Image& image) {
    std::string bytes;
    const auto row = [&](int y, std::uint8_t* codes) {
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) *codes++ = static_cast<std::uint8_t>(image.codes[image.index(x, y, c)]);
    };
    const auto append = [&](const void* part, std::size_t size) {
        bytes.append(static_cast<const char*>(part), size);
        return true;
    };
    const PngPicture picture{.width = image.width, .height = image.height, .channels = 3, .row = row};
    if (const std::string failure = encode_png(picture, append); !failure.empty()) throw std::runtime_error(failure);
    return bytes;
}

}  // namespace strata::scenes
