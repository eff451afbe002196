#include "core/calibration/board_print.h"

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/version.h"
#include "core/objects/marker_cells.h"

namespace foresight {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kMargin_mm = 14.0;  ///< for the ruler and the text beside the board
constexpr double kRuler_mm = 100.0;

struct Closer {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};

/// A page of a PDF, drawn on in millimetres from its upper left corner.
class Page {
 public:
  Page(double width_mm, double height_mm)
      : surface_(cairo_pdf_surface_create_for_stream(Append, &bytes_, width_mm * kPointsPerMm,
                                                     height_mm * kPointsPerMm)) {
    // A fixed date: the same board gives the same bytes.
    cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                   "2026-01-01T00:00:00Z");
    context_.reset(cairo_create(surface_.get()));
    cairo_scale(context_.get(), kPointsPerMm, kPointsPerMm);
    cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_line_width(context_.get(), 0.2);
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  void Black() { cairo_set_source_rgb(context_.get(), 0.0, 0.0, 0.0); }
  void White() { cairo_set_source_rgb(context_.get(), 1.0, 1.0, 1.0); }
  void Grey() { cairo_set_source_rgb(context_.get(), 0.45, 0.45, 0.45); }
  void Fill(double x, double y, double width, double height) {
    cairo_rectangle(context_.get(), x, y, width, height);
    cairo_fill(context_.get());
  }
  void Frame(double x, double y, double width, double height) {
    cairo_rectangle(context_.get(), x, y, width, height);
    cairo_stroke(context_.get());
  }
  void Line(double x0, double y0, double x1, double y1) {
    cairo_move_to(context_.get(), x0, y0);
    cairo_line_to(context_.get(), x1, y1);
    cairo_stroke(context_.get());
  }
  void Shape(const std::vector<Eigen::Vector2d>& points, bool filled) {
    for (const Eigen::Vector2d& p : points) cairo_line_to(context_.get(), p.x(), p.y());
    cairo_close_path(context_.get());
    filled ? cairo_fill(context_.get()) : cairo_stroke(context_.get());
  }
  void Text(double x, double y, double size_mm, const std::string& text) {
    cairo_set_font_size(context_.get(), size_mm);
    cairo_move_to(context_.get(), x, y);
    cairo_show_text(context_.get(), text.c_str());
  }
  void Upwards(double x, double y, double size_mm, const std::string& text) {
    cairo_save(context_.get());
    cairo_translate(context_.get(), x, y);
    cairo_rotate(context_.get(), -0.5 * std::numbers::pi);
    Text(0.0, 0.0, size_mm, text);
    cairo_restore(context_.get());
  }

  Result<std::string> Bytes() && {
    cairo_show_page(context_.get());
    const cairo_status_t status = cairo_status(context_.get());
    context_.reset();
    cairo_surface_finish(surface_.get());
    const cairo_status_t end = cairo_surface_status(surface_.get());
    if (status != CAIRO_STATUS_SUCCESS || end != CAIRO_STATUS_SUCCESS)
      return Fail(ErrorCode::kIo, "PDF: {}",
                  cairo_status_to_string(status != CAIRO_STATUS_SUCCESS ? status : end));
    return std::move(bytes_);
  }

 private:
  static cairo_status_t Append(void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  }

  std::string bytes_;
  std::unique_ptr<cairo_surface_t, Closer> surface_;
  std::unique_ptr<cairo_t, Closer> context_;
};

bool ReadNumber(std::string_view text, double& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size();
}

void DrawMarker(Page& page, const CalibrationBoard& board, int marker, double x, double y,
                double side) {
  int cells = 0;
  const std::vector<bool> white = MarkerCells(board.dictionary, marker, &cells);
  const double cell = side / cells;
  page.Black();
  page.Fill(x, y, side, side);
  page.White();
  // White cells of a row that touch are one rectangle: no hairlines between them on screens.
  for (int row = 0; row < cells; ++row)
    for (int begin = 0; begin < cells; ++begin) {
      int end = begin;
      while (end < cells && white[static_cast<std::size_t>(row * cells + end)]) ++end;
      if (end > begin) page.Fill(x + begin * cell, y + row * cell, (end - begin) * cell, cell);
      begin = end;
    }
}

void DrawBoard(Page& page, const CalibrationBoard& board, double x, double y) {
  const double square = 1000.0 * board.square_m;
  for (int row = 0; row <= board.rows; ++row)
    for (int column = 0; column <= board.columns; ++column) {
      const double left = x + column * square, top = y + row * square;
      if (CalibrationBoard::IsBlack(column, row)) {
        page.Black();
        page.Fill(left, top, square, square);
      } else if (const int marker = board.MarkerAt(column, row); marker >= 0) {
        const double side = square * board.marker_per_square;
        const double inset = 0.5 * (square - side);
        DrawMarker(page, board, marker, left + inset, top + inset, side);
      }
    }
}

/// Millimetre marks, longer at 5 and 10; along x, or upwards.
void DrawRuler(Page& page, double x, double y, bool upwards) {
  page.Black();
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
  Page page(paper.width_mm, paper.height_mm);
  const double left = 0.5 * (paper.width_mm - width), top = 0.5 * (paper.height_mm - height);
  DrawBoard(page, board, left, top);
  DrawRuler(page, kMargin_mm, kMargin_mm - 4.0, false);
  DrawRuler(page, 2.0, paper.height_mm - kMargin_mm, true);
  page.Grey();
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
  Page page(297.0, 210.0);
  page.Black();
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
  page.Grey();
  page.Text(20.0, 200.0, 2.6, fmt::format("--board {}", ToText(board)));
  return std::move(page).Bytes();
}

}  // namespace foresight
