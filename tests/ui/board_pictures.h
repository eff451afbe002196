#pragma once

#include <QDir>
#include <QString>

#include "core/io/png.h"
#include "tests/core/calibration/synthetic_views.h"

namespace foresight {

/// A small camera, so that rendering takes a fraction of a second.
inline CameraModel SmallCamera() {
  return {.width = 480,
          .height = 360,
          .fx = 224.0,
          .fy = 224.0,
          .cx = 242.0,
          .cy = 178.0,
          .lens = FisheyeLens{0.94}};
}

/// Rendered images of a board by a known camera, as files board1.png, board2.png, ...
/// Returns the board.
inline CalibrationBoard WriteBoardPictures(const QString& folder, int count,
                                           const CameraModel& camera = SmallCamera()) {
  SyntheticOptions options{.board = {.columns = 7, .rows = 6, .square_m = 0.05}, .camera = camera};
  options.views = count;
  options.nearest_m = 0.4;
  options.farthest_m = 0.65;
  options.largest_tilt_rad = 0.7;
  const SyntheticViews views = MakeViews(options, 11);
  QDir().mkpath(folder);
  for (std::size_t i = 0; i < views.truth.poses.size(); ++i) {
    RenderOptions rendering{.oversampling = 3};
    rendering.seed = i + 1;
    const GrayImage image = RenderBoard(options.board, camera, views.truth.poses[i], rendering);
    const QString file = QDir(folder).filePath(QStringLiteral("board%1.png").arg(i + 1));
    if (const Status written = WritePng(file.toStdString(), image); !written)
      throw std::runtime_error(written.error().message);
  }
  return options.board;
}

}  // namespace foresight
