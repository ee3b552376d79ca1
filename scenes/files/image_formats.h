// scenes/files/image_formats.h - the readers and writers behind image_io, and their common ground with OpenImageIO.
#pragma once
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"

namespace strata::scenes {

// Lets OpenImageIO write into an AtomicFile.
class FileProxy : public OIIO::Filesystem::IOProxy {
  public:
    FileProxy(const std::string& path, AtomicFile& file) : IOProxy{path, Write}, file_{file} {}
    [[nodiscard]] const char* proxytype() const override { return "strata"; }
    void close() override { m_mode = Closed; }
    int64_t tell() override { return file_.position(); }
    bool seek(int64_t offset) override { return file_.seek(offset); }
    size_t write(const void* bytes, size_t size) override { return file_.write(bytes, size); }

  private:
    AtomicFile& file_;
};

// The value of a colour code: k / 255, or the half's or the float's own, whose NaN payload may be lost.
[[nodiscard]] float channel_value(pipeline::ChannelType type, std::uint32_t code) noexcept;

// Writes one file: `body` opens the output, writes and closes; false from it means that OpenImageIO has an error to
// tell.
using Body = std::function<bool(OIIO::ImageOutput& output, const std::string& name)>;
void write_with(const char* format, const std::string& path, const Body& body);

// The same for EXR files of several parts and deep ones, which OpenImageIO 2.4 writes by name, past any proxy.
void write_exr_by_name(const std::string& path, const Body& body);

// An open EXR file, the size of each part checked; InputError if there is none.
[[nodiscard]] std::unique_ptr<OIIO::ImageInput> open_exr(const std::string& path);

// Size, names and attributes, and what keeps OpenImageIO from adding any of its own. Channels are the caller's.
[[nodiscard]] OIIO::ImageSpec base_spec(int width, int height, const Attributes& attributes);

// The attribute "strata:KEY", "" if there is none.
[[nodiscard]] std::string attribute(const OIIO::ImageSpec& spec, const std::string& key);

// The caller's attributes with format, digest and colour space of the targets.
[[nodiscard]] Attributes described(const OutputColor& image);

void write_png(const std::string& path, const OutputColor& image);
void write_exr(const std::string& path, const OutputColor& image);
[[nodiscard]] std::vector<FileImage> read_png(const std::string& path);
[[nodiscard]] std::vector<FileImage> read_exr(const std::string& path);

}  // namespace strata::scenes
