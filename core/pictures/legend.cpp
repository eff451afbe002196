#include "core/pictures/legend.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/pictures/ticks.h"

namespace foresight {
namespace {

constexpr Rgb8 kPaper = {255, 255, 255};
constexpr Rgb8 kFrame = {107, 114, 124};
constexpr int kMargin_px = 12;
constexpr int kTextRow_px = 22;
constexpr int kBar_px = 14;
constexpr int kBarRow_px = kBar_px + 26;  ///< with the tick labels
constexpr int kTickDistance_px = 80;
constexpr int kSwatch_px = 13;
constexpr double kFontScale = 0.5;

int TextWidth(const std::string& text) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, &baseline).width;
}

/// As much of the text as fits.
std::string Shortened(std::string text, int width_px) {
  if (TextWidth(text) <= width_px) return text;
  while (!text.empty() && TextWidth(text + "...") > width_px) text.pop_back();
  return text + "...";
}

/// Draws into the strip under a picture, row by row.
class Strip {
 public:
  Strip(ColorImage& image, int top)
      : image_(image), view_(image.height(), image.width(), CV_8UC3, image.data()), y_(top) {}

  void AddLine(const std::string& text) {
    Write(Shortened(text, Right() - kMargin_px), kMargin_px, y_ + kTextRow_px - 7);
    y_ += kTextRow_px;
  }

  void AddBar(const PictureLegend::Bar& bar) {
    const std::string unit = bar.unit + (bar.open_end ? " or more" : "");
    const int right = Right() - TextWidth(unit) - 10;
    const int width = right - kMargin_px;
    for (int x = 0; x < width; ++x)
      for (int y = 0; y < kBar_px; ++y)
        image_(kMargin_px + x, y_ + y) = ColorOf(bar.map, static_cast<double>(x) / (width - 1));
    Write(unit, right + 10, y_ + kBar_px - 2);
    const Ticks ticks =
        LinearTicks(bar.range.low, bar.range.high, std::max(1, width / kTickDistance_px));
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
      const int x =
          kMargin_px +
          static_cast<int>(std::lround(bar.range.Fraction(ticks.values[i]) * (width - 1)));
      for (int y = kBar_px; y < kBar_px + 4; ++y) image_(x, y_ + y) = kFrame;
      const int half = TextWidth(ticks.labels[i]) / 2;
      Write(ticks.labels[i], std::max(2, x - half), y_ + kBar_px + 18);
    }
    y_ += kBarRow_px;
  }

  void AddSwatches(const std::vector<PictureLegend::Swatch>& swatches) {
    int x = kMargin_px;
    for (const auto& swatch : swatches) {
      if (x + kSwatch_px + 6 + TextWidth(swatch.text) > Right()) break;
      const cv::Rect box(x, y_ + 4, kSwatch_px, kSwatch_px);
      cv::rectangle(view_, box, Scalar(swatch.color), cv::FILLED);
      cv::rectangle(view_, box, Scalar(kFrame));
      Write(swatch.text, x + kSwatch_px + 6, y_ + kTextRow_px - 7);
      x += kSwatch_px + 6 + TextWidth(swatch.text) + 18;
    }
    y_ += kTextRow_px;
  }

 private:
  static cv::Scalar Scalar(Rgb8 color) {
    return {double(color.r), double(color.g), double(color.b)};
  }
  int Right() const { return image_.width() - kMargin_px; }
  void Write(const std::string& text, int x, int baseline) {
    cv::putText(view_, text, {x, baseline}, cv::FONT_HERSHEY_SIMPLEX, kFontScale,
                cv::Scalar(28, 31, 36), 1, cv::LINE_AA);
  }

  ColorImage& image_;
  cv::Mat view_;
  int y_;
};

int HeightOf(const PictureLegend& legend) {
  const auto lines = static_cast<int>(legend.lines.size());
  return kMargin_px + lines * kTextRow_px + (legend.bar ? kBarRow_px + 6 : 0) +
         (legend.swatches.empty() ? 0 : kTextRow_px);
}

}  // namespace

ColorImage WithLegend(const ColorImage& picture, const PictureLegend& legend) {
  ColorImage page(picture.width(), picture.height() + HeightOf(legend), kPaper);
  std::copy(picture.values().begin(), picture.values().end(), page.values().begin());
  Strip strip(page, picture.height() + kMargin_px / 2);
  for (const std::string& line : legend.lines) strip.AddLine(line);
  if (legend.bar) strip.AddBar(*legend.bar);
  if (!legend.swatches.empty()) strip.AddSwatches(legend.swatches);
  return page;
}

}  // namespace foresight
