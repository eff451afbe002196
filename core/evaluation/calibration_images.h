#pragma once

#include <filesystem>

#include "core/base/image.h"
#include "core/base/run_context.h"
#include "core/evaluation/simulate_calibration.h"

namespace foresight {

/// Draws what a camera sees of boards: flat checkerboards on white paper before a grey wall, each
/// pixel the mean over its area, with noise. No distortion but the lens's, no motion, no light.
class BoardPainter {
 public:
  explicit BoardPainter(const CameraModel& camera);

  struct PlacedBoard {
    CalibrationBoard board;
    Rigid<frame::Camera, frame::Pattern> camera_from_board;
  };
  /// Boards do not hide each other but where one is nearer. @pre all are checkerboards
  GrayImage Paint(const std::vector<PlacedBoard>& boards, double noise_levels,
                  std::uint64_t seed) const;

 private:
  int width_, height_;
  /// The rays of the pixels' corners, (width + 1) x (height + 1); NaN where there is none. Between
  /// them rays are interpolated, which is exact to a few ten thousandths of a pixel.
  std::vector<Eigen::Vector3f> rays_;
};

/// Writes a simulated session with images (PNG) of its intrinsic views instead of their corners;
/// the stand's stay corners. Images are painted on all threads.
Status WriteSimulatedImages(const SimulatedCalibration& made, std::uint64_t seed,
                            const std::filesystem::path& folder, const RunContext& context);

}  // namespace foresight
