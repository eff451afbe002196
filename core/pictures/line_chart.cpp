#include "core/pictures/line_chart.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/base/contract.h"
#include "core/base/markup.h"
#include "core/pictures/ticks.h"

namespace foresight {
namespace {

constexpr double kLeft_px = 74.0;
constexpr double kRight_px = 20.0;
constexpr double kTop_px = 44.0;
constexpr double kBottom_px = 58.0;
constexpr double kChartTickDistance_px = 70.0;  ///< about so far apart
constexpr double kLegendRow_px = 20.0;
constexpr double kLetter_px = 7.5;  ///< width of a letter at 13 px, generous

/// Okabe and Ito, without their yellow, which is hard to see on white.
constexpr std::array<const char*, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#000000"};

/// One axis: from values to pixels.
class Scale {
 public:
  Scale(const ChartAxis& axis, double low, double high, double from_px, double to_px)
      : logarithmic_(axis.logarithmic), from_px_(from_px), to_px_(to_px) {
    const int count =
        std::max(2, static_cast<int>(std::abs(to_px - from_px) / kChartTickDistance_px));
    const double least_step = axis.whole_numbers ? 1.0 : 0.0;
    if (!logarithmic_) {
      // The axis ends on round numbers, so that no point touches its end by chance.
      const Ticks inside = LinearTicks(low, high, count, least_step);
      const double step = inside.values.size() > 1 ? inside.values[1] - inside.values[0] : 1.0;
      low = step * std::floor(low / step + 1e-9);
      high = step * std::ceil(high / step - 1e-9);
    }
    low_ = Place(low);
    high_ = Place(high);
    ticks_ = logarithmic_ ? LogarithmicTicks(low, high) : LinearTicks(low, high, count, least_step);
  }

  /// NaN where the axis does not have such a value.
  double Pixel(double value) const {
    return from_px_ + (Place(value) - low_) / (high_ - low_) * (to_px_ - from_px_);
  }
  const Ticks& ticks() const { return ticks_; }

 private:
  double Place(double value) const {
    if (!std::isfinite(value) || (logarithmic_ && !(value > 0.0)))
      return std::numeric_limits<double>::quiet_NaN();
    return logarithmic_ ? std::log10(value) : value;
  }

  bool logarithmic_;
  double from_px_, to_px_;
  double low_ = 0.0, high_ = 1.0;
  Ticks ticks_;
};

bool CanBeDrawn(const LineChart& chart, const Eigen::Vector2d& point) {
  return point.allFinite() && (!chart.x.logarithmic || point.x() > 0.0) &&
         (!chart.y.logarithmic || point.y() > 0.0);
}

/// Lowest and highest value along an axis (0 = x, 1 = y); never equal.
std::pair<double, double> ExtentOf(const LineChart& chart, int dimension) {
  const ChartAxis& axis = dimension == 0 ? chart.x : chart.y;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const ChartSeries& series : chart.series)
    for (const Eigen::Vector2d& point : series.points)
      if (CanBeDrawn(chart, point)) {
        low = std::min(low, point[dimension]);
        high = std::max(high, point[dimension]);
      }
  if (low > high) return axis.logarithmic ? std::pair(1.0, 10.0) : std::pair(0.0, 1.0);
  if (axis.logarithmic) return low < high ? std::pair(low, high) : std::pair(low / 2.0, high * 2.0);
  if (axis.from_zero) {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }
  if (low < high) return {low, high};
  const double half = low == 0.0 ? 0.5 : 0.5 * std::abs(low);
  return {low - half, high + half};
}

std::string Text(double x, double y, const char* attributes, const std::string& text) {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" {}>{}</text>\n", x, y, attributes,
                     EscapeMarkup(text));
}

std::string Line(double x1, double y1, double x2, double y2, const char* attributes) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", x1, y1,
                     x2, y2, attributes);
}

std::string TitleOf(const ChartAxis& axis) {
  return axis.unit.empty() ? axis.title : fmt::format("{} [{}]", axis.title, axis.unit);
}

/// The drawing of one chart.
class Drawing {
 public:
  explicit Drawing(const LineChart& chart)
      : chart_(chart),
        right_(chart.width - kRight_px),
        bottom_(chart.height - kBottom_px),
        x_(chart.x, ExtentOf(chart, 0).first, ExtentOf(chart, 0).second, kLeft_px, right_),
        y_(chart.y, ExtentOf(chart, 1).first, ExtentOf(chart, 1).second, bottom_, kTop_px) {}

  std::string Svg() const {
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"DejaVu Sans, sans-serif\" font-size=\"13\" fill=\"#1c1f24\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        chart_.width, chart_.height);
    svg += Text(kLeft_px, 26.0, "font-size=\"15\" font-weight=\"bold\"", chart_.title);
    svg += Axes();
    bool any = false;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const std::string lines = Series(chart_.series[i], kColors[i % kColors.size()]);
      any = any || !lines.empty();
      svg += lines;
    }
    if (!any)
      svg += Text(0.5 * (kLeft_px + right_), 0.5 * (kTop_px + bottom_),
                  "text-anchor=\"middle\" fill=\"#6b727c\"", "no data");
    if (chart_.series.size() > 1) svg += Legend();
    return svg + "</svg>\n";
  }

 private:
  std::string Axes() const {
    constexpr const char* kGrid = "stroke=\"#e2e5e9\"";
    std::string svg;
    for (std::size_t i = 0; i < x_.ticks().values.size(); ++i) {
      const double x = x_.Pixel(x_.ticks().values[i]);
      svg += Line(x, kTop_px, x, bottom_, kGrid);
      svg += Text(x, bottom_ + 18.0, "text-anchor=\"middle\"", x_.ticks().labels[i]);
    }
    for (std::size_t i = 0; i < y_.ticks().values.size(); ++i) {
      const double y = y_.Pixel(y_.ticks().values[i]);
      svg += Line(kLeft_px, y, right_, y, kGrid);
      svg += Text(kLeft_px - 8.0, y + 4.5, "text-anchor=\"end\"", y_.ticks().labels[i]);
    }
    svg += fmt::format(
        "<rect class=\"frame\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
        "fill=\"none\" stroke=\"#6b727c\"/>\n",
        kLeft_px, kTop_px, right_ - kLeft_px, bottom_ - kTop_px);
    svg += Text(0.5 * (kLeft_px + right_), chart_.height - 14.0, "text-anchor=\"middle\"",
                TitleOf(chart_.x));
    const double middle = 0.5 * (kTop_px + bottom_);
    const std::string turned =
        fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 20 {:.2f})\"", middle);
    return svg + Text(20.0, middle, turned.c_str(), TitleOf(chart_.y));
  }

  /// Nothing where no point can be drawn.
  std::string Series(const ChartSeries& series, const char* color) const {
    std::string svg, circles, run;
    int run_length = 0;
    const auto end_run = [&] {
      if (run_length > 1)
        svg += fmt::format(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", run,
            color);
      run.clear();
      run_length = 0;
    };
    for (const Eigen::Vector2d& point : series.points) {
      if (!CanBeDrawn(chart_, point)) {
        end_run();
        continue;
      }
      const double x = x_.Pixel(point.x());
      const double y = y_.Pixel(point.y());
      run += fmt::format("{}{:.2f},{:.2f}", run.empty() ? "" : " ", x, y);
      ++run_length;
      circles +=
          fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.5\" fill=\"{}\"/>\n", x, y, color);
    }
    end_run();
    return svg + circles;
  }

  /// In the upper right corner, where curves that fall leave room.
  /// How much of the lines lies in a box: points along them, in pixels.
  int DrawnIn(const Eigen::AlignedBox2d& box) const {
    constexpr int kSteps = 20;
    int inside = 0;
    for (const ChartSeries& series : chart_.series) {
      Eigen::Vector2d last = Eigen::Vector2d::Zero();
      bool begun = false;
      for (const Eigen::Vector2d& point : series.points) {
        if (!CanBeDrawn(chart_, point)) {
          begun = false;
          continue;
        }
        const Eigen::Vector2d here(x_.Pixel(point.x()), y_.Pixel(point.y()));
        for (int i = 1; i <= kSteps; ++i)
          inside += box.contains(begun ? last + (here - last) * i / kSteps : here) ? 1 : 0;
        last = here;
        begun = true;
      }
    }
    return inside;
  }

  /// In the corner where it hides least, the upper right one where all are alike.
  Eigen::Vector2d LegendCorner(const Eigen::Vector2d& size) const {
    constexpr double kBesideFrame_px = 8.0;
    const double left = kLeft_px + kBesideFrame_px, right = right_ - size.x() - kBesideFrame_px;
    const double top = kTop_px + kBesideFrame_px, bottom = bottom_ - size.y() - kBesideFrame_px;
    const Eigen::Vector2d corners[] = {{right, top}, {left, top}, {right, bottom}, {left, bottom}};
    const auto drawn = [&](const Eigen::Vector2d& corner) {
      return DrawnIn({corner, corner + size});
    };
    return *std::min_element(
        std::begin(corners), std::end(corners),
        [&](const auto& one, const auto& other) { return drawn(one) < drawn(other); });
  }

  std::string Legend() const {
    std::size_t longest = 0;
    for (const ChartSeries& series : chart_.series) longest = std::max(longest, series.name.size());
    const auto rows = static_cast<double>(chart_.series.size());
    const Eigen::Vector2d size(44.0 + kLetter_px * static_cast<double>(longest),
                               kLegendRow_px * rows + 8.0);
    const Eigen::Vector2d corner = LegendCorner(size);
    std::string svg = fmt::format(
        "<rect class=\"legend\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
        "fill=\"#ffffff\" fill-opacity=\"0.85\" stroke=\"#d5d9de\"/>\n",
        corner.x(), corner.y(), size.x(), size.y());
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const double y = corner.y() + kLegendRow_px * (static_cast<double>(i) + 0.5) + 4.0;
      const std::string stroke =
          fmt::format("stroke=\"{}\" stroke-width=\"2\"", kColors[i % kColors.size()]);
      svg += Line(corner.x() + 8.0, y, corner.x() + 30.0, y, stroke.c_str());
      svg += Text(corner.x() + 36.0, y + 4.5, "", chart_.series[i].name);
    }
    return svg;
  }

  const LineChart& chart_;
  double right_, bottom_;
  Scale x_, y_;
};

}  // namespace

std::string SvgOf(const LineChart& chart) {
  FORESIGHT_EXPECTS(chart.width >= 200 && chart.height >= 150, "a chart has room for its axes");
  return Drawing(chart).Svg();
}

}  // namespace foresight
