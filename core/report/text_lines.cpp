#include "core/report/text_lines.h"

#include <algorithm>

namespace foresight {

std::string Cut(PdfPage& page, const std::string& text, double size_mm, double width_mm) {
  if (page.TextWidth(size_mm, text) <= width_mm) return text;
  std::string cut = text;
  while (!cut.empty() && page.TextWidth(size_mm, cut + "...") > width_mm) {
    // Bytes behind the first of a letter of UTF-8 go with it.
    while (cut.size() > 1 && (static_cast<unsigned char>(cut.back()) & 0xC0) == 0x80)
      cut.pop_back();
    cut.pop_back();
  }
  return cut + "...";
}

std::vector<std::string> Wrapped(PdfPage& page, const std::string& text, double size_mm,
                                 double width_mm) {
  std::vector<std::string> lines = {""};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (page.TextWidth(size_mm, longer) <= width_mm || lines.back().empty())
      lines.back() = longer;
    else
      lines.push_back(word);
    begin = end + 1;
  }
  return lines;
}

}  // namespace foresight
