// tools/oracle/contact_sheet.h - all targets after all passes on one page: a row a pass, a column a target.
//
// Rule     Colours are shown as they are, min-max depths with the near one red and the far one green. Depths, stencils
//          and single channels are stretched from their least to their greatest value on that picture, depths with the
//          near end bright. A target that the pass has written has a light frame. Large targets are thinned to a whole
//          fraction of their size.
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/passes.h"

namespace strata::oracle {

class ContactSheet {
  public:
    void add(const PassShown& pass);
    // A row of its own; those named in `framed` have a light frame.
    void add(const std::string& caption, const std::vector<NamedImage>& targets,
             const std::vector<std::string>& framed);
    [[nodiscard]] pipeline::Image image() const;  // rgba8

  private:
    struct Cell {
        std::string target;
        pipeline::Image picture;
        bool is_written = false;
    };
    struct Row {
        std::string caption;
        std::vector<Cell> cells;
    };
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
    int width_ = 0, height_ = 0;  // of a thumbnail
};

}  // namespace strata::oracle
