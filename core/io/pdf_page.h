#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/base/image.h"
#include "core/base/result.h"

namespace foresight {

/// A PDF, drawn on page after page in millimetres from a page's upper left corner. The same drawing
/// gives the same bytes: its date is a fixed one.
class PdfPage {
 public:
  struct Color {
    double red = 0.0, green = 0.0, blue = 0.0;
  };
  static constexpr Color kBlack = {0.0, 0.0, 0.0};
  static constexpr Color kWhite = {1.0, 1.0, 1.0};
  static constexpr Color kGrey = {0.45, 0.45, 0.45};

  PdfPage(double width_mm, double height_mm);
  ~PdfPage();
  PdfPage(const PdfPage&) = delete;
  PdfPage& operator=(const PdfPage&) = delete;

  /// Of all that is drawn from here on; black at first.
  void SetColor(const Color& color);
  /// Lines are 0.2 mm wide at first.
  void SetLineWidth(double width_mm);
  void Fill(double x, double y, double width, double height);
  void Frame(double x, double y, double width, double height);
  void Line(double x0, double y0, double x1, double y1);
  void Dot(double x, double y, double radius);
  void Shape(const std::vector<Eigen::Vector2d>& points, bool filled);
  void Polyline(const std::vector<Eigen::Vector2d>& points);

  /// Fills the rectangle; the file keeps the image in its full size, as a JPEG of quality 90.
  void Picture(double x, double y, double width, double height, const ColorImage& image);

  /// What is drawn from here on is on a page of its own.
  void NextPage();

  /// From its baseline's left end.
  void Text(double x, double y, double size_mm, const std::string& text);
  void BoldText(double x, double y, double size_mm, const std::string& text);
  void Upwards(double x, double y, double size_mm, const std::string& text);
  double TextWidth(double size_mm, const std::string& text);

  /// The whole file. Fails with kIo where the drawing failed.
  Result<std::string> Bytes() &&;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace foresight
