// scenes/images/image_module.cpp - the one symbol that the module exports.
#include "scenes/images/image_module.h"

#include "scenes/images/openimageio.h"

extern "C" __attribute__((visibility("default"))) const strata::scenes::ImageModule* strata_image_module() {
    using namespace strata::scenes;
    // The library is built with hidden symbols: this function is its whole interface. The first use of OpenImageIO
    // makes a list of its formats and starts threads; it is made here, before the program's own loops start threads.
    static const auto started = OIIO::ImageInput::create("png");
    static const ImageModule module{
        .version = STRATA_VERSION, .decode = images::decode, .decode_codes = images::decode_codes};
    return &module;
}
