#include "core/calibration/calibrate_chain.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/calibration/initial_motor.h"
#include "core/calibration/intrinsics.h"
#include "core/calibration/motor_graph.h"
#include "core/geometry/angles.h"
#include "core/geometry/symmetric_eigen.h"

namespace foresight {
namespace {

class StopWatch {
 public:
  double Lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    begin_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

struct CameraStage {
  CameraModel camera;
  std::vector<CornerSet> corners;
  std::vector<Rigid<frame::Camera, frame::Pattern>> camera_from_view;
};

Result<CameraStage> FindCamera(const CalibrationSession& session,
                               const ChainCalibrationOptions& options,
                               std::vector<std::string>* notes, const RunContext& context) {
  CameraStage stage;
  stage.camera = session.prior.camera;
  if (session.intrinsic_views.empty()) return stage;
  std::vector<IntrinsicsImage> images;
  for (const IntrinsicView& view : session.intrinsic_views)
    images.push_back({view.source, view.view});
  IntrinsicsOptions intrinsics;
  intrinsics.warp = IntrinsicsOptions::Warp::kOff;  // the joint solve takes boards as flat
  intrinsics.models = options.lenses;
  if (intrinsics.models.empty()) intrinsics.models = {LensModelOf(session.prior.camera.lens)};
  FORESIGHT_TRY(const IntrinsicsCalibration found,
                CalibrateIntrinsics(session.intrinsic_board, images, session.prior.camera.width,
                                    session.prior.camera.height, intrinsics, context));
  if (found.best < 0)
    return Fail(ErrorCode::kNoConvergence, "camera: {}", found.models.front().failure);
  for (const RejectedImage& image : found.images_rejected)
    notes->push_back(fmt::format("{} is left out: {}", image.name, image.reason));
  const ModelCalibration& best = found.models[static_cast<std::size_t>(found.best)];
  notes->insert(notes->end(), best.warnings.begin(), best.warnings.end());
  stage.camera = best.camera;
  for (const ImageErrors& image : best.images) {
    CornerSet corners;
    corners.view = static_cast<int>(stage.camera_from_view.size());
    corners.source = images[image.image].name;
    corners.pixels = image.pixels;
    for (const int id : image.corner_ids)
      corners.on_board.push_back(session.intrinsic_board.Corner(id));
    stage.corners.push_back(std::move(corners));
    stage.camera_from_view.push_back(image.camera_from_pattern);
  }
  return stage;
}

SensorRig RigFrom(const SensorRig& prior, const ChainState& state) {
  SensorRig rig = prior;
  rig.date_utc.clear();
  rig.parent_id.clear();
  rig.camera = state.camera;
  rig.camera_from_head = state.camera_from_head;
  rig.camera_from_lidar = state.camera_from_lidar;
  rig.lidar.range_offset_m = state.range_offset_m;
  rig.lidar.stamp_offset_s = state.stamp_offset_s;
  std::vector<AngleCorrection::Knot> knots;
  for (std::size_t i = 0; i < state.motor_rad.size(); ++i)
    knots.push_back({state.motor_rad[i], state.plate_rad[i]});
  rig.angle_correction = AngleCorrection::FromKnots(std::move(knots)).value_or(AngleCorrection());
  return rig;
}

/// What a deviation of an unknown may be before a scan suffers; the weakest direction is judged by
/// it.
double ToleranceOf(const SharedUnknown& unknown) {
  if (unknown.unit == "px") return 1.0;
  if (unknown.unit == "rad") return 0.0017;  // 0.1 deg, 5 mm at 3 m
  if (unknown.unit == "m") return 0.003;
  if (unknown.unit == "s") return 0.001;
  return 0.002;  // k of the lens
}

std::string AmountOf(const SharedUnknown& unknown, double sigma) {
  if (unknown.unit == "rad") return fmt::format("{:.3f} deg", DegreesFromRadians(sigma));
  if (unknown.unit == "m") return fmt::format("{:.2f} mm", 1000.0 * sigma);
  if (unknown.unit == "s") return fmt::format("{:.2f} ms", 1000.0 * sigma);
  if (unknown.unit == "px") return fmt::format("{:.2f} px", sigma);
  return fmt::format("{:.5f}", sigma);
}

std::string WeakestInWords(const ChainCovariance& covariance) {
  const auto count = static_cast<Eigen::Index>(covariance.unknowns.size());
  Eigen::VectorXd scale(count);
  for (Eigen::Index i = 0; i < count; ++i)
    scale[i] = 1.0 / ToleranceOf(covariance.unknowns[static_cast<std::size_t>(i)]);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * covariance.matrix * scale.asDiagonal();
  const Eigen::VectorXd direction = EigenOf(scaled).vectors.col(count - 1).cwiseAbs();
  Eigen::Index first = 0, second = 0;
  direction.maxCoeff(&first);
  Eigen::VectorXd others = direction;
  others[first] = 0.0;
  others.maxCoeff(&second);
  const auto name = [&](Eigen::Index i) {
    const SharedUnknown& unknown = covariance.unknowns[static_cast<std::size_t>(i)];
    return fmt::format("{} (+- {})", unknown.in_words,
                       AmountOf(unknown, covariance.Sigma(static_cast<int>(i))));
  };
  constexpr double kCounts = 0.4;  // of a unit vector
  std::string text = name(first);
  if (others[second] > kCounts) text += " together with " + name(second);
  return text + ": " + covariance.unknowns[static_cast<std::size_t>(first)].hint;
}

class ChainRunner {
 public:
  ChainRunner(const CalibrationSession& session, const ChainCalibrationOptions& options,
              const RunContext& context)
      : session_(session), options_(options), context_(context) {
    found_.noise = options.noise;
  }

  Result<ChainCalibration> Run();

 private:
  Status Camera();
  Status Motor();
  Status Lidar();
  Status Time();
  Status Joint();
  Status SolveJointly();
  void ScaleNoise();
  void Summarize();
  void CheckAgainstPrior();
  LidarCalibrationOptions LidarOptions() const;

  CalibrationSession session_;
  ChainCalibrationOptions options_;
  const RunContext& context_;
  CameraStage camera_;
  ChainSolveOptions joint_;
  ChainCalibration found_;
};

LidarCalibrationOptions ChainRunner::LidarOptions() const {
  LidarCalibrationOptions lidar;
  lidar.noise = found_.noise;
  lidar.gate_sigmas = options_.gate_sigmas;
  if (options_.as_in_the_paper) {
    lidar.residual = LidarResidual::kPerpendicular;
    lidar.range_offset = false;
  }
  return lidar;
}

Status ChainRunner::Camera() {
  FORESIGHT_TRY(camera_, FindCamera(session_, options_, &found_.notes, context_));
  return {};
}

Status ChainRunner::Motor() {
  MotorCalibrationOptions motor;
  motor.noise = found_.noise;
  motor.as_in_the_paper = options_.as_in_the_paper;
  FORESIGHT_TRY(MotorCalibration stage, CalibrateMotor(session_, camera_.camera, motor, context_));
  found_.state = std::move(stage.state);
  found_.state.camera_from_view = camera_.camera_from_view;
  found_.state.range_offset_m = 0.0;
  found_.state.stamp_offset_s = session_.prior.lidar.stamp_offset_s;
  found_.data.corners = std::move(stage.data.corners);
  found_.notes.insert(found_.notes.end(), stage.notes.begin(), stage.notes.end());
  return {};
}

Status ChainRunner::Lidar() {
  found_.range_sigma_m = options_.range_sigma_m;
  if (!(found_.range_sigma_m > 0.0)) found_.range_sigma_m = RangeSigmaOf(session_);
  constexpr double kUnknownSigma_m = 0.020;
  if (!std::isfinite(found_.range_sigma_m)) found_.range_sigma_m = kUnknownSigma_m;
  const auto profiles = ProfilesOfStops(session_, found_.state.motor_rad, found_.range_sigma_m,
                                        options_.range_floor_m);
  if (profiles.empty())
    return Fail(ErrorCode::kTooFewPoints, "camera and lidar: the session has no lidar lines");
  FORESIGHT_TRY(LidarCalibration stage,
                CalibrateLidar(session_.mount, found_.state, profiles, LidarOptions(), context_));
  found_.state = std::move(stage.state);
  found_.data.hits = std::move(stage.hits);
  found_.linear = stage.linear;
  return {};
}

Status ChainRunner::Time() {
  FORESIGHT_TRY(TimeCalibration stage,
                CalibrateTime(session_, found_.state, found_.data.hits, found_.range_sigma_m,
                              LidarOptions(), context_));
  found_.state = std::move(stage.state);
  found_.data.tracks = std::move(stage.tracks);
  found_.data.hits.insert(found_.data.hits.end(), stage.hits.begin(), stage.hits.end());
  found_.up_ratio = stage.up_ratio;
  return {};
}

/// Gates the returns with each solve's answer: the first one starts from stages that were solved
/// one by one.
Status ChainRunner::SolveJointly() {
  std::vector<BoardHits> all = found_.data.hits;
  for (int round = 0; round < 2; ++round) {
    if (options_.gate_sigmas > 0.0)
      found_.data.hits = WithinGate(found_.data, found_.state, all, options_.gate_sigmas);
    FORESIGHT_TRY(found_.fit, SolveChain(found_.data, joint_, &found_.state, context_));
  }
  return {};
}

void ChainRunner::ScaleNoise() {
  const double corners = std::sqrt(found_.corners.chi_square);
  const double ranges = std::sqrt(found_.ranges.chi_square);
  if (corners > 0.0) joint_.noise.corner_px *= corners;
  if (ranges > 0.0)
    for (BoardHits& hits : found_.data.hits)
      for (LidarReturn& r : hits.returns) r.sigma_m *= ranges;
  found_.noise = joint_.noise;
}

Status ChainRunner::Joint() {
  found_.data.corners.insert(found_.data.corners.end(), camera_.corners.begin(),
                             camera_.corners.end());
  const bool mount_is_tied =
      session_.mount.b && std::any_of(found_.data.corners.begin(), found_.data.corners.end(),
                                      [](const CornerSet& corners) { return corners.on_b; });
  joint_.noise = found_.noise;
  joint_.free = {.camera = !camera_.corners.empty(),
                 .views = true,
                 .head = true,
                 .jitter = true,
                 .mount = mount_is_tied,
                 .lidar = true,
                 .range_offset = true,
                 .stamp_offset = found_.up_ratio.has_value()};
  FORESIGHT_CHECK(SolveJointly());
  Summarize();
  if (options_.noise_from_residuals) {
    ScaleNoise();
    FORESIGHT_CHECK(SolveJointly());
    Summarize();
  }
  FORESIGHT_TRY(found_.covariance, CovarianceOfChain(found_.data, joint_, found_.state));
  found_.weakest = WeakestInWords(*found_.covariance);
  return {};
}

void ChainRunner::Summarize() {
  found_.images = FitsOfImages(found_.state, found_.data.corners);
  ResidualSummary corners, ranges;
  double sum_px = 0.0;
  for (const ImageFit& image : found_.images) {
    corners.count += 2 * image.corners;
    corners.rms += image.rms_px * image.rms_px * image.corners;
    sum_px += image.mean_px * image.corners;
  }
  double ranges_chi = 0.0;
  found_.lines.clear();
  for (const BoardHits& hits : found_.data.hits) {
    LineFit line;
    const std::string& pose = session_.poses[static_cast<std::size_t>(hits.pose)].name;
    line.source =
        hits.stop == BoardHits::kNone
            ? fmt::format("{}, sweep at {:.3f} s", pose, hits.returns.front().time_s)
            : fmt::format(
                  "{}, stop {:.6g} deg", pose,
                  DegreesFromRadians(found_.state.motor_rad[static_cast<std::size_t>(hits.stop)]));
    line.source += hits.on_b ? ", board B" : ", board A";
    line.returns = static_cast<int>(hits.returns.size());
    const std::vector<double> residuals = RangeResiduals(found_.data, found_.state, hits);
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      line.rms_m += residuals[i] * residuals[i] / line.returns;
      line.mean_m += residuals[i] / line.returns;
      ranges_chi += std::pow(residuals[i] / hits.returns[i].sigma_m, 2);
    }
    ranges.count += line.returns;
    ranges.rms += line.rms_m * line.returns;
    line.rms_m = std::sqrt(line.rms_m);
    found_.lines.push_back(line);
  }
  // Each unknown takes one residual's worth, of whichever kind: in proportion.
  const int unknowns = found_.fit ? found_.fit->unknowns : 0;
  const double free = 1.0 - static_cast<double>(unknowns) /
                                std::max(unknowns + 1, corners.count + ranges.count + unknowns);
  if (corners.count > 0) {
    const double sigma = found_.noise.corner_px;
    corners.chi_square = corners.rms / (sigma * sigma * corners.count * free);
    corners.rms = std::sqrt(corners.rms / corners.count);
    found_.mean_error_px = 2.0 * sum_px / corners.count;
  }
  if (ranges.count > 0) {
    ranges.chi_square = ranges_chi / (ranges.count * free);
    ranges.rms = std::sqrt(ranges.rms / ranges.count);
  }
  found_.corners = corners;
  found_.ranges = ranges;
}

/// A table of angles that is in use and does not fit is that of another head, or the motor was
/// taken apart.
void ChainRunner::CheckAgainstPrior() {
  constexpr double kMostDifference_rad = 0.0035;  // 0.2 deg
  const AngleCorrection& used = session_.prior.angle_correction;
  if (used.knots().empty()) return;
  const double zero = used.PlateAngle(0.0);
  for (std::size_t i = 0; i < found_.state.motor_rad.size(); ++i) {
    const double motor = found_.state.motor_rad[i];
    const double difference = found_.state.plate_rad[i] - (used.PlateAngle(motor) - zero);
    if (std::abs(difference) <= kMostDifference_rad) continue;
    found_.notes.push_back(fmt::format(
        "the table of angles that the session came with is {:.2f} deg off at the stop {:.6g} deg: "
        "it is that of another head, or the motor was changed",
        DegreesFromRadians(std::abs(difference)), DegreesFromRadians(motor)));
    return;
  }
}

Result<ChainCalibration> ChainRunner::Run() {
  FORESIGHT_CHECK(session_.Check());
  const MotorGraph graph = MakeMotorGraph(session_);
  if (options_.loose_stops == MotorCalibrationOptions::LooseStops::kLeaveOut &&
      graph.reference >= 0 && !graph.Complete()) {
    found_.notes.push_back("left out: " + graph.InWords(session_));
    session_ = WithoutLooseStops(session_, graph);
  }
  StopWatch watch;
  FORESIGHT_CHECK(Camera());
  found_.seconds.camera = watch.Lap();
  context_.Report(0.1, "camera and motor");
  FORESIGHT_CHECK(Motor());
  found_.seconds.motor = watch.Lap();
  const bool all = options_.stage == CalibrationStage::kAll;
  if (options_.stage != CalibrationStage::kMotor) {
    context_.Report(0.2, "camera and lidar");
    FORESIGHT_CHECK(Lidar());
    found_.seconds.lidar = watch.Lap();
  }
  const bool has_sweep =
      std::any_of(session_.poses.begin(), session_.poses.end(),
                  [](const PatternPose& pose) { return !pose.sweep.lines.empty(); });
  if (all && !has_sweep && !options_.as_in_the_paper)
    found_.notes.push_back(
        "the session has no sweep: the offset of the lidar's time stamps stays as it was");
  if (options_.stage == CalibrationStage::kTime ||
      (all && has_sweep && !options_.as_in_the_paper)) {
    context_.Report(0.5, "time offset");
    FORESIGHT_CHECK(Time());
    found_.seconds.time = watch.Lap();
  }
  if (all && !options_.as_in_the_paper) {
    context_.Report(0.7, "joint refinement");
    FORESIGHT_CHECK(Joint());
    found_.seconds.joint = watch.Lap();
  } else {
    Summarize();
  }
  CheckAgainstPrior();
  found_.rig = RigFrom(session_.prior, found_.state);
  if (options_.as_in_the_paper) {
    if (const auto paper = InPaperGauge(found_.rig.camera_from_head))
      found_.rig.camera_from_head = *paper;
    else
      found_.notes.push_back(paper.error().message);
  }
  FORESIGHT_CHECK(found_.rig.Check());
  return std::move(found_);
}

}  // namespace

Status ChainCalibrationOptions::Check() const {
  FORESIGHT_CHECK(noise.Check());
  if (!(range_sigma_m >= 0.0) || !(range_floor_m >= 0.0) || !(gate_sigmas >= 0.0))
    return Fail(ErrorCode::kInvalidOptions,
                "calibration: range_sigma_m {}, range_floor_m {} or gate_sigmas {} is negative",
                range_sigma_m, range_floor_m, gate_sigmas);
  return {};
}

Result<ChainCalibration> CalibrateChain(const CalibrationSession& session,
                                        const ChainCalibrationOptions& options,
                                        const RunContext& context) {
  FORESIGHT_CHECK(options.Check());
  return ChainRunner(session, options, context).Run();
}

}  // namespace foresight
