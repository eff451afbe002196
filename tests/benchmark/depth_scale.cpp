// How the depth pipeline's time grows with pixels and with density: prints a table and writes two
// charts.
//   depth_scale FOLDER
// The window is fixed, so the work is the number of pixels times the samples in a window: both
// charts should be straight lines.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/depth/depth_method.h"
#include "core/pictures/line_chart.h"
#include "tests/benchmark/room.h"

namespace foresight {
namespace {

constexpr int kRuns = 7;

struct Setting {
  int width, height;
  int step_u, step_v;

  double Megapixels() const { return 1e-6 * width * height; }
  double DensityPercent() const { return 100.0 / (step_u * step_v); }
};

/// Density 2.1 %, from a quarter of the paper's image to four times the camera's.
constexpr Setting kSizes[] = {{320, 240, 4, 12},  {640, 480, 4, 12},   {960, 720, 4, 12},
                              {1288, 964, 4, 12}, {1824, 1368, 4, 12}, {2576, 1928, 4, 12}};
/// The camera's image.
constexpr Setting kDensities[] = {{1288, 964, 8, 12}, {1288, 964, 4, 12}, {1288, 964, 4, 8},
                                  {1288, 964, 4, 5},  {1288, 964, 4, 4},  {1288, 964, 3, 4},
                                  {1288, 964, 2, 5}};

DepthOptions OptionsOf(DepthMethod method) {
  DepthOptions options = DefaultsOf(method);
  options.upsample.sigma_spatial_px = 20.0;
  options.local_plane.sigma_spatial_px = 12.0;
  // All samples stay, so that the density is known.
  options.flying.rule = FlyingPointOptions::Rule::kOff;
  options.isolated.enabled = false;
  return options;
}

/// The fastest of a few runs: others use the machine too.
double Milliseconds(const Setting& setting, DepthMethod method) {
  const Room room = MakeRoom(setting.width, setting.height, setting.step_u, setting.step_v);
  double best = 1e9;
  for (int run = 0; run < kRuns; ++run) {
    const auto result = ComputeDepth(room.samples, room.guide, OptionsOf(method), {});
    if (!result) throw std::runtime_error(result.error().message);
    best = std::min(best, 1000.0 * result->seconds);
  }
  return best;
}

/// Fraction of the variance that a straight line explains.
double Straightness(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose();
  return covariance(0, 1) * covariance(0, 1) / (covariance(0, 0) * covariance(1, 1));
}

template <class Abscissa>
Status Measure(std::span<const Setting> settings, LineChart chart, const Abscissa& abscissa,
               const std::filesystem::path& file) {
  for (const DepthMethod method : {DepthMethod::kForesight, DepthMethod::kPaper}) {
    ChartSeries series{InfoOf(method).title, {}};
    for (const Setting& setting : settings) {
      series.points.emplace_back(abscissa(setting), Milliseconds(setting, method));
      fmt::print("{:<10} {:5.2f} Mpx {:5.2f} % {:8.1f} ms\n", InfoOf(method).name,
                 setting.Megapixels(), setting.DensityPercent(), series.points.back().y());
    }
    fmt::print("{:<10} R^2 of a straight line: {:.4f}\n", InfoOf(method).name,
               Straightness(series.points));
    chart.series.push_back(std::move(series));
  }
  return WriteFileAtomically(file, SvgOf(chart));
}

Status Run(const std::filesystem::path& folder) {
  const ChartAxis time{"time, two threads", "ms", false, true};
  FORESIGHT_CHECK(Measure(
      kSizes,
      {"Time against pixels at a density of 2.1 %", {"pixels", "Mpx", false, true}, time, {}},
      [](const Setting& s) { return s.Megapixels(); }, folder / "time-by-pixels.svg"));
  return Measure(
      kDensities,
      {"Time against density, 1288 x 964 pixels", {"measured pixels", "%", false, true}, time, {}},
      [](const Setting& s) { return s.DensityPercent(); }, folder / "time-by-density.svg");
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: depth_scale FOLDER\n");
    return 2;
  }
  if (const auto status = foresight::Run(argv[1]); !status) {
    fmt::print(stderr, "{}\n", status.error().message);
    return 3;
  }
  return 0;
}
