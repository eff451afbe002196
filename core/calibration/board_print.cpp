#include "core/calibration/board_print.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/io/pdf_page.h"
#include "core/objects/marker_cells.h"

namespace foresight {
namespace {

constexpr double kMargin_mm = 14.0;  ///< for the ruler and the text beside the board
constexpr double kRuler_mm = 100.0;

bool ReadNumber(std::string_view text, double& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size();
}

void DrawMarker(PdfPage& page, const CalibrationBoard& board, int marker, double x, double y,
                double side) {
  int cells = 0;
  const std::vector<bool> white = MarkerCells(board.dictionary, marker, &cells);
  const double cell = side / cells;
  page.SetColor(PdfPage::kBlack);
  page.Fill(x, y, side, side);
  page.SetColor(PdfPage::kWhite);
  // White cells of a row that touch are one rectangle: no hairlines between them on screens.
  for (int row = 0; row < cells; ++row)
    for (int begin = 0; begin < cells; ++begin) {
      int end = begin;
      while (end < cells && white[static_cast<std::size_t>(row * cells + end)]) ++end;
      if (end > begin) page.Fill(x + begin * cell, y + row * cell, (end - begin) * cell, cell);
      begin = end;
    }
}

void DrawBoard(PdfPage& page, const CalibrationBoard& board, double x, double y) {
  const double square = 1000.0 * board.square_m;
  for (int row = 0; row <= board.rows; ++row)
    for (int column = 0; column <= board.columns; ++column) {
      const double left = x + column * square, top = y + row * square;
      if (CalibrationBoard::IsBlack(column, row)) {
        page.SetColor(PdfPage::kBlack);
        page.Fill(left, top, square, square);
      } else if (const int marker = board.MarkerAt(column, row); marker >= 0) {
        const double side = square * board.marker_per_square;
        const double inset = 0.5 * (square - side);
        DrawMarker(page, board, marker, left + inset, top + inset, side);
      }
    }
}

/// Millimetre marks, longer at 5 and 10; along x, or upwards.
void DrawRuler(PdfPage& page, double x, double y, bool upwards) {
  page.SetColor(PdfPage::kBlack);
  for (int mm = 0; mm <= static_cast<int>(kRuler_mm); ++mm) {
    const double length = mm % 10 == 0 ? 4.0 : mm % 5 == 0 ? 3.0 : 1.8;
    if (upwards)
      page.Line(x, y - mm, x + length, y - mm);
    else
      page.Line(x + mm, y, x + mm, y - length);
  }
  const std::string text = fmt::format("{:.0f} mm: measure this", kRuler_mm);
  upwards ? page.Upwards(x + 7.0, y, 2.6, text) : page.Text(x, y - 5.0, 2.6, text);
}

/// Numbers as people read them: 50, 37.5.
std::string Short(double value) {
  return fmt::format("{:.5g}", value);
}

std::string DescribeBoard(const CalibrationBoard& board) {
  std::string text = fmt::format("{} x {} inner corners, squares of {} mm", board.columns,
                                 board.rows, Short(1000.0 * board.square_m));
  if (board.kind == CalibrationBoard::Kind::kCharuco)
    text += fmt::format(", markers of {} mm ({})",
                        Short(1000.0 * board.square_m * board.marker_per_square),
                        ToString(board.dictionary));
  return text;
}

}  // namespace

Result<Paper> PaperFromText(const std::string& text, const CalibrationBoard& board) {
  if (text == "fit") {
    Paper paper{"fit", 0.0, 0.0};
    paper.width_mm = 1000.0 * board.Width() + 2.0 * kMargin_mm;
    paper.height_mm = 1000.0 * board.Height() + 2.0 * kMargin_mm;
    // The ruler and the text need room too.
    paper.width_mm = std::max(paper.width_mm, kRuler_mm + 2.0 * kMargin_mm);
    paper.height_mm = std::max(paper.height_mm, kRuler_mm + 2.0 * kMargin_mm);
    return paper;
  }
  const std::vector<Paper> papers = {{"A4", 297.0, 210.0},
                                     {"A3", 420.0, 297.0},
                                     {"A2", 594.0, 420.0},
                                     {"A1", 841.0, 594.0},
                                     {"A0", 1189.0, 841.0}};
  for (const Paper& paper : papers)
    if (paper.name == text) return paper;
  Paper paper{text, 0.0, 0.0};
  const std::size_t x = text.find('x');
  if (x == std::string::npos || !ReadNumber(std::string_view(text).substr(0, x), paper.width_mm) ||
      !ReadNumber(std::string_view(text).substr(x + 1), paper.height_mm) ||
      !(paper.width_mm >= 50.0 && paper.width_mm <= 5000.0) ||
      !(paper.height_mm >= 50.0 && paper.height_mm <= 5000.0))
    return Fail(ErrorCode::kInvalidOptions,
                "paper '{}' is not A4, A3, A2, A1, A0, fit, or WIDTHxHEIGHT of 50 to 5000 mm",
                text);
  return paper;
}

Result<std::string> BoardPdf(const CalibrationBoard& board, const Paper& paper) {
  FORESIGHT_CHECK(board.Check());
  const double width = 1000.0 * board.Width(), height = 1000.0 * board.Height();
  if (width + 2.0 * kMargin_mm > paper.width_mm + 1e-6 ||
      height + 2.0 * kMargin_mm > paper.height_mm + 1e-6)
    return Fail(ErrorCode::kInvalidOptions,
                "board {}: {} x {} mm and {} mm all round do not fit on {} ({} x {} mm); take a "
                "larger paper, 'fit', or smaller squares",
                ToText(board), Short(width), Short(height), Short(kMargin_mm), paper.name,
                Short(paper.width_mm), Short(paper.height_mm));
  PdfPage page(paper.width_mm, paper.height_mm);
  const double left = 0.5 * (paper.width_mm - width), top = 0.5 * (paper.height_mm - height);
  DrawBoard(page, board, left, top);
  DrawRuler(page, kMargin_mm, kMargin_mm - 4.0, false);
  DrawRuler(page, 2.0, paper.height_mm - kMargin_mm, true);
  page.SetColor(PdfPage::kGrey);
  page.Text(kMargin_mm, paper.height_mm - 7.0, 3.2, DescribeBoard(board));
  page.Text(
      kMargin_mm, paper.height_mm - 3.0, 2.6,
      fmt::format("--board {}    print at 100 %, matt, on something flat; if the ruler is not "
                  "{:.0f} mm long, measure a row of squares and give that size",
                  ToText(board), kRuler_mm));
  return std::move(page).Bytes();
}

Result<std::string> TwoBoardMountPdf(const CalibrationBoard& board) {
  FORESIGHT_CHECK(board.Check());
  PdfPage page(297.0, 210.0);
  page.SetColor(PdfPage::kBlack);
  page.Text(20.0, 22.0, 6.0, "Two boards at a right angle");
  page.Text(20.0, 30.0, 3.4, "For camera, motor and lidar together (Section III-B). Not to scale.");
  const double width = 1000.0 * board.Width(), height = 1000.0 * board.Height();
  // Two parallelograms that meet in the hinge, as seen from in front and above.
  const Eigen::Vector2d hinge_top(105.0, 50.0), hinge_bottom(105.0, 140.0);
  const Eigen::Vector2d aside(72.0, 22.0);
  const Eigen::Vector2d other(-72.0, 22.0);
  page.Shape({hinge_top, hinge_bottom, hinge_bottom + aside, hinge_top + aside}, false);
  page.Shape({hinge_top, hinge_bottom, hinge_bottom + other, hinge_top + other}, false);
  for (const Eigen::Vector2d& side : {aside, other})
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 7; ++column) {
        if (!CalibrationBoard::IsBlack(column, row)) continue;
        const auto at = [&](double c, double r) -> Eigen::Vector2d {
          const double along = 0.12 + 0.76 * c / 7.0, down = 0.1 + 0.8 * r / 6.0;
          return hinge_top + along * side + down * (hinge_bottom - hinge_top);
        };
        page.Shape(
            {at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)},
            true);
      }
  page.Text(104.0, 46.0, 3.4, "hinge");
  page.Text(36.0, 172.0, 3.4, "board A");
  page.Text(160.0, 172.0, 3.4, "board B");
  const std::vector<std::string> lines = {
      fmt::format("Each board: {}", DescribeBoard(board)),
      fmt::format("Printed squares: {} x {} mm; plate at least {} x {} mm.", Short(width),
                  Short(height), Short(width + 40.0), Short(height + 40.0)),
      "White margin: 20 mm all round, also beside the hinge.",
      "Angle: 90 deg within 2 deg; it is estimated, but must not move.",
      "Flat: within 0.5 mm; the bend is estimated and reported.",
      "Matt face; glued over the whole area, no folds.",
      "Hold it at hinge rolls of 0, 90 and +-45 deg and tilts of",
      "+-20 deg, 0.8 to 1.5 m away, in six poses at least.",
      "Never with the hinge parallel to the motor's axis only."};
  double y = 60.0;
  for (const std::string& line : lines) {
    page.Text(188.0, y, 3.0, line);
    y += 7.0;
  }
  page.SetColor(PdfPage::kGrey);
  page.Text(20.0, 200.0, 2.6, fmt::format("--board {}", ToText(board)));
  return std::move(page).Bytes();
}

}  // namespace foresight
