// scenes/images/png_write.cpp - straight 8-bit colours as a PNG, byte for byte.
#include "scenes/images/openimageio.h"

namespace strata::scenes::images {

OIIO::ImageSpec base_spec(int width, int height, const std::map<std::string, std::string>& attributes) {
    OIIO::ImageSpec spec{width, height, 0, OIIO::TypeDesc::FLOAT};
    spec.attribute("Software", "strata");
    for (const auto& [name, value] : attributes) spec.attribute(name, value);
    return spec;
}

std::string write_png(const ByteSink& sink, const StraightPicture& picture) {
    OIIO::ImageSpec spec = base_spec(picture.width, picture.height, picture.attributes);
    spec.nchannels = 4;
    spec.default_channel_names();
    spec.set_format(OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);  // else colours are divided by alpha on the way out
    const auto output = OIIO::ImageOutput::create("png");
    if (output == nullptr) return "OpenImageIO has no writer of PNG";
    SinkProxy proxy{sink};
    output->set_ioproxy(&proxy);
    const bool done = output->open(sink.path, spec) &&
                      output->write_image(OIIO::TypeDesc::UINT8, picture.rgba.data()) && output->close();
    return done ? "" : output->geterror();
}

}  // namespace strata::scenes::images
