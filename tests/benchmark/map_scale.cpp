// A map of many points: how long its pyramid takes, what it needs, how long a picture takes to be
// chosen and, where there is a display, to be drawn.
//   map_scale [MILLIONS_OF_POINTS] [BUDGET]
// Run it through tests/display/with_display.sh for the times of frames.
#include <fmt/format.h>
#include <sys/resource.h>

#include <vtkRenderWindow.h>
#include <QApplication>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "core/base/random.h"
#include "core/mapping/point_pyramid.h"
#include "ui/viewmodels/map_view_model.h"
#include "ui/views/cloud_canvas.h"
#include "ui/views/vtk_setup.h"

namespace foresight {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double PeakGigabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0 / 1024.0;
}

/// Floors, walls and shelves of a hall of 40 m x 25 m x 6 m, seen by ten scans, with the lidar's
/// noise.
std::vector<TaggedPoint> Hall(std::size_t count) {
  Random random(1);
  std::vector<TaggedPoint> points(count);
  for (TaggedPoint& point : points) {
    const double a = random.Uniform(), b = random.Uniform(), noise = 0.01 * random.Normal();
    Eigen::Vector3d at;
    switch (random.Index(5)) {
      case 0:
        at = {40.0 * a, 25.0 * b, noise};
        break;
      case 1:
        at = {40.0 * a, random.Index(2) == 0 ? noise : 25.0 + noise, 6.0 * b};
        break;
      case 2:
        at = {random.Index(2) == 0 ? noise : 40.0 + noise, 25.0 * a, 6.0 * b};
        break;
      default:  // twenty shelves of 1 m x 0.5 m x 2 m
        const int shelf = random.Index(20);
        at = Eigen::Vector3d(4.0 + 3.5 * (shelf % 10), 6.0 + 12.0 * (shelf / 10), 0.0) +
             Eigen::Vector3d(a, 0.5 * random.Index(2) + noise, 2.0 * b);
    }
    point.position = at.cast<float>();
    point.tag = static_cast<std::uint32_t>(random.Index(10));
  }
  return points;
}

PointSet SetOf(const std::vector<TaggedPoint>& points) {
  PointSet set;
  for (const TaggedPoint& point : points) {
    set.points.push_back(point.position);
    set.colors.push_back(ColorOfScan(point.tag));
  }
  return set;
}

/// From `eye` towards `target`, 30 deg high, as the cloud's camera looks.
Eigen::Matrix4d LookFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  constexpr double kNear = 0.05, kFar = 500.0, kAspect = 1.6;
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized(), y = x.cross(z);
  const double focal = 1.0 / std::tan(0.5 * 30.0 * M_PI / 180.0);
  const double a = (kFar + kNear) / (kFar - kNear), b = -2.0 * kFar * kNear / (kFar - kNear);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip.row(0) << focal / kAspect * x.transpose(), -focal / kAspect * x.dot(eye);
  clip.row(1) << focal * y.transpose(), -focal * y.dot(eye);
  clip.row(2) << a * z.transpose(), b - a * z.dot(eye);
  clip.row(3) << z.transpose(), -z.dot(eye);
  return clip;
}

/// Of all threads.
double CpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct FrameTime {
  double wall_s = 0.0;  ///< the median
  double cpu_s = 0.0;   ///< the mean
};

FrameTime TimeFrames(CloudCanvas& canvas) {
  constexpr int kFrames = 5;
  std::vector<double> seconds;
  const double cpu_begin_s = CpuSeconds();
  for (int i = 0; i < kFrames; ++i) {
    const auto begin = Clock::now();
    canvas.renderWindow()->Render();
    seconds.push_back(SecondsSince(begin));
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], (CpuSeconds() - cpu_begin_s) / kFrames};
}

void Run(std::size_t count, std::size_t budget, CloudCanvas* canvas) {
  std::vector<TaggedPoint> points = Hall(count);
  const double before = PeakGigabytes();
  auto begin = Clock::now();
  const double cpu_begin_s = CpuSeconds();
  const PointPyramid pyramid = PointPyramid::Build(std::move(points), {}, {}).value();
  fmt::print(
      "{} points: built in {:.1f} s ({:.1f} s of CPU), {} cubes, {:.2f} GB; at most {:.2f} GB more "
      "than the points while building\n",
      pyramid.size(), SecondsSince(begin), CpuSeconds() - cpu_begin_s, pyramid.CubeCount(),
      static_cast<double>(pyramid.Bytes()) / 1e9, PeakGigabytes() - before);
  struct Place {
    const char* name;
    Eigen::Vector3d eye, target;
  };
  const Place places[] = {{"all of it, from 60 m", {-40, -25, 35}, {20, 12, 0}},
                          {"a shelf, from 6 m", {5, 0.5, 2}, {4.5, 6, 1}},
                          {"a hand's breadth, from 0.4 m", {4.5, 5.6, 1}, {4.5, 6, 1}}};
  for (const Place& place : places) {
    PyramidView view;
    view.clip_from_map = LookFrom(place.eye, place.target);
    view.height_px = 800;
    view.budget = budget;
    begin = Clock::now();
    const std::vector<TaggedPoint> taken = pyramid.Select(view);
    const double select_s = SecondsSince(begin);
    fmt::print("  {}: {} points chosen in {:.0f} ms", place.name, taken.size(), 1e3 * select_s);
    if (canvas != nullptr) {
      begin = Clock::now();
      const PointSet set = SetOf(taken);
      canvas->SetPoints(set, ColorMap::kTurbo, {});
      const double hand_over_s = SecondsSince(begin);
      const FrameTime frame = TimeFrames(*canvas);
      fmt::print(", handed over in {:.0f} ms, a frame in {:.0f} ms ({:.0f} ms of CPU)",
                 1e3 * hand_over_s, 1e3 * frame.wall_s, 1e3 * frame.cpu_s);
    }
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace foresight

int main(int argc, char** argv) {
  const double millions = argc > 1 ? std::atof(argv[1]) : 50.0;
  const double budget = argc > 2 ? std::atof(argv[2]) : 500'000.0;
  const auto count = static_cast<std::size_t>(1e6 * millions);
  if (std::getenv("DISPLAY") == nullptr) {
    foresight::Run(count, static_cast<std::size_t>(budget), nullptr);
    return 0;
  }
  foresight::SetUpVtk();
  QApplication application(argc, argv);
  foresight::CloudCanvas canvas;
  canvas.resize(1280, 800);
  canvas.show();
  for (int i = 0; i < 50; ++i) QCoreApplication::processEvents();
  foresight::Run(count, static_cast<std::size_t>(budget), &canvas);
  return 0;
}
