// tools/oracle/passes/contact_sheet.h - all targets after all passes in one image: one row per pass, one column per
// target.
//
// Rule     Colours are shown unchanged, min-max depths with the near one in red and the far one in green. Depths,
//          stencils and single channels are scaled to the range of values in that image, depths with near bright. A
//          target that the pass has written has a light frame. Large targets are subsampled by a whole factor.
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/passes/passes.h"

namespace strata::oracle {

class ContactSheet {
  public:
    void add(const PassReport& pass);
    // Adds a row; the targets in `framed` have a light frame.
    void add(const std::string& caption, const std::vector<NamedImage>& targets,
             const std::vector<std::string>& framed);
    [[nodiscard]] pipeline::Image image() const;  // rgba8

  private:
    struct Thumbnail {
        std::string target;
        pipeline::Image picture;
        bool is_written = false;
    };
    struct Row {
        std::string caption;
        std::vector<Thumbnail> cells;
    };
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
    int width_ = 0, height_ = 0;  // of one thumbnail
};

}  // namespace strata::oracle
