#include "core/simulation/lidar_simulator.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/simulation/noise_stream.h"

namespace foresight {
namespace {

constexpr int kMostLayers = 4;        ///< of translucent things, one behind the other
constexpr float kBehind_m = 0.0005f;  ///< where the light goes on behind a surface

}  // namespace

/// Directions spread evenly over the footprint of a beam along x, unit length.
std::vector<LidarSimulator::FootprintRay> LidarSimulator::FootprintOf(const LidarNoise& noise) {
  if (!noise.enabled) return {{Eigen::Vector3d::UnitX(), 1.0}};
  const int n = noise.footprint_side;
  const bool gaussian = noise.footprint == LidarNoise::Footprint::kGaussian;
  std::vector<FootprintRay> rays;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = (i + 0.5) / n - 0.5, v = (j + 0.5) / n - 0.5;
      const double across = u * noise.footprint_horizontal_rad;
      const double along_spin = v * noise.footprint_vertical_rad;
      // The deviation is half of a half side: 0.25 in u and v.
      const double weight = gaussian ? std::exp(-8.0 * (u * u + v * v)) : 1.0;
      rays.push_back({Eigen::Vector3d(1.0, across, along_spin).normalized(), weight});
      sum += weight;
    }
  }
  for (FootprintRay& ray : rays) ray.divisor = sum / ray.divisor;
  return rays;
}

LidarSimulator::LidarSimulator(const RayCaster& caster, const SensorRig& true_rig,
                               const LidarNoise& noise, std::uint64_t seed)
    : caster_(caster),
      lidar_(true_rig.lidar),
      head_from_lidar_(true_rig.HeadFromLidar()),
      robot_from_base_(true_rig.robot_from_base),
      noise_(noise),
      seed_(seed),
      footprint_(FootprintOf(noise)) {}

std::vector<SceneRay> LidarSimulator::RaysOfLine(
    double time_s, const std::function<double(double)>& plate_rad_at) const {
  std::vector<SceneRay> rays;
  rays.reserve(static_cast<std::size_t>(lidar_.beams) * footprint_.size());
  for (int beam = 0; beam < lidar_.beams; ++beam) {
    const double plate_rad = plate_rad_at(time_s + lidar_.BeamTime(beam));
    const Rigid<frame::Robot, frame::Lidar> robot_from_lidar =
        robot_from_base_ * HeadFromBase(plate_rad).Inverse() * head_from_lidar_;
    const Eigen::Matrix3d robot_from_beam =
        robot_from_lidar.RotationMatrix() *
        Eigen::AngleAxisd(lidar_.BeamAngle(beam), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (const FootprintRay& ray : footprint_)
      rays.push_back({robot_from_lidar.translation().cast<float>(),
                      (robot_from_beam * ray.direction).cast<float>()});
  }
  return rays;
}

double LidarSimulator::ReturnPower(const SceneRay& ray, const SceneHit& hit) const {
  const Material& material = caster_.scene().meshes[static_cast<std::size_t>(hit.mesh)].material;
  const double cosine = -static_cast<double>(hit.normal.dot(ray.direction));
  // A mirror sends its fraction back only where the beam intersects it within a few degrees of its
  // normal.
  const double mirrored = material.specular * std::pow(cosine, 200.0);
  const double diffuse = (1.0 - material.specular) * material.lidar_reflectance * cosine;
  const double range = hit.distance_m;
  // Never zero, so that even a black surface has a range to weight.
  return std::max(1e-12, (diffuse + mirrored) / (range * range));
}

LidarSimulator::Echo LidarSimulator::ReturnOf(const SceneRay& ray, const SceneHit& hit,
                                              double divisor) const {
  Echo echo{hit.distance_m, ReturnPower(ray, hit) / divisor};
  if (!noise_.enabled) return echo;
  const Material& material = caster_.scene().meshes[static_cast<std::size_t>(hit.mesh)].material;
  echo.range_m +=
      material.penetration_m + noise_.walk_of_black_m * (1.0 - material.lidar_reflectance);
  return echo;
}

void LidarSimulator::AddReturns(const SceneRay& ray, const SceneHit& hit, double divisor,
                                std::vector<Echo>& returns) const {
  SceneHit at = hit;
  double arriving = 1.0;
  for (int layer = 0; layer < kMostLayers && at.mesh >= 0; ++layer) {
    Echo echo = ReturnOf(ray, at, divisor);
    const double through =
        noise_.enabled
            ? caster_.scene().meshes[static_cast<std::size_t>(at.mesh)].material.translucency
            : 0.0;
    if (through <= 0.0 && layer == 0) {
      returns.push_back(echo);
      return;
    }
    echo.power *= arriving * (1.0 - through);
    returns.push_back(echo);
    if (through <= 0.0) return;
    // The light crosses the surface once more on its way back.
    arriving *= through * through;
    const float from_m = at.distance_m + kBehind_m;
    at = caster_.Cast({ray.origin + from_m * ray.direction, ray.direction});
    at.distance_m += from_m;
  }
}

double LidarSimulator::RangeError(double normal, Random& random) const {
  if (noise_.tail_degrees == 0) return normal;
  double squares = 0.0;
  for (int i = 0; i < noise_.tail_degrees; ++i) {
    const double draw = random.Normal();
    squares += draw * draw;
  }
  return normal * std::sqrt(noise_.tail_degrees / std::max(squares, 1e-9));
}

std::optional<LidarSimulator::Echo> LidarSimulator::StrongestEcho(
    std::vector<Echo>& returns) const {
  std::sort(returns.begin(), returns.end(),
            [](const Echo& a, const Echo& b) { return a.range_m < b.range_m; });
  std::optional<Echo> strongest;
  for (std::size_t i = 0; i < returns.size();) {
    // The receiver cannot tell apart what falls into one pulse: a range in between, a mixed pixel.
    const double nearest_m = returns[i].range_m;
    const double pulse_end_m = nearest_m + noise_.pulse_length_m;
    Echo echo;
    for (; i < returns.size() && returns[i].range_m <= pulse_end_m; ++i) {
      echo.range_m += returns[i].power * returns[i].range_m;
      echo.power += returns[i].power;
    }
    echo.range_m /= echo.power;
    if (noise_.leading_edge > 0.0) echo.range_m += noise_.leading_edge * (nearest_m - echo.range_m);
    if (!strongest || echo.power > strongest->power) strongest = echo;
  }
  return strongest;
}

std::optional<LidarSimulator::Echo> LidarSimulator::AddNoise(const std::optional<Echo>& echo,
                                                             Random& random) const {
  // Always the same number of draws: what one beam intersects does not shift the noise of the next.
  const double range_error = RangeError(random.Normal(), random);
  const double power_error = random.Normal();
  const bool spurious = random.Uniform() < noise_.spurious_fraction;
  const double spurious_range = random.Uniform(lidar_.min_range_m, lidar_.max_range_m);
  if (spurious) return Echo{spurious_range, noise_.dropout_power};
  if (!echo || !(echo->power > noise_.dropout_power)) return std::nullopt;
  const double weakness = noise_.dropout_power / echo->power;
  const double sigma = std::hypot(noise_.sigma_base_m + noise_.sigma_per_metre * echo->range_m,
                                  noise_.sigma_at_threshold_m * weakness);
  return Echo{echo->range_m + sigma * range_error + noise_.walk_at_threshold_m * weakness,
              echo->power * std::exp(0.03 * power_error)};
}

LidarSimulator::Reading LidarSimulator::Report(const std::optional<Echo>& echo) const {
  if (!echo || echo->range_m > lidar_.max_range_m) return {kNoEcho, 0};
  if (echo->range_m < lidar_.min_range_m) return {kTooNear, 0};
  const double range_mm = std::round(1e3 * (echo->range_m - lidar_.range_offset_m));
  // The device compresses: a white sheet gives 400 at 30 m and 10000 at 1.2 m.
  const double intensity = std::round(400.0 * std::sqrt(echo->power / noise_.dropout_power));
  return {static_cast<std::uint16_t>(
              std::clamp(range_mm, double{LidarLine::kFirstValidRange_mm}, 65535.0)),
          static_cast<std::uint16_t>(std::clamp(intensity, 1.0, 65535.0))};
}

LidarLine LidarSimulator::Measure(std::int64_t seq, double time_s,
                                  const std::function<double(double)>& plate_rad_at) const {
  const std::vector<SceneRay> rays = RaysOfLine(time_s, plate_rad_at);
  std::vector<SceneHit> hits(rays.size());
  caster_.Cast(rays, hits);

  LidarLine line;
  line.seq = seq;
  line.time_s = time_s;
  Random random = NoiseStream(seed_, NoisePurpose::kLidarLine, seq);
  std::vector<Echo> returns;
  for (std::size_t first = 0; first < rays.size(); first += footprint_.size()) {
    returns.clear();
    for (std::size_t i = 0; i < footprint_.size(); ++i)
      if (hits[first + i].mesh >= 0)
        AddReturns(rays[first + i], hits[first + i], footprint_[i].divisor, returns);
    std::optional<Echo> echo = StrongestEcho(returns);
    if (noise_.enabled) echo = AddNoise(echo, random);
    const Reading reading = Report(echo);
    line.range_mm.push_back(reading.range_mm);
    line.intensity.push_back(reading.intensity);
  }
  return line;
}

}  // namespace foresight
