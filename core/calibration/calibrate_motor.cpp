#include "core/calibration/calibrate_motor.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/initial_motor.h"
#include "core/calibration/locate_stand.h"
#include "core/calibration/misfit_limit.h"
#include "core/calibration/motor_graph.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Whether any pose of the stand shows both boards, be it from different stops.
bool BoardsAreTied(const CalibrationSession& session) {
  return std::any_of(session.poses.begin(), session.poses.end(), [](const PatternPose& pose) {
    bool a = false, b = false;
    for (const MotorStop& stop : pose.stops) {
      a = a || stop.view.a.has_value();
      b = b || stop.view.b.has_value();
    }
    return a && b;
  });
}

/// Removes corners farther than `most_px` from where they should be; returns how many.
int DropCorners(const ChainState& state, double most_px, std::vector<CornerSet>* all) {
  int dropped = 0;
  for (CornerSet& corners : *all) {
    const std::vector<Eigen::Vector2d> residuals = CornerResiduals(state, corners);
    CornerSet kept = corners;
    kept.on_board.clear();
    kept.pixels.clear();
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      if (!(residuals[i].norm() <= most_px)) continue;
      kept.on_board.push_back(corners.on_board[i]);
      kept.pixels.push_back(corners.pixels[i]);
    }
    dropped += static_cast<int>(corners.pixels.size() - kept.pixels.size());
    corners = std::move(kept);
  }
  std::erase_if(*all, [](const CornerSet& corners) { return corners.pixels.empty(); });
  return dropped;
}

double UsualRms(const std::vector<ImageFit>& images) {
  std::vector<double> rms_px;
  for (const ImageFit& image : images) rms_px.push_back(image.rms_px);
  return MedianRms(std::move(rms_px));
}

/// An image that fits several times worse than the others is not of the same stand; nullptr = none.
const ImageFit* Misfit(const std::vector<ImageFit>& images) {
  const double limit = MisfitLimit(UsualRms(images));
  const auto worst =
      std::max_element(images.begin(), images.end(),
                       [](const ImageFit& a, const ImageFit& b) { return a.rms_px < b.rms_px; });
  return worst == images.end() || worst->rms_px <= limit ? nullptr : &*worst;
}

/// Solves without the worst image until none is a misfit. Fails where that is over one in ten.
Status SolveWithoutMisfits(const ChainSolveOptions& solve, MotorCalibration* result,
                           const RunContext& context) {
  constexpr std::size_t kOneIn = 10;
  const std::size_t most = result->data.corners.size() / kOneIn;
  for (std::size_t left_out = 0;; ++left_out) {
    const std::vector<ImageFit> images = FitsOfImages(result->state, result->data.corners);
    const double most_usual_px = std::max(5.0, result->state.camera.width / 250.0);
    if (const double usual_px = UsualRms(images); !(usual_px <= most_usual_px))
      return Fail(ErrorCode::kInvalidInput,
                  "the images do not fit together: half of them are over {:.1f} px off. The stand "
                  "moved in many of them, or stops and images do not belong together",
                  usual_px);
    const ImageFit* misfit = Misfit(images);
    if (misfit == nullptr) return {};
    const std::string what = fmt::format(
        "{}: the corners are {:.1f} px (rms) from where the other images have the board. The "
        "stand moved, boards are exchanged, or the image is of another stop",
        misfit->source, misfit->rms_px);
    if (left_out == most) return Fail(ErrorCode::kInvalidInput, "{}", what);
    std::erase_if(result->data.corners,
                  [misfit](const CornerSet& corners) { return corners.source == misfit->source; });
    result->notes.push_back("left out: " + what);
    FORESIGHT_TRY(result->fit, SolveChain(result->data, solve, &result->state, context));
  }
}

}  // namespace

Status MotorCalibrationOptions::Check() const {
  FORESIGHT_CHECK(noise.Check());
  if (!(most_angle_error_rad > 0.0))
    return Fail(ErrorCode::kInvalidOptions, "calibration: most_angle_error_rad {} is not positive",
                most_angle_error_rad);
  if (!(most_axis_error_rad > 0.0))
    return Fail(ErrorCode::kInvalidOptions, "calibration: most_axis_error_rad {} is not positive",
                most_axis_error_rad);
  return {};
}

std::vector<ImageFit> FitsOfImages(const ChainState& state, const std::vector<CornerSet>& all) {
  std::vector<ImageFit> fits;
  for (const CornerSet& corners : all) {
    ImageFit fit{corners.source, static_cast<int>(corners.pixels.size()), 0.0, 0.0};
    for (const Eigen::Vector2d& residual : CornerResiduals(state, corners)) {
      fit.rms_px += residual.squaredNorm() / fit.corners;
      fit.mean_px += residual.norm() / fit.corners;
    }
    fit.rms_px = std::sqrt(fit.rms_px);
    fits.push_back(fit);
  }
  return fits;
}

Result<Rigid<frame::Camera, frame::Head>> InPaperGauge(
    const Rigid<frame::Camera, frame::Head>& camera_from_head) {
  const Eigen::Vector3d axis = camera_from_head.Rotate(Eigen::Vector3d::UnitX());
  constexpr double kLeastCosine = 0.1;
  if (std::abs(axis.x()) < kLeastCosine)
    return Fail(
        ErrorCode::kInvalidInput,
        "the motor's axis is {:.1f} deg from the camera's x: the paper's choice (no turn and "
        "no shift along x) does not exist for this mount",
        DegreesFromRadians(std::acos(std::abs(axis.x()))));
  const Eigen::Quaterniond& q = camera_from_head.rotation();
  const double turn = 2.0 * std::atan2(-q.x(), q.w());
  const double shift = -camera_from_head.translation().x() / axis.x();
  return Rigid<frame::Camera, frame::Head>(
      q * Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX())),
      camera_from_head.translation() + shift * axis);
}

Result<MotorCalibration> CalibrateMotor(const CalibrationSession& all, const CameraModel& camera,
                                        const MotorCalibrationOptions& options,
                                        const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  FORESIGHT_CHECK(all.Check());
  FORESIGHT_CHECK(camera.Check());
  MotorCalibration result;
  FORESIGHT_TRY(const CalibrationSession given, WithoutMisfits(all, camera, &result.notes));
  const MotorGraph graph = MakeMotorGraph(given);
  const std::string missing = graph.InWords(given);
  const bool leave_out =
      options.loose_stops == MotorCalibrationOptions::LooseStops::kLeaveOut && graph.reference >= 0;
  if (!missing.empty() && !(leave_out && !graph.Complete()))
    return Fail(ErrorCode::kInvalidInput, "camera and motor: {}", missing);
  if (!graph.Complete()) result.notes.push_back("left out: " + missing);
  const CalibrationSession session = graph.Complete() ? given : WithoutLooseStops(given, graph);
  for (const int pose : graph.useless_poses)
    result.notes.push_back(fmt::format("{} is seen from one stop only: it does not help the axis",
                                       given.poses[static_cast<std::size_t>(pose)].name));

  FORESIGHT_TRY(result.state, InitialMotor(session, camera, options, &result.notes));
  result.data.corners = MountCorners(session, result.state.motor_rad);
  ChainSolveOptions solve{.free = {.head = true}, .noise = options.noise};
  if (options.as_in_the_paper) {
    result.state.a_from_b = session.mount.a_from_b;
  } else {
    solve.free.jitter = true;
    solve.free.mount = session.mount.b && BoardsAreTied(session);
  }
  FORESIGHT_TRY(result.fit, SolveChain(result.data, solve, &result.state, context));
  if (!options.as_in_the_paper) {
    FORESIGHT_CHECK(SolveWithoutMisfits(solve, &result, context));
    constexpr double kMostSigmas = 5.0;  // of 10,000 good corners it costs one in a hundred
    const double sigma_px =
        std::max(options.noise.corner_px,
                 UsualRms(FitsOfImages(result.state, result.data.corners)) / std::sqrt(2.0));
    const int dropped = DropCorners(result.state, kMostSigmas * sigma_px, &result.data.corners);
    if (dropped > 0) {
      result.notes.push_back(fmt::format("{} corners lie over {:.1f} px off and are left out",
                                         dropped, kMostSigmas * sigma_px));
      FORESIGHT_TRY(result.fit, SolveChain(result.data, solve, &result.state, context));
    }
  }
  // What the images leave open is an error here, not a number.
  if (const auto covariance = CovarianceOfChain(result.data, solve, result.state); !covariance)
    return tl::unexpected(covariance.error());
  result.images = FitsOfImages(result.state, result.data.corners);
  double sum_px = 0.0, corners = 0.0;
  for (const ImageFit& image : result.images) {
    sum_px += image.mean_px * image.corners;
    corners += image.corners;
  }
  result.mean_error_px = corners > 0.0 ? sum_px / corners : 0.0;
  return result;
}

}  // namespace foresight
