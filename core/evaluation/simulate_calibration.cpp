#include "core/evaluation/simulate_calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/contract.h"
#include "core/base/random.h"
#include "core/calibration/tangent.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

/// Streams of one seed.
enum Stream : std::uint64_t { kRig = 1, kViews, kPoses, kCorners, kLidar, kMotor };

Eigen::Vector3d RandomVector(Random& random, double sigma) {
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return sigma * Eigen::Vector3d(x, y, z);
}

/// A vector of this length in a random direction.
Eigen::Vector3d RandomOfLength(Random& random, double length) {
  return length * RandomVector(random, 1.0).normalized();
}

template <class To, class From>
Rigid<To, From> Disturbed(const Rigid<To, From>& rigid, Random& random, double turn_rad,
                          double shift_m) {
  Eigen::Matrix<double, 6, 1> step;
  step.head<3>() = RandomOfLength(random, turn_rad);
  step.tail<3>() = RandomOfLength(random, shift_m);
  return Perturbed(rigid, step);
}

double RollOf(CameraMount mount) {
  switch (mount) {
    case CameraMount::kNormal:
      return 0.0;
    case CameraMount::kPortrait:
      return 0.5 * std::numbers::pi;
    case CameraMount::kUpsideDown:
      return std::numbers::pi;
  }
  return 0.0;
}

/// A smooth error of the plate against the encoder: waves of once and twice a turn.
class PlateWaves {
 public:
  PlateWaves(Random& random, double amplitude_rad)
      : amplitude_(amplitude_rad),
        phase1_(random.Uniform(0.0, 2.0 * std::numbers::pi)),
        phase2_(random.Uniform(0.0, 2.0 * std::numbers::pi)) {}
  double PlateAngle(double motor_rad) const { return motor_rad + Error(motor_rad) - Error(0.0); }

 private:
  double Error(double motor_rad) const {
    return amplitude_ * (std::sin(motor_rad + phase1_) + 0.4 * std::sin(2.0 * motor_rad + phase2_));
  }
  double amplitude_, phase1_, phase2_;
};

/// A rectangle in space that stops beams.
struct Panel {
  Rigid<frame::Base, frame::Pattern> base_from_panel;
  Eigen::Vector2d low, high;  ///< its extent in x and y
};

class SessionMaker {
 public:
  explicit SessionMaker(const CalibrationSimulation& options);
  SimulatedCalibration Make();

 private:
  void MakeRig();
  void MakeViews();
  void MakePose(int index);
  static constexpr int kHingeRolls = 4;
  bool SweepsBefore(int index) const;
  Rigid<frame::Base, frame::Pattern> PlaceStand(Random& random, int index) const;
  std::optional<BoardView> See(const CalibrationBoard& board,
                               const Rigid<frame::Camera, frame::Pattern>& camera_from_board);
  std::vector<Panel> PanelsOf(const Rigid<frame::Base, frame::Pattern>& stand) const;
  /// Range of each beam without errors; `plate_rad` of each beam.
  std::vector<double> TrueRanges(const std::vector<Panel>& panels,
                                 const std::vector<double>& plate_rad) const;
  LidarLine Measure(const std::vector<double>& ranges, std::int64_t seq, double time_s);
  void Sweep(const std::vector<Panel>& panels, MountSweep* sweep);

  CalibrationSimulation options_;
  Random corners_, lidar_, motor_;
  PlateWaves waves_;
  SimulatedCalibration made_;
  SensorRig& truth_ = made_.truth;
  CalibrationSession& session_ = made_.session;
  std::vector<double> stops_rad_;
};

SessionMaker::SessionMaker(const CalibrationSimulation& options)
    : options_(options),
      corners_(options.seed, kCorners),
      lidar_(options.seed, kLidar),
      motor_(options.seed, kMotor),
      waves_(motor_, options.angle_error_rad) {
  for (double stop = options.first_stop_deg; stop <= options.last_stop_deg + 1e-6;
       stop += options.stop_step_deg)
    stops_rad_.push_back(RadiansFromDegrees(stop));
}

void SessionMaker::MakeRig() {
  Random random(options_.seed, kRig);
  truth_ = DefaultSensorRig();
  truth_.name = fmt::format("simulated {}", options_.seed);
  CameraModel& camera = truth_.camera;
  camera.fx += 5.0 * random.Normal();
  camera.fy = camera.fx * (1.0 + 0.001 * random.Normal());
  camera.cx += 4.0 * random.Normal();
  camera.cy += 4.0 * random.Normal();
  camera.lens = FisheyeLens{0.9413 + 0.01 * random.Normal()};

  const Rigid<frame::Camera, frame::Camera> roll(
      Eigen::Quaterniond(Eigen::AngleAxisd(RollOf(options_.mount), Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d::Zero());
  const auto drawn_head = roll * truth_.camera_from_head;
  const auto drawn_lidar = roll * truth_.camera_from_lidar;
  truth_.camera_from_head =
      Disturbed(drawn_head, random, options_.rig_error_rad, options_.rig_error_m);
  truth_.camera_from_lidar =
      Disturbed(drawn_lidar, random, options_.rig_error_rad, options_.rig_error_m);
  truth_.lidar.range_offset_m = -options_.range_bias_m;
  truth_.lidar.stamp_offset_s = options_.stamp_offset_s;
  std::vector<AngleCorrection::Knot> knots;
  for (const double stop : stops_rad_) knots.push_back({stop, waves_.PlateAngle(stop)});
  truth_.angle_correction = *AngleCorrection::FromKnots(std::move(knots));

  session_.prior = DefaultSensorRig();
  session_.prior.name = truth_.name + ", drawn";
  session_.prior.camera_from_head =
      Disturbed(truth_.camera_from_head, random, options_.prior_error_rad, options_.prior_error_m);
  session_.prior.camera_from_lidar =
      Disturbed(truth_.camera_from_lidar, random, options_.prior_error_rad, options_.prior_error_m);

  session_.name = truth_.name;
  session_.mount = DefaultBoardMount();
  if (options_.distinct_boards) {
    CalibrationBoard a = session_.mount.a, b = session_.mount.a;
    a.columns = 9;
    b.columns = 7;
    session_.mount = HingedMount(a, b, kHinge_m);
  }
  session_.intrinsic_board = session_.mount.a;
  Eigen::Matrix<double, 6, 1> error = Eigen::Matrix<double, 6, 1>::Zero();
  error.head<3>() = RandomVector(random, options_.dihedral_error_rad);
  error.tail<3>() = RandomVector(random, 0.3 * options_.dihedral_error_rad);  // on a lever of 0.3 m
  made_.a_from_b = Perturbed(session_.mount.a_from_b, error);
}

std::optional<BoardView> SessionMaker::See(
    const CalibrationBoard& board, const Rigid<frame::Camera, frame::Pattern>& camera_from_board) {
  constexpr double kMargin_px = 3.0;
  const Eigen::Vector3d centre = 0.5 * (board.Corner(0) + board.Corner(board.CornerCount() - 1));
  const Eigen::Vector3d sight = (camera_from_board * centre).normalized();
  constexpr double kLeastCosine = 0.26;  // steeper than 75 deg nobody finds corners
  if (camera_from_board.Rotate(Eigen::Vector3d::UnitZ()).dot(sight) < kLeastCosine)
    return std::nullopt;
  BoardView view;
  for (int id = 0; id < board.CornerCount(); ++id) {
    const auto pixel = truth_.camera.Project(camera_from_board * board.Corner(id));
    if (!pixel) return std::nullopt;
    if (pixel->x() < kMargin_px || pixel->y() < kMargin_px ||
        pixel->x() > truth_.camera.width - 1 - kMargin_px ||
        pixel->y() > truth_.camera.height - 1 - kMargin_px)
      return std::nullopt;
    view.corner_ids.push_back(id);
    view.pixels.push_back(*pixel);
  }
  for (Eigen::Vector2d& pixel : view.pixels) {
    const double u = corners_.Normal(), v = corners_.Normal();
    pixel += options_.corner_sigma_px * Eigen::Vector2d(u, v);
  }
  return view;
}

void SessionMaker::MakeViews() {
  Random random(options_.seed, kViews);
  const CalibrationBoard& board = session_.intrinsic_board;
  const Eigen::Vector3d centre = 0.5 * (board.Corner(0) + board.Corner(board.CornerCount() - 1));
  for (int tries = 0; static_cast<int>(session_.intrinsic_views.size()) < options_.intrinsic_views;
       ++tries) {
    if (tries > 100000) return;
    const Eigen::Vector2d pixel(random.Uniform(0.05, 0.95) * truth_.camera.width,
                                random.Uniform(0.05, 0.95) * truth_.camera.height);
    const auto ray = truth_.camera.Unproject(pixel);
    const double distance_m = random.Uniform(0.35, 0.9);
    const double tilt_x = random.Uniform(-0.6, 0.6), tilt_y = random.Uniform(-0.6, 0.6);
    const double roll = random.Uniform(-std::numbers::pi, std::numbers::pi);
    if (!ray) continue;
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), *ray) *
        RotationExp({tilt_x, tilt_y, 0.0}) * RotationExp({0.0, 0.0, roll});
    const Rigid<frame::Camera, frame::Pattern> pose(rotation,
                                                    distance_m * *ray - rotation * centre);
    auto view = See(board, pose);
    if (!view) continue;
    session_.intrinsic_views.push_back(
        {fmt::format("view {}", session_.intrinsic_views.size() + 1), std::move(*view)});
    made_.camera_from_view.push_back(pose);
  }
}

// A vertical hinge says nothing of time: where a beam hits its boards higher or lower the range is
// the same. Poses with a level hinge come first.
bool SessionMaker::SweepsBefore(int index) const {
  int before = 0;
  for (const int roll : {1, 2, 3, 0})
    for (int pose = roll; pose < options_.poses; pose += kHingeRolls) {
      if (pose == index) return before < options_.sweeps;
      ++before;
    }
  return false;
}

Rigid<frame::Base, frame::Pattern> SessionMaker::PlaceStand(Random& random, int index) const {
  // Elevations are spread evenly; rolls of the hinge take turns.
  const double low = options_.first_stop_deg + 15.0, high = options_.last_stop_deg - 15.0;
  const double part = (index + 0.5) / std::max(1, options_.poses);
  const double elevation =
      RadiansFromDegrees(low + part * (high - low) + random.Uniform(-5.0, 5.0));
  const double azimuth = RadiansFromDegrees(random.Uniform(-15.0, 15.0));
  constexpr double kRolls_deg[kHingeRolls] = {0.0, 90.0, 45.0, -45.0};
  const double roll =
      RadiansFromDegrees(kRolls_deg[index % kHingeRolls] + random.Uniform(-8.0, 8.0));
  const Eigen::Vector3d tilt(RadiansFromDegrees(random.Uniform(-20.0, 20.0)),
                             RadiansFromDegrees(random.Uniform(-20.0, 20.0)), 0.0);
  const double distance_m = random.Uniform(options_.least_distance_m, options_.most_distance_m);
  // In a frame that looks at the stand: z ahead, the bisector of the two boards against it.
  const Eigen::Vector3d ahead = RotationExp({elevation, 0.0, 0.0}) *
                                (RotationExp({0.0, azimuth, 0.0}) * Eigen::Vector3d::UnitZ());
  const Eigen::Quaterniond look =
      RotationExp({elevation, 0.0, 0.0}) * RotationExp({0.0, azimuth, 0.0});
  // The open book: board A turned by 45 deg so that its hinge is the farthest from the viewer.
  const Eigen::Quaterniond open = RotationExp({0.0, -0.25 * std::numbers::pi, 0.0});
  const Eigen::Quaterniond rotation =
      look * RotationExp(tilt) * RotationExp({0.0, 0.0, roll}) * open;
  const CalibrationBoard& a = session_.mount.a;
  const Eigen::Vector3d middle_of_hinge(made_.a_from_b.translation().x(),
                                        0.5 * (a.rows - 1) * a.square_m, 0.0);
  const Eigen::Vector3d toward(0.0, 0.0, -0.15);  // the stand's middle lies before the hinge
  const Eigen::Vector3d centre = middle_of_hinge + open.conjugate() * toward;
  return {rotation, distance_m * ahead - rotation * centre};
}

std::vector<Panel> SessionMaker::PanelsOf(const Rigid<frame::Base, frame::Pattern>& stand) const {
  std::vector<Panel> panels;
  const auto add_board = [&](const CalibrationBoard& board,
                             const Rigid<frame::Base, frame::Pattern>& pose) {
    const double s = board.square_m;
    panels.push_back({pose, {-s, -s}, {board.columns * s, board.rows * s}});
  };
  add_board(session_.mount.a, stand);
  if (session_.mount.b) add_board(*session_.mount.b, stand * made_.a_from_b);
  // The room: 6 m by 5 m, 3 m high, the head 1.4 m above the floor and 2 m from the wall behind.
  const auto add_wall = [&](const Eigen::Vector3d& at, const Eigen::Vector3d& normal) {
    panels.push_back({{Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal), at},
                      {-20.0, -20.0},
                      {20.0, 20.0}});
  };
  add_wall({0.0, 0.0, 4.0}, {0.0, 0.0, 1.0});
  add_wall({0.0, 0.0, -2.0}, {0.0, 0.0, 1.0});
  add_wall({2.5, 0.0, 0.0}, {1.0, 0.0, 0.0});
  add_wall({-2.5, 0.0, 0.0}, {1.0, 0.0, 0.0});
  add_wall({0.0, 1.4, 0.0}, {0.0, 1.0, 0.0});
  add_wall({0.0, -1.6, 0.0}, {0.0, 1.0, 0.0});
  return panels;
}

std::vector<double> SessionMaker::TrueRanges(const std::vector<Panel>& panels,
                                             const std::vector<double>& plate_rad) const {
  const LidarModel& lidar = truth_.lidar;
  const auto head_from_lidar = truth_.HeadFromLidar();
  std::vector<double> ranges(static_cast<std::size_t>(lidar.beams),
                             std::numeric_limits<double>::infinity());
  for (const Panel& panel : panels) {
    const auto panel_from_base = panel.base_from_panel.Inverse();
    Rigid<frame::Pattern, frame::Lidar> panel_from_lidar;
    double of_rad = std::nan("");
    for (int beam = 0; beam < lidar.beams; ++beam) {
      const auto i = static_cast<std::size_t>(beam);
      if (plate_rad[i] != of_rad) {
        of_rad = plate_rad[i];
        panel_from_lidar = panel_from_base * HeadFromBase(of_rad).Inverse() * head_from_lidar;
      }
      const Eigen::Vector3d direction = panel_from_lidar.Rotate(lidar.BeamDirection(beam));
      const Eigen::Vector3d& from = panel_from_lidar.translation();
      const double range = -from.z() / direction.z();
      if (!(range > lidar.min_range_m) || range >= ranges[i]) continue;
      const Eigen::Vector2d hit = (from + range * direction).head<2>();
      if ((hit.array() < panel.low.array()).any() || (hit.array() > panel.high.array()).any())
        continue;
      ranges[i] = range;
    }
  }
  return ranges;
}

LidarLine SessionMaker::Measure(const std::vector<double>& ranges, std::int64_t seq,
                                double time_s) {
  constexpr double kEdge_m = 0.1;
  const LidarModel& lidar = truth_.lidar;
  LidarLine line{.seq = seq, .time_s = time_s, .range_mm = {}, .intensity = {}};
  line.range_mm.reserve(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    double range = ranges[i];
    if (i + 1 < ranges.size() && std::abs(ranges[i + 1] - range) > kEdge_m &&
        lidar_.Uniform() < options_.mixed_pixel_ratio)
      range += lidar_.Uniform() * (ranges[i + 1] - range);
    if (lidar_.Uniform() < options_.spike_ratio) range = lidar_.Uniform(0.3, 10.0);
    range += options_.range_bias_m + options_.range_sigma_m * lidar_.Normal();
    const bool seen =
        std::isfinite(range) && range > lidar.min_range_m && range < lidar.max_range_m;
    line.range_mm.push_back(seen ? static_cast<std::uint16_t>(std::lround(1000.0 * range)) : 1);
  }
  return line;
}

void SessionMaker::Sweep(const std::vector<Panel>& panels, MountSweep* sweep) {
  const double speed = RadiansFromDegrees(options_.sweep_speed_deg_s);
  const double low = stops_rad_.front(), high = stops_rad_.back();
  const double half_s = (high - low) / speed;
  const double duration_s = options_.one_way_sweep ? half_s : 2.0 * half_s;
  const auto motor_at = [&](double t) {
    const double way = std::clamp(t, 0.0, duration_s) * speed;
    return way <= high - low ? low + way : high - (way - (high - low));
  };
  constexpr double kEncoderStep_rad = 0.0003490658503988659, kSample_s = 0.005, kAround_s = 0.1;
  std::vector<MotorSample> samples;
  for (double t = -kAround_s; t <= duration_s + kAround_s; t += kSample_s)
    samples.push_back({t, kEncoderStep_rad * std::round(motor_at(t) / kEncoderStep_rad)});
  sweep->track = *MotorTrack::FromSamples(std::move(samples));
  const LidarModel& lidar = truth_.lidar;
  std::vector<double> plate_rad(static_cast<std::size_t>(lidar.beams));
  const int lines = static_cast<int>(duration_s / lidar.period_s);
  for (int seq = 0; seq < lines; ++seq) {
    const double time_s = seq * lidar.period_s;
    for (int beam = 0; beam < lidar.beams; ++beam)
      plate_rad[static_cast<std::size_t>(beam)] =
          truth_.angle_correction.PlateAngle(motor_at(time_s + lidar.BeamTime(beam)));
    sweep->lines.push_back(Measure(TrueRanges(panels, plate_rad), seq, time_s));
  }
}

void SessionMaker::MakePose(int index) {
  Random random(options_.seed, kPoses + 100 * static_cast<std::uint64_t>(index + 1));
  const Rigid<frame::Base, frame::Pattern> stand = PlaceStand(random, index);
  made_.base_from_pattern.push_back(stand);
  const std::vector<Panel> panels = PanelsOf(stand);
  made_.camera_from_stand.emplace_back();
  PatternPose pose;
  pose.name = fmt::format("pose {}", index + 1);
  for (const double motor_rad : stops_rad_) {
    const double plate_rad = truth_.angle_correction.PlateAngle(motor_rad) +
                             options_.repeatability_rad * motor_.Normal();
    MotorStop stop;
    stop.motor_rad = motor_rad;
    const auto camera_from_stand = truth_.camera_from_head * HeadFromBase(plate_rad) * stand;
    stop.view.a = See(session_.mount.a, camera_from_stand);
    if (session_.mount.b) stop.view.b = See(*session_.mount.b, camera_from_stand * made_.a_from_b);
    const std::vector<double> ranges = TrueRanges(
        panels, std::vector<double>(static_cast<std::size_t>(truth_.lidar.beams), plate_rad));
    for (int scan = 0; scan < options_.scans_per_stop; ++scan)
      stop.lines.push_back(Measure(ranges, scan, scan * truth_.lidar.period_s));
    if (stop.view.empty() && stop.lines.empty()) continue;
    pose.stops.push_back(std::move(stop));
    made_.camera_from_stand.back().push_back(camera_from_stand);
  }
  if (SweepsBefore(index)) Sweep(panels, &pose.sweep);
  session_.poses.push_back(std::move(pose));
}

SimulatedCalibration SessionMaker::Make() {
  MakeRig();
  MakeViews();
  for (int pose = 0; pose < options_.poses; ++pose) MakePose(pose);
  return std::move(made_);
}

}  // namespace

std::string_view ToString(CameraMount mount) {
  switch (mount) {
    case CameraMount::kNormal:
      return "normal";
    case CameraMount::kPortrait:
      return "portrait";
    case CameraMount::kUpsideDown:
      return "upside-down";
  }
  return "normal";
}

Status CalibrationSimulation::Check() const {
  const auto fail = [](const char* name, double value, const char* range) {
    return Fail(ErrorCode::kInvalidOptions, "simulated calibration: {} {} is not {}", name, value,
                range);
  };
  if (intrinsic_views < 0 || intrinsic_views > 500)
    return fail("intrinsic_views", intrinsic_views, "between 0 and 500");
  if (poses < 0 || poses > 100) return fail("poses", poses, "between 0 and 100");
  if (scans_per_stop < 0 || scans_per_stop > 1000)
    return fail("scans_per_stop", scans_per_stop, "between 0 and 1000");
  if (sweeps < 0 || sweeps > 100) return fail("sweeps", sweeps, "between 0 and 100");
  if (!(stop_step_deg >= 0.5)) return fail("stop_step_deg", stop_step_deg, "0.5 or more");
  if (!(first_stop_deg >= -180.0)) return fail("first_stop_deg", first_stop_deg, "-180 or more");
  if (!(last_stop_deg > first_stop_deg) || last_stop_deg > 180.0)
    return fail("last_stop_deg", last_stop_deg, "above first_stop_deg and 180 at most");
  if (!(sweep_speed_deg_s >= 1.0) || sweep_speed_deg_s > 360.0)
    return fail("sweep_speed_deg_s", sweep_speed_deg_s, "between 1 and 360");
  if (!(least_distance_m > 0.3) || !(most_distance_m >= least_distance_m) || most_distance_m > 20.0)
    return fail("least_distance_m", least_distance_m, "over 0.3 and at most most_distance_m");
  for (const auto& [name, value] :
       {std::pair<const char*, double>("corner_sigma_px", corner_sigma_px),
        {"range_sigma_m", range_sigma_m},
        {"repeatability_rad", repeatability_rad},
        {"angle_error_rad", angle_error_rad},
        {"dihedral_error_rad", dihedral_error_rad},
        {"rig_error_rad", rig_error_rad},
        {"rig_error_m", rig_error_m},
        {"prior_error_rad", prior_error_rad},
        {"prior_error_m", prior_error_m}})
    if (!(value >= 0.0) || value > 100.0) return fail(name, value, "0 or more");
  if (!(std::abs(range_bias_m) <= 1.0)) return fail("range_bias_m", range_bias_m, "within 1 m");
  if (!(std::abs(stamp_offset_s) <= 0.05))
    return fail("stamp_offset_s", stamp_offset_s, "within 50 ms");
  if (!(spike_ratio >= 0.0) || spike_ratio > 1.0)
    return fail("spike_ratio", spike_ratio, "between 0 and 1");
  if (!(mixed_pixel_ratio >= 0.0) || mixed_pixel_ratio > 1.0)
    return fail("mixed_pixel_ratio", mixed_pixel_ratio, "between 0 and 1");
  return {};
}

Result<SimulatedCalibration> SimulateCalibration(const CalibrationSimulation& options) {
  FORESIGHT_CHECK(options.Check());
  return SessionMaker(options).Make();
}

Eigen::VectorXd DeviationsFromTruth(const ChainCalibration& found,
                                    const SimulatedCalibration& truth) {
  FORESIGHT_EXPECTS(found.covariance.has_value(), "a joint calibration");
  std::map<std::string, double> by_name;
  const CameraModel::Parameters camera = found.state.camera.Values() - truth.truth.camera.Values();
  const auto names = truth.truth.camera.ParameterNames();
  for (std::size_t i = 0; i < names.size(); ++i)
    by_name[std::string(names[i])] = camera[static_cast<Eigen::Index>(i)];

  // The true axis where it crosses the plane x = 0 of the head that was found.
  const auto head_from_camera = found.state.camera_from_head.Inverse();
  const auto head_from_true = head_from_camera * truth.truth.camera_from_head;
  const Eigen::Vector3d axis = head_from_true.Rotate(Eigen::Vector3d::UnitX());
  const Eigen::Vector3d crossing =
      head_from_true.translation() - axis * (head_from_true.translation().x() / axis.x());
  by_name["axis turn y"] = axis.z();
  by_name["axis turn z"] = -axis.y();
  by_name["axis shift y"] = -crossing.y();
  by_name["axis shift z"] = -crossing.z();

  const auto add_step = [&by_name](const std::string& name,
                                   const Eigen::Matrix<double, 6, 1>& step) {
    for (int i = 0; i < 6; ++i)
      by_name[fmt::format("{} {} {}", name, i < 3 ? "turn" : "shift", "xyz"[i % 3])] = step[i];
  };
  add_step("board B", StepBetween(truth.a_from_b, found.state.a_from_b));
  add_step("lidar", StepBetween(truth.truth.camera_from_lidar, found.state.camera_from_lidar));
  by_name["range offset"] = found.state.range_offset_m - truth.truth.lidar.range_offset_m;
  by_name["stamp offset"] = found.state.stamp_offset_s - truth.truth.lidar.stamp_offset_s;
  for (std::size_t stop = 0; stop < found.state.motor_rad.size(); ++stop) {
    const double motor = found.state.motor_rad[stop];
    by_name[fmt::format("plate angle at {:.6g} deg", DegreesFromRadians(motor))] =
        found.state.plate_rad[stop] - truth.truth.angle_correction.PlateAngle(motor);
  }
  Eigen::VectorXd deviations(static_cast<Eigen::Index>(found.covariance->unknowns.size()));
  for (Eigen::Index i = 0; i < deviations.size(); ++i)
    deviations[i] = by_name.at(found.covariance->unknowns[static_cast<std::size_t>(i)].name);
  return deviations;
}

}  // namespace foresight
