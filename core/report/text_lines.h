#pragma once

#include <string>
#include <vector>

#include "core/io/pdf_page.h"

namespace foresight {

/// The text, cut to `width_mm` with "..." at its end.
std::string Cut(PdfPage& page, const std::string& text, double size_mm, double width_mm);

/// Lines of at most `width_mm`, broken between words; a single word may be longer.
std::vector<std::string> Wrapped(PdfPage& page, const std::string& text, double size_mm,
                                 double width_mm);

}  // namespace foresight
