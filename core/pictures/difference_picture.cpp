#include "core/pictures/difference_picture.h"

#include <algorithm>
#include <cmath>

#include "core/base/contract.h"

namespace foresight {

const Rgb8 kColorOnlyInA = {150, 84, 184};
const Rgb8 kColorOnlyInB = {46, 150, 84};

namespace {

constexpr Rgb8 kNeither = {16, 17, 20};
constexpr double kFullScale_mm = 1000.0 * DepthComparison::kFullScale_m;

bool Keeps(const DepthImage& depth_m, const MaskImage& mask, std::size_t i) {
  return std::isfinite(depth_m.values()[i]) && mask.values()[i] != 0;
}

}  // namespace

ColorImage PaintDifference(const DepthComparison& comparison, const DepthImage& first_m,
                           const MaskImage& first_mask, const DepthImage& second_m,
                           const MaskImage& second_mask) {
  const DepthImage& difference_m = comparison.difference_m;
  FORESIGHT_EXPECTS(difference_m.SameSize(first_m) && difference_m.SameSize(second_m),
                    "the comparison is of these two maps");
  ColorImage picture(difference_m.width(), difference_m.height(), kNeither);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double difference = difference_m.values()[i];
    Rgb8& pixel = picture.values()[i];
    if (std::isfinite(difference))
      pixel = ColorOf(ColorMap::kBalance, 0.5 + 0.5 * difference / DepthComparison::kFullScale_m);
    else if (Keeps(first_m, first_mask, i))
      pixel = kColorOnlyInA;
    else if (Keeps(second_m, second_mask, i))
      pixel = kColorOnlyInB;
  }
  return picture;
}

PictureLegend LegendOfDifference(const std::string& first, const std::string& second) {
  PictureLegend legend;
  legend.lines = {second + " minus " + first};
  legend.bar = {ColorMap::kBalance, {-kFullScale_mm, kFullScale_mm}, "mm", false};
  legend.swatches = {
      {kColorOnlyInA, "only in A"}, {kColorOnlyInB, "only in B"}, {kNeither, "in neither"}};
  return legend;
}

LineChart ChartOfDifference(const DepthComparison& comparison) {
  LineChart chart;
  chart.title = "B minus A";
  chart.x = {"difference of depth", "mm"};
  chart.y = {"pixels", "% of those in both", false, true};
  const double all = std::max<double>(1.0, static_cast<double>(comparison.in_both));
  constexpr double kBin_mm = 2.0 * kFullScale_mm / DepthComparison::kBins;
  ChartSeries series{"pixels", {}};
  for (std::size_t i = 0; i < comparison.histogram.size(); ++i)
    series.points.emplace_back(-kFullScale_mm + kBin_mm * (static_cast<double>(i) + 0.5),
                               100.0 * static_cast<double>(comparison.histogram[i]) / all);
  chart.series.push_back(std::move(series));
  return chart;
}

}  // namespace foresight
