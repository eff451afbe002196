#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/image.h"
#include "core/base/random.h"
#include "core/calibration/camera_bundle.h"
#include "core/calibration/intrinsics.h"

namespace foresight {

/// Views with known truth.
struct SyntheticViews {
  CameraBundle truth;
  std::vector<IntrinsicsImage> images;
};

struct SyntheticOptions {
  CalibrationBoard board = {.columns = 8, .rows = 6, .square_m = 0.05};
  CameraModel camera = {.width = 1288,
                        .height = 964,
                        .fx = 601.36,
                        .fy = 600.80,
                        .cx = 650.3,
                        .cy = 477.1,
                        .lens = FisheyeLens{0.9413}};
  BoardWarp warp = {};
  int views = 40;
  double noise_px = 0.287;  ///< an axis
  double nearest_m = 0.5, farthest_m = 1.2;
  double largest_tilt_rad = 0.8;
};

/// Boards that are seen whole, everywhere in the image, tilted in all directions.
inline SyntheticViews MakeViews(const SyntheticOptions& options, std::uint64_t seed) {
  Random random(seed);
  SyntheticViews views;
  views.truth.board = options.board;
  views.truth.camera = options.camera;
  views.truth.warp = options.warp;
  const CameraModel& camera = options.camera;
  const Eigen::Vector3d middle =
      0.5 * (options.board.Corner(0) + options.board.Corner(options.board.CornerCount() - 1));
  while (static_cast<int>(views.images.size()) < options.views) {
    const auto ray = camera.Unproject(
        {random.Uniform(0.05, 0.95) * camera.width, random.Uniform(0.05, 0.95) * camera.height});
    const double distance = random.Uniform(options.nearest_m, options.farthest_m);
    const double around = random.Uniform(0.0, 6.2832);
    const double tilt = random.Uniform(0.0, options.largest_tilt_rad);
    const double roll = random.Uniform(-0.4, 0.4);
    if (!ray) continue;
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), *ray) *
        Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(around), std::sin(around), 0.0)) *
        Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
    const CameraFromPattern pose(rotation, distance * *ray - rotation * middle);
    IntrinsicsImage image{.name = "view " + std::to_string(views.images.size() + 1), .view = {}};
    bool whole = true;
    for (int id = 0; id < options.board.CornerCount() && whole; ++id) {
      const auto pixel = camera.Project(pose * options.board.Corner(id, options.warp));
      whole = pixel && camera.InImage(*pixel);
      if (!whole) break;
      image.view.corner_ids.push_back(id);
      image.view.pixels.push_back(*pixel + options.noise_px *
                                               Eigen::Vector2d(random.Normal(), random.Normal()));
    }
    if (!whole) continue;
    views.images.push_back(image);
    views.truth.views.push_back(image.view);
    views.truth.poses.push_back(pose);
  }
  return views;
}

/// What a pixel of a rendered image is: the board's print on a grey wall, `oversampling` rays a
/// pixel and axis, so edges are as soft as a sensor's.
struct RenderOptions {
  double white = 220.0, black = 30.0, wall = 110.0;
  int oversampling = 4;
  double noise = 2.0;  ///< grey levels
  std::uint64_t seed = 1;
};

inline double PrintAt(const CalibrationBoard& board, double x, double y,
                      const RenderOptions& options) {
  const double column = x / board.square_m + 1.0, row = y / board.square_m + 1.0;
  if (column < -0.5 || row < -0.5 || column > board.columns + 1.5 || row > board.rows + 1.5)
    return options.wall;
  if (column < 0.0 || row < 0.0 || column >= board.columns + 1 || row >= board.rows + 1)
    return options.white;
  const bool black = CalibrationBoard::IsBlack(static_cast<int>(column), static_cast<int>(row));
  return black ? options.black : options.white;
}

inline GrayImage RenderBoard(const CalibrationBoard& board, const CameraModel& camera,
                             const CameraFromPattern& pose, const RenderOptions& options = {}) {
  const auto pattern_from_camera = pose.Inverse();
  const Eigen::Vector3d origin = pattern_from_camera.translation();
  Random random(options.seed);
  GrayImage image(camera.width, camera.height, static_cast<std::uint8_t>(options.wall));
  const int n = options.oversampling;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      double sum = 0.0;
      for (int i = 0; i < n * n; ++i) {
        const auto ray = camera.Unproject(
            {u - 0.5 + (i % n + 0.5) / n, v - 0.5 + (static_cast<double>(i / n) + 0.5) / n});
        double grey = 0.0;
        if (ray) {
          const Eigen::Vector3d direction = pattern_from_camera.Rotate(*ray);
          const double along = -origin.z() / direction.z();
          const Eigen::Vector3d hit = origin + along * direction;
          grey = along > 0.0 ? PrintAt(board, hit.x(), hit.y(), options) : options.wall;
        }
        sum += grey;
      }
      const double grey = sum / (n * n) + options.noise * random.Normal();
      image(u, v) = static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0)));
    }
  return image;
}

}  // namespace foresight
