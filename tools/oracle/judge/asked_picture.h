// tools/oracle/judge/asked_picture.h - a picture of a scene on which a verdict is asked, and how to read it.
#pragma once
#include "tools/oracle/picture/picture.h"
#include "tools/oracle/show_progress.h"

namespace strata::peeling {
struct Algorithm;
}

namespace strata::oracle {

struct AskedPicture {
    const TargetImage& colors;
    bool is_form_stated = false;                    // the caller states whether colours are straight or premultiplied
    bool has_alpha = true;                          // false: alpha is not compared
    const peeling::Algorithm* algorithm = nullptr;  // that the port runs; null: not known
    std::string camera = "the given camera";        // in words, for a hint that it may be another
    ShowProgress progress{};
};

}  // namespace strata::oracle
