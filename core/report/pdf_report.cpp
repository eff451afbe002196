#include "core/report/pdf_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/io/pdf_page.h"
#include "core/pictures/ticks.h"
#include "core/report/text_lines.h"

namespace foresight {
namespace {

constexpr double kWidth_mm = 210.0, kHeight_mm = 297.0;  // A4
constexpr double kMargin_mm = 15.0;
constexpr double kText_mm = 2.9, kRow_mm = 4.1, kTitle_mm = 3.4;
constexpr double kChartHeight_mm = 52.0;
constexpr PdfPage::Color kGood = {0.0, 0.45, 0.30}, kBad = {0.80, 0.33, 0.0};
constexpr PdfPage::Color kPale = {0.85, 0.87, 0.89};
/// Okabe and Ito's blue, vermilion and green, as in the charts of the HTML page.
constexpr std::array<PdfPage::Color, 3> kSeries = {
    {{0.0, 0.447, 0.698}, {0.835, 0.369, 0.0}, {0.0, 0.620, 0.451}}};

/// A linear axis of a chart on the page.
struct Axis {
  double low = 0.0, high = 1.0, from_mm = 0.0, to_mm = 1.0;
  Ticks ticks;

  double At(double value) const {
    return from_mm + (value - low) / (high - low) * (to_mm - from_mm);
  }
};

Axis AxisOf(const LineChart& chart, int dimension, double from_mm, double to_mm) {
  const ChartAxis& wanted = dimension == 0 ? chart.x : chart.y;
  double low = wanted.from_zero ? 0.0 : INFINITY, high = wanted.from_zero ? 0.0 : -INFINITY;
  for (const ChartSeries& series : chart.series)
    for (const Eigen::Vector2d& point : series.points)
      if (point.allFinite()) {
        low = std::min(low, point[dimension]);
        high = std::max(high, point[dimension]);
      }
  if (!(low <= high)) low = 0.0, high = 1.0;
  const double margin = low < high ? 0.05 * (high - low) : std::max(0.5 * std::abs(low), 0.5);
  Axis axis{low - (wanted.from_zero ? 0.0 : margin), high + margin, from_mm, to_mm, {}};
  axis.ticks = LinearTicks(axis.low, axis.high, 4, wanted.whole_numbers ? 1.0 : 0.0);
  return axis;
}

std::string TitleOf(const ChartAxis& axis) {
  return axis.unit.empty() ? axis.title : fmt::format("{} [{}]", axis.title, axis.unit);
}

void DrawSeries(PdfPage& page, const ChartSeries& series, const Axis& x, const Axis& y) {
  constexpr double kDot_mm = 0.28;
  std::vector<Eigen::Vector2d> run;
  const auto finish = [&] {
    if (run.size() == 1) page.Dot(run[0].x(), run[0].y(), kDot_mm);
    if (run.size() > 1) page.Polyline(run);
    run.clear();
  };
  for (const Eigen::Vector2d& point : series.points)
    if (point.allFinite())
      run.emplace_back(x.At(point.x()), y.At(point.y()));
    else
      finish();
  finish();
}

void DrawChart(PdfPage& page, const LineChart& chart, double left, double top, double width) {
  constexpr double kSmall_mm = 2.2;
  const double inner_left = left + 13.0, inner_right = left + width - 2.0;
  const double inner_top = top + 6.0, inner_bottom = top + kChartHeight_mm - 10.0;
  const Axis x = AxisOf(chart, 0, inner_left, inner_right);
  const Axis y = AxisOf(chart, 1, inner_bottom, inner_top);
  page.SetColor(PdfPage::kBlack);
  page.BoldText(left, top + 3.0, kText_mm, Cut(page, chart.title, kText_mm, width));
  for (std::size_t i = 0; i < x.ticks.values.size(); ++i) {
    const double at = x.At(x.ticks.values[i]);
    page.SetColor(kPale);
    page.Line(at, inner_top, at, inner_bottom);
    page.SetColor(PdfPage::kGrey);
    const double half = 0.5 * page.TextWidth(kSmall_mm, x.ticks.labels[i]);
    page.Text(at - half, inner_bottom + 3.0, kSmall_mm, x.ticks.labels[i]);
  }
  for (std::size_t i = 0; i < y.ticks.values.size(); ++i) {
    const double at = y.At(y.ticks.values[i]);
    page.SetColor(kPale);
    page.Line(inner_left, at, inner_right, at);
    page.SetColor(PdfPage::kGrey);
    const double text_width = page.TextWidth(kSmall_mm, y.ticks.labels[i]);
    page.Text(inner_left - text_width - 1.0, at + 0.8, kSmall_mm, y.ticks.labels[i]);
  }
  page.SetColor(PdfPage::kGrey);
  page.Frame(inner_left, inner_top, inner_right - inner_left, inner_bottom - inner_top);
  page.Text(inner_left, inner_bottom + 6.4, kSmall_mm, TitleOf(chart.x));
  page.Upwards(left + 2.6, inner_bottom, kSmall_mm, TitleOf(chart.y));
  double legend = inner_right;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    page.SetColor(kSeries[i % kSeries.size()]);
    DrawSeries(page, chart.series[i], x, y);
    if (chart.series.size() < 2) continue;
    legend -= page.TextWidth(kSmall_mm, chart.series[i].name) + 2.0;
    page.Text(legend, inner_bottom + 6.4, kSmall_mm, chart.series[i].name);
  }
}

class Sheet {
 public:
  explicit Sheet(const PdfReport& report) : report_(report), page_(kWidth_mm, kHeight_mm) {}

  Result<std::string> Draw() {
    page_.BoldText(kMargin_mm, 20.0, 6.0, Cut(page_, report_.title, 6.0, Inner()));
    top_ = 27.0;
    Verdict();
    for (const PdfReport::Row& row : report_.subject) Row(row, kMargin_mm, Inner(), 38.0);
    top_ += 3.0;
    Charts();
    Tables();
    return std::move(page_).Bytes();
  }

 private:
  static double Inner() { return kWidth_mm - 2.0 * kMargin_mm; }

  void Verdict() {
    constexpr double kSize_mm = 3.6, kLine_mm = 5.0;
    const auto lines = Wrapped(page_, report_.verdict, kSize_mm, Inner() - 8.0);
    page_.SetColor(report_.good ? kGood : kBad);
    page_.Fill(kMargin_mm, top_, 2.5, kLine_mm * static_cast<double>(lines.size()) + 1.0);
    if (!report_.good) page_.BoldText(kMargin_mm + 3.6, top_ + 4.2, 5.0, "!");
    page_.SetColor(PdfPage::kBlack);
    for (const std::string& line : lines) {
      top_ += kLine_mm;
      page_.Text(kMargin_mm + 7.0, top_ - 0.8, kSize_mm, line);
    }
    top_ += 6.0;
  }

  void Row(const PdfReport::Row& row, double left, double width, double name_width) {
    page_.SetColor(PdfPage::kGrey);
    page_.Text(left, top_, kText_mm, Cut(page_, row.name, kText_mm, name_width - 1.5));
    page_.SetColor(PdfPage::kBlack);
    page_.Text(left + name_width, top_, kText_mm,
               Cut(page_, row.value, kText_mm, width - name_width));
    top_ += kRow_mm;
  }

  void Charts() {
    const std::size_t count = std::min<std::size_t>(report_.charts.size(), 3);
    if (count == 0) return;
    constexpr double kGap_mm = 4.0;
    const double width =
        (Inner() - kGap_mm * static_cast<double>(count - 1)) / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i)
      DrawChart(page_, report_.charts[i], kMargin_mm + static_cast<double>(i) * (width + kGap_mm),
                top_, width);
    top_ += kChartHeight_mm + 2.0;
  }

  void Tables() {
    constexpr double kBottom_mm = kHeight_mm - 16.0, kName_mm = 48.0;
    int left_out = 0;
    for (const PdfReport::Table& table : report_.tables) {
      if (top_ + kTitle_mm + 2.0 * kRow_mm > kBottom_mm) {
        left_out += static_cast<int>(table.rows.size());
        continue;
      }
      page_.SetColor(PdfPage::kBlack);
      page_.BoldText(kMargin_mm, top_ + 1.0, kTitle_mm, table.title);
      page_.SetColor(kPale);
      page_.Line(kMargin_mm, top_ + 2.2, kWidth_mm - kMargin_mm, top_ + 2.2);
      top_ += kRow_mm + 2.0;
      for (const PdfReport::Row& row : table.rows) {
        if (top_ > kBottom_mm)
          ++left_out;
        else
          Row(row, kMargin_mm, Inner(), kName_mm);
      }
      top_ += 2.5;
    }
    if (left_out == 0) return;
    page_.SetColor(PdfPage::kGrey);
    page_.Text(kMargin_mm, kHeight_mm - 9.0, kText_mm,
               fmt::format("{} more rows are on the page report.html.", left_out));
  }

  const PdfReport& report_;
  PdfPage page_;
  double top_ = 0.0;
};

}  // namespace

Result<std::string> PdfOf(const PdfReport& report) {
  return Sheet(report).Draw();
}

}  // namespace foresight
