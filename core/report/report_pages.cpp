#include "core/report/report_pages.h"

#include <algorithm>

#include "core/base/printable.h"
#include "core/base/shrink_image.h"
#include "core/io/pdf_page.h"
#include "core/io/png.h"
#include "core/report/text_lines.h"

namespace foresight {
namespace {

constexpr double kPageWidth_mm = 210.0, kPageHeight_mm = 297.0;  // A4
constexpr double kPageMargin_mm = 15.0, kTop_mm = 18.0, kBottom_mm = kPageHeight_mm - 16.0;
constexpr double kInner_mm = kPageWidth_mm - 2.0 * kPageMargin_mm;
constexpr double kPageText_mm = 2.9, kLine_mm = 4.0, kPad_mm = 1.2;
constexpr PdfPage::Color kPagePale = {0.82, 0.84, 0.87};
constexpr PdfPage::Color kHead = {0.92, 0.93, 0.95};
constexpr int kPictureSide_px = 900;  ///< 10 pixels a millimetre in half a page

class Pages {
 public:
  Pages(const std::string& title, std::filesystem::path folder)
      : title_(Printable(title)),
        folder_(std::move(folder)),
        page_(kPageWidth_mm, kPageHeight_mm) {}

  void Title(const std::string& summary) {
    page_.BoldText(kPageMargin_mm, top_ + 3.0, 6.0, Cut(page_, title_, 6.0, kInner_mm));
    top_ += 10.0;
    Paragraph(summary);
  }

  void Heading(const std::string& text, double size_mm) {
    Need(size_mm + 4.0 + 3.0 * kLine_mm);  // never alone at the foot of a page
    top_ += size_mm + 3.0;
    page_.SetColor(PdfPage::kBlack);
    page_.BoldText(kPageMargin_mm, top_, size_mm, Cut(page_, Printable(text), size_mm, kInner_mm));
    top_ += 2.4;
  }

  void Paragraph(const std::string& text) {
    if (text.empty()) return;
    page_.SetColor(PdfPage::kBlack);
    for (const std::string& line : Wrapped(page_, Printable(text), kPageText_mm, kInner_mm)) {
      Need(kLine_mm);
      top_ += kLine_mm;
      page_.Text(kPageMargin_mm, top_, kPageText_mm, line);
    }
    top_ += 1.5;
  }

  void Table(const HtmlReport::Table& table) {
    Heading(table.title, 3.4);
    std::size_t columns = table.header.size();
    for (const auto& row : table.rows) columns = std::max(columns, 2 + row.more.size());
    widths_ = WidthsOf(table, columns);
    if (!table.header.empty()) Row(table.header, true);
    for (const auto& row : table.rows) {
      std::vector<std::string> cells = {row.name, row.value};
      cells.insert(cells.end(), row.more.begin(), row.more.end());
      Row(cells, false);
    }
    top_ += 2.0;
  }

  Status Pictures(const std::vector<HtmlReport::Picture>& pictures, const RunContext& context) {
    constexpr double kGap_mm = 5.0, kHalf_mm = 0.5 * (kInner_mm - kGap_mm);
    for (std::size_t i = 0; i < pictures.size(); i += 2) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "the report was cancelled");
      const std::size_t end = std::min(i + 2, pictures.size());
      std::vector<ColorImage> images;
      std::vector<std::vector<std::string>> captions;
      double height = 0.0;
      for (std::size_t k = i; k < end; ++k) {
        FORESIGHT_TRY(ColorImage image, ImageOf(pictures[k]));
        captions.push_back(Wrapped(page_, Printable(pictures[k].caption), 2.5, kHalf_mm));
        height = std::max(height, HeightOf(image, kHalf_mm) + 4.5 +
                                      3.4 * static_cast<double>(captions.back().size()));
        images.push_back(std::move(image));
      }
      Need(height + 3.0);
      top_ += 2.0;
      for (std::size_t k = i; k < end; ++k) {
        const double left = kPageMargin_mm + static_cast<double>(k - i) * (kHalf_mm + kGap_mm);
        const double image_height = HeightOf(images[k - i], kHalf_mm);
        page_.Picture(left, top_, kHalf_mm, image_height, images[k - i]);
        page_.SetColor(PdfPage::kBlack);
        double y = top_ + image_height + 3.6;
        page_.BoldText(left, y, 2.7, Cut(page_, pictures[k].title, 2.7, kHalf_mm));
        page_.SetColor(PdfPage::kGrey);
        for (const std::string& line : captions[k - i]) page_.Text(left, y += 3.4, 2.5, line);
      }
      top_ += height + 1.0;
    }
    return {};
  }

  void Break() { NextPage(); }

  Result<std::string> Finish() && {
    Footer();
    return std::move(page_).Bytes();
  }

 private:
  static double HeightOf(const ColorImage& image, double width_mm) {
    return image.width() > 0 ? width_mm * image.height() / image.width() : 0.0;
  }

  Result<ColorImage> ImageOf(const HtmlReport::Picture& picture) const {
    ColorImage image = picture.image;
    if (image.empty()) {
      FORESIGHT_TRY(image, ReadPng(folder_ / picture.file));
    }
    return ShrinkImage(image, kPictureSide_px);
  }

  void Footer() {
    page_.SetColor(PdfPage::kGrey);
    page_.Text(kPageMargin_mm, kPageHeight_mm - 8.0, 2.4, Cut(page_, title_, 2.4, 0.8 * kInner_mm));
    const std::string number = fmt::format("{}", number_);
    page_.Text(kPageWidth_mm - kPageMargin_mm - page_.TextWidth(2.4, number), kPageHeight_mm - 8.0,
               2.4, number);
  }

  void NextPage() {
    Footer();
    page_.NextPage();
    ++number_;
    top_ = kTop_mm;
  }

  void Need(double height) {
    if (top_ + height > kBottom_mm && top_ > kTop_mm) NextPage();
  }

  /// Each column as wide as it needs; where that is too much the widest give way.
  std::vector<double> WidthsOf(const HtmlReport::Table& table, std::size_t columns) {
    std::vector<double> widths(columns, 8.0);
    const auto widen = [&](std::size_t column, const std::string& text) {
      if (column < columns)
        widths[column] = std::max(
            widths[column], page_.TextWidth(kPageText_mm, Printable(text)) * 1.06 + 2.0 * kPad_mm);
    };
    for (std::size_t i = 0; i < table.header.size(); ++i) widen(i, table.header[i]);
    for (const auto& row : table.rows) {
      widen(0, row.name);
      widen(1, row.value);
      for (std::size_t i = 0; i < row.more.size(); ++i) widen(2 + i, row.more[i]);
    }
    const auto sum = [&] {
      double all = 0.0;
      for (const double width : widths) all += width;
      return all;
    };
    while (sum() > kInner_mm + 0.01) {
      const auto widest = std::max_element(widths.begin(), widths.end());
      *widest = std::max(12.0, *widest - std::max(1.0, 0.2 * (sum() - kInner_mm)));
      if (*widest <= 12.0) break;
    }
    return widths;
  }

  void Row(const std::vector<std::string>& cells, bool head) {
    std::vector<std::vector<std::string>> lines;
    std::size_t most = 1;
    for (std::size_t i = 0; i < cells.size() && i < widths_.size(); ++i) {
      lines.push_back(Broken(cells[i], widths_[i] - 2.0 * kPad_mm));
      most = std::max(most, lines.back().size());
    }
    const double height = kLine_mm * static_cast<double>(most) + 1.2;
    Need(height);
    double left = kPageMargin_mm;
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      if (head) {
        page_.SetColor(kHead);
        page_.Fill(left, top_, widths_[i], height);
      }
      page_.SetColor(kPagePale);
      page_.Frame(left, top_, widths_[i], height);
      page_.SetColor(i == 0 && !head ? PdfPage::kGrey : PdfPage::kBlack);
      if (i < lines.size())
        for (std::size_t k = 0; k < lines[i].size(); ++k) {
          const double y = top_ + kLine_mm * static_cast<double>(k + 1) - 0.7;
          head ? page_.BoldText(left + kPad_mm, y, kPageText_mm, lines[i][k])
               : page_.Text(left + kPad_mm, y, kPageText_mm, lines[i][k]);
        }
      left += widths_[i];
    }
    top_ += height;
  }

  /// Wrapped between words; a word that is wider than the column is broken within.
  std::vector<std::string> Broken(const std::string& text, double width_mm) {
    std::vector<std::string> lines;
    for (std::string line : Wrapped(page_, Printable(text), kPageText_mm, width_mm)) {
      while (page_.TextWidth(kPageText_mm, line) > width_mm && line.size() > 1) {
        std::size_t fits = line.size();
        const auto begins_letter = [&](std::size_t i) {
          return (static_cast<unsigned char>(line[i]) & 0xC0) != 0x80;
        };
        while (fits > 1 && (page_.TextWidth(kPageText_mm, line.substr(0, fits)) > width_mm)) {
          --fits;
          while (fits > 1 && !begins_letter(fits)) --fits;
        }
        lines.push_back(line.substr(0, fits));
        line = line.substr(fits);
      }
      lines.push_back(line);
    }
    return lines;
  }

  std::string title_;
  std::filesystem::path folder_;
  PdfPage page_;
  std::vector<double> widths_;
  double top_ = kTop_mm;
  int number_ = 1;
};

}  // namespace

Result<std::string> PagesOf(const HtmlReport& report, const std::filesystem::path& folder,
                            const RunContext& context) {
  Pages pages(report.title, folder);
  pages.Title(report.summary);
  for (const auto& table : report.tables) pages.Table(table);
  FORESIGHT_CHECK(pages.Pictures(report.pictures, context));
  const double all = std::max<double>(1.0, static_cast<double>(report.sections.size()));
  double done = 0.0;
  for (const auto& section : report.sections) {
    context.Report(done++ / all, "writing the PDF");
    if (done > 1.0 && !section.pictures.empty()) pages.Break();
    pages.Heading(section.title, 4.6);
    pages.Paragraph(section.text);
    FORESIGHT_CHECK(pages.Pictures(section.pictures, context));
    for (const auto& table : section.tables) pages.Table(table);
  }
  return std::move(pages).Finish();
}

}  // namespace foresight
