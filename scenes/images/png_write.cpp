// scenes/images/png_write.cpp - straight 8-bit colours as a PNG, byte for byte.
#include "scenes/images/openimageio.h"

namespace strata::scenes::images {

std::string write_png(const ByteSink& sink, const StraightPicture& picture) {
    OIIO::ImageSpec spec{picture.width, picture.height, 4, OIIO::TypeDesc::UINT8};
    spec.attribute("Software", "strata");  // else the library names itself
    for (const auto& [name, value] : picture.attributes) spec.attribute(name, value);
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
