// scenes/images/openimageio.h - the module's own functions, and what they have in common.
#pragma once
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "scenes/images/image_module.h"

namespace strata::scenes::images {

// Lets OpenImageIO write into a ByteSink.
class SinkProxy : public OIIO::Filesystem::IOProxy {
  public:
    explicit SinkProxy(const ByteSink& sink) : IOProxy{sink.path, Write}, sink_{sink} {}
    [[nodiscard]] const char* proxytype() const override { return "strata"; }
    // The owner of the sink closes the file; the library only stops to use it.
    void close() override { m_mode = Closed; }
    int64_t tell() override { return sink_.position(); }
    bool seek(int64_t offset) override { return sink_.seek(offset); }
    size_t write(const void* bytes, size_t size) override { return sink_.write(bytes, size); }

  private:
    const ByteSink& sink_;
};

// Size and attributes, and what keeps OpenImageIO from adding any of its own. Channels are the caller's.
[[nodiscard]] OIIO::ImageSpec base_spec(int width, int height, const std::map<std::string, std::string>& attributes);

// The name that OpenImageIO reads a colour space from is one that its version 2.4 does not write. So a name of the same
// length is written, and finish_headers() puts the right one in its place in every header of the file. It answers whether
// the file could be written and holds the places of all its chunks.
inline constexpr std::string_view color_space_name = "oiio:ColorSpace", color_space_stand_in = "oiio.ColorSpace";
static_assert(color_space_name.size() == color_space_stand_in.size());
[[nodiscard]] bool finish_headers(const std::string& path);

[[nodiscard]] std::string write_png(const ByteSink& sink, const StraightPicture& picture);
[[nodiscard]] std::string write_exr(const ByteSink& sink, const PartSource& part);
[[nodiscard]] std::string write_exr_parts(const std::string& path, std::span<const PartSource> parts);
void read_exr(const std::string& path, const std::function<void(StoredPart&&)>& take);
[[nodiscard]] std::vector<std::uint8_t> decode(const EncodedPicture& picture, const Place& place);
[[nodiscard]] StoredCodes decode_codes(const EncodedPicture& picture, const Place& place);

}  // namespace strata::scenes::images
