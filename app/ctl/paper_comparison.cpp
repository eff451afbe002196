#include "app/ctl/paper_comparison.h"

#include <cmath>

#include "app/ctl/calibration_report.h"
#include "app/ctl/command.h"
#include "core/geometry/angles.h"

namespace foresight {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double SigmaOf(const ChainCalibration& found, const std::string& name, double scale) {
  const int at = found.covariance ? found.covariance->Find(name) : -1;
  return at < 0 ? kNone : scale * found.covariance->Sigma(at);
}

class Comparison {
 public:
  Comparison(const ChainCalibration& ours, const ChainCalibration& paper)
      : ours_(ours), paper_(paper) {}

  std::vector<ComparedValue> Make() {
    AddFit();
    AddCamera();
    AddAxis();
    AddAngles();
    AddLidar();
    return std::move(values_);
  }

 private:
  void Add(const std::string& name, const char* unit, double ours, double sigma, double paper) {
    values_.push_back({name, unit, ours, sigma, paper});
  }

  void AddFit() {
    const auto seconds = [](const ChainCalibration& c) {
      return c.seconds.camera + c.seconds.motor + c.seconds.lidar + c.seconds.time +
             c.seconds.joint;
    };
    Add("mean error of the corners", "px", ours_.mean_error_px, kNone, paper_.mean_error_px);
    if (ours_.ranges.count > 0 && paper_.ranges.count > 0)
      Add("lidar along the beams, rms", "mm", 1000.0 * ours_.ranges.rms, kNone,
          1000.0 * paper_.ranges.rms);
    Add("time of the solves", "s", seconds(ours_), kNone, seconds(paper_));
  }

  void AddCamera() {
    const auto names = ours_.rig.camera.ParameterNames();
    const bool same = names == paper_.rig.camera.ParameterNames();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const std::string name(names[i]);
      Add(name, i < 4 ? "px" : "", ours_.rig.camera.Values()[at], SigmaOf(ours_, name, 1.0),
          same ? paper_.rig.camera.Values()[at] : kNone);
    }
  }

  void AddAxis() {
    const auto axis_of = [](const ChainCalibration& c) {
      return c.rig.camera_from_head.Rotate(Eigen::Vector3d::UnitX());
    };
    const Eigen::Vector3d ours = axis_of(ours_), paper = axis_of(paper_);
    const double angle = std::atan2(ours.cross(paper).norm(), ours.dot(paper));
    Add("direction of the motor's axis", "deg", 0.0,
        std::hypot(SigmaOf(ours_, "axis turn y", 1.0), SigmaOf(ours_, "axis turn z", 1.0)) *
            DegreesFromRadians(1.0),
        DegreesFromRadians(angle));
    const double off = (AxisPoint(ours_.rig) - AxisPoint(paper_.rig)).norm();
    Add("place of the motor's axis", "mm", 0.0,
        1000.0 *
            std::hypot(SigmaOf(ours_, "axis shift y", 1.0), SigmaOf(ours_, "axis shift z", 1.0)),
        1000.0 * off);
  }

  void AddAngles() {
    for (const auto& knot : ours_.rig.angle_correction.knots()) {
      const double degrees = DegreesFromRadians(knot.motor_rad);
      const std::string name = fmt::format("plate angle at {:.6g} deg", degrees);
      Add(name, "deg", DegreesFromRadians(knot.plate_rad),
          SigmaOf(ours_, name, DegreesFromRadians(1.0)),
          DegreesFromRadians(paper_.rig.angle_correction.PlateAngle(knot.motor_rad)));
    }
  }

  void AddLidar() {
    if (ours_.ranges.count == 0 || paper_.ranges.count == 0) return;
    const Eigen::Vector3d ours = 1000.0 * ours_.rig.camera_from_lidar.translation();
    const Eigen::Vector3d paper = 1000.0 * paper_.rig.camera_from_lidar.translation();
    const Eigen::Quaterniond turn = ours_.rig.camera_from_lidar.rotation().conjugate() *
                                    paper_.rig.camera_from_lidar.rotation();
    double turn_sigma = 0.0, shift_sigma = 0.0;  // the shifts' are along the lidar's axes
    for (const char axis : {'x', 'y', 'z'}) {
      turn_sigma = std::hypot(
          turn_sigma, SigmaOf(ours_, fmt::format("lidar turn {}", axis), DegreesFromRadians(1.0)));
      shift_sigma =
          std::hypot(shift_sigma, SigmaOf(ours_, fmt::format("lidar shift {}", axis), 1000.0));
    }
    Add("turn of the lidar", "deg", 0.0, turn_sigma,
        DegreesFromRadians(Eigen::AngleAxisd(turn).angle()));
    Add("place of the lidar", "mm", 0.0, shift_sigma, (ours - paper).norm());
    Add("range offset", "mm", 1000.0 * ours_.rig.lidar.range_offset_m,
        SigmaOf(ours_, "range offset", 1000.0), kNone);
    Add("stamp offset", "ms", 1000.0 * ours_.rig.lidar.stamp_offset_s,
        SigmaOf(ours_, "stamp offset", 1000.0), kNone);
  }

  const ChainCalibration& ours_;
  const ChainCalibration& paper_;
  std::vector<ComparedValue> values_;
};

std::string Number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4f}", value) : "-";
}

double InSigmas(const ComparedValue& value) {
  return (value.paper - value.ours) / value.sigma;
}

std::string NameOf(const ComparedValue& value) {
  return value.unit.empty() ? value.name : fmt::format("{} [{}]", value.name, value.unit);
}

}  // namespace

std::vector<ComparedValue> CompareWithPaper(const ChainCalibration& ours,
                                            const ChainCalibration& paper) {
  return Comparison(ours, paper).Make();
}

nlohmann::ordered_json ToJson(const std::vector<ComparedValue>& values) {
  auto json = nlohmann::ordered_json::array();
  for (const ComparedValue& value : values)
    json.push_back({{"name", value.name},
                    {"unit", value.unit},
                    {"ours", FiniteOrNull(value.ours)},
                    {"sigma", FiniteOrNull(value.sigma)},
                    {"paper", FiniteOrNull(value.paper)},
                    {"difference", FiniteOrNull(value.paper - value.ours)},
                    {"difference_in_sigmas", FiniteOrNull(InSigmas(value))}});
  return json;
}

std::string Describe(const std::vector<ComparedValue>& values) {
  std::string text =
      fmt::format("{:<34}{:>12}{:>10}{:>12}{:>10}", "", "ours", "sigma", "paper", "sigmas");
  for (const ComparedValue& value : values) {
    const double sigmas = InSigmas(value);
    text += fmt::format("\n{:<34}{:>12}{:>10}{:>12}{:>10}", NameOf(value), Number(value.ours),
                        Number(value.sigma), Number(value.paper),
                        std::isfinite(sigmas) ? fmt::format("{:+.1f}", sigmas) : "");
  }
  return text;
}

HtmlReport::Table TableOf(const std::vector<ComparedValue>& values) {
  HtmlReport::Table table;
  table.title = "Beside the paper's sequence, from the same session";
  table.header = {"", "ours", "sigma", "the paper's", "difference in sigmas"};
  for (const ComparedValue& value : values) {
    const double sigmas = InSigmas(value);
    table.rows.push_back({NameOf(value),
                          Number(value.ours),
                          {Number(value.sigma), Number(value.paper),
                           std::isfinite(sigmas) ? fmt::format("{:+.1f}", sigmas) : ""}});
  }
  return table;
}

}  // namespace foresight
