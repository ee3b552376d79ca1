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

[[nodiscard]] std::string write_png(const ByteSink& sink, const StraightPicture& picture);
[[nodiscard]] std::vector<std::uint8_t> decode(const EncodedPicture& picture, const Place& place);
[[nodiscard]] StoredCodes decode_codes(const EncodedPicture& picture, const Place& place);

}  // namespace strata::scenes::images
