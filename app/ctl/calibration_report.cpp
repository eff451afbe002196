#include "app/ctl/calibration_report.h"

#include <algorithm>
#include <cmath>

#include "app/ctl/command.h"
#include "app/ctl/paper_comparison.h"
#include "core/calibration/session_file.h"
#include "core/geometry/angles.h"
#include "core/pictures/line_chart.h"
#include "core/sensor/rig_id.h"

namespace foresight {
namespace {

nlohmann::ordered_json ToJson(const ResidualSummary& summary, const char* rms_name, double scale) {
  return {{"count", summary.count},
          {rms_name, scale * summary.rms},
          {"reduced_chi_square", summary.chi_square}};
}

/// A value in the unit that people use for it.
struct Shown {
  double scale;
  const char* unit;
};

Shown ShownAs(const std::string& unit) {
  if (unit == "rad") return {DegreesFromRadians(1.0), "deg"};
  if (unit == "m") return {1000.0, "mm"};
  if (unit == "s") return {1000.0, "ms"};
  return {1.0, unit.c_str()};
}

nlohmann::ordered_json SigmasJson(const ChainCovariance& covariance) {
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < covariance.unknowns.size(); ++i)
    list.push_back({{"name", covariance.unknowns[i].name},
                    {"unit", covariance.unknowns[i].unit},
                    {"sigma", covariance.Sigma(static_cast<int>(i))}});
  return list;
}

std::string TextOf(const Eigen::Vector3d& v, const char* format) {
  return fmt::format(fmt::runtime(format), v.x(), v.y(), v.z());
}

std::string SigmaOf(const ChainCalibration& found, const std::string& name) {
  if (!found.covariance) return "";
  const int at = found.covariance->Find(name);
  if (at < 0) return "";
  const auto shown = ShownAs(found.covariance->unknowns[static_cast<std::size_t>(at)].unit);
  return fmt::format(" +- {:.4g} {}", shown.scale * found.covariance->Sigma(at), shown.unit);
}

std::vector<HtmlReport::Row> ValueRows(const ChainCalibration& found) {
  const SensorRig& rig = found.rig;
  std::vector<HtmlReport::Row> rows;
  const auto add = [&rows](const std::string& name, const std::string& value) {
    rows.push_back({name, value});
  };
  const auto names = rig.camera.ParameterNames();
  const auto values = rig.camera.Values();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name(names[i]);
    add(name, fmt::format("{:.6g}{}", values[static_cast<Eigen::Index>(i)], SigmaOf(found, name)));
  }
  add("motor's axis in camera",
      TextOf(rig.camera_from_head.Rotate(Eigen::Vector3d::UnitX()), "{:.5f}, {:.5f}, {:.5f}") +
          SigmaOf(found, "axis turn y") + SigmaOf(found, "axis turn z"));
  add("its point next to the camera", TextOf(1000.0 * AxisPoint(rig), "{:.2f}, {:.2f}, {:.2f} mm") +
                                          SigmaOf(found, "axis shift y") +
                                          SigmaOf(found, "axis shift z"));
  for (const auto& knot : rig.angle_correction.knots()) {
    const double degrees = DegreesFromRadians(knot.motor_rad);
    const std::string name = fmt::format("plate angle at {:.6g} deg", degrees);
    add(name,
        fmt::format("{:.4f} deg{}", DegreesFromRadians(knot.plate_rad), SigmaOf(found, name)));
  }
  if (found.ranges.count == 0) return rows;
  add("lidar's place in camera",
      TextOf(1000.0 * rig.camera_from_lidar.translation(), "{:.2f}, {:.2f}, {:.2f} mm") +
          SigmaOf(found, "lidar shift x") + SigmaOf(found, "lidar shift y") +
          SigmaOf(found, "lidar shift z"));
  const Eigen::Quaterniond& q = rig.camera_from_lidar.rotation();
  add("its turn (w x y z)",
      fmt::format("{:.6f}, {:.6f}, {:.6f}, {:.6f}", q.w(), q.x(), q.y(), q.z()) +
          SigmaOf(found, "lidar turn x") + SigmaOf(found, "lidar turn y") +
          SigmaOf(found, "lidar turn z"));
  add("range offset", fmt::format("{:.2f} mm{}", 1000.0 * rig.lidar.range_offset_m,
                                  SigmaOf(found, "range offset")));
  add("stamp offset", fmt::format("{:.3f} ms{}", 1000.0 * rig.lidar.stamp_offset_s,
                                  SigmaOf(found, "stamp offset")));
  return rows;
}

std::vector<HtmlReport::Row> QualityRows(const ChainCalibration& found) {
  std::vector<HtmlReport::Row> rows = {
      {"corners", fmt::format("{}, mean error {:.3f} px, {:.3f} px rms an axis",
                              found.corners.count / 2, found.mean_error_px, found.corners.rms)}};
  if (found.ranges.count > 0)
    rows.push_back(
        {"lidar returns on boards",
         fmt::format("{}, {:.2f} mm rms along the beams, one range +- {:.1f} mm",
                     found.ranges.count, 1000.0 * found.ranges.rms, 1000.0 * found.range_sigma_m)});
  if (found.fit)
    rows.push_back(
        {"reduced chi-square",
         fmt::format("{:.3f} (corners {:.3f}, lidar {:.3f})", found.fit->ReducedChiSquare(),
                     found.corners.chi_square, found.ranges.chi_square)});
  if (found.linear)
    rows.push_back({"against a linear solution",
                    fmt::format("{:.3f} deg, {:.1f} mm", DegreesFromRadians(found.linear->turn_rad),
                                1000.0 * found.linear->shift_m)});
  if (!found.weakest.empty()) rows.push_back({"weakest", found.weakest});
  const auto& s = found.seconds;
  rows.push_back({"seconds", fmt::format("camera {:.2f}, motor {:.2f}, lidar {:.2f}, time {:.2f}, "
                                         "joint {:.2f}",
                                         s.camera, s.motor, s.lidar, s.time, s.joint)});
  for (const std::string& note : found.notes) rows.push_back({"note", note});
  return rows;
}

std::vector<HtmlReport::Row> ImageRows(const ChainCalibration& found) {
  std::vector<HtmlReport::Row> rows;
  for (const ImageFit& image : found.images)
    rows.push_back({image.source, fmt::format("{} corners, mean {:.3f} px, rms {:.3f} px",
                                              image.corners, image.mean_px, image.rms_px)});
  return rows;
}

void AddPoint(ChartSeries* series, double x, double y) {
  series->points.emplace_back(x, y);
  series->points.emplace_back(std::nan(""), std::nan(""));  // dots, not a line
}

LineChart CornerChart(const ChainCalibration& found) {
  LineChart chart;
  chart.title = "Corner residuals";
  chart.x = {.title = "u, measured minus predicted", .unit = "px"};
  chart.y = {.title = "v", .unit = "px"};
  chart.series.push_back({"corners", {}});
  constexpr std::size_t kMostDots = 2000;
  std::size_t all = 0;
  for (const CornerSet& corners : found.data.corners) all += corners.pixels.size();
  const std::size_t every = 1 + all / kMostDots;
  std::size_t i = 0;
  for (const CornerSet& corners : found.data.corners)
    for (const Eigen::Vector2d& residual : CornerResiduals(found.state, corners))
      if (i++ % every == 0) AddPoint(&chart.series.front(), residual.x(), residual.y());
  return chart;
}

LineChart AngleChart(const ChainCalibration& found) {
  LineChart chart;
  chart.title = "Plate against motor";
  chart.x = {.title = "commanded angle", .unit = "deg"};
  chart.y = {.title = "A_theta - theta", .unit = "deg"};
  chart.series.push_back({"difference", {}});
  for (const auto& knot : found.rig.angle_correction.knots())
    chart.series.front().points.emplace_back(DegreesFromRadians(knot.motor_rad),
                                             DegreesFromRadians(knot.plate_rad - knot.motor_rad));
  return chart;
}

LineChart RangeChart(const ChainCalibration& found) {
  LineChart chart;
  chart.title = "Lidar residuals of each line";
  chart.x = {.title = "line", .unit = "", .whole_numbers = true};
  chart.y = {.title = "along the beams", .unit = "mm", .from_zero = true};
  chart.series = {{"rms", {}}, {"mean", {}}};
  for (std::size_t i = 0; i < found.lines.size(); ++i) {
    AddPoint(&chart.series[0], static_cast<double>(i + 1), 1000.0 * found.lines[i].rms_m);
    AddPoint(&chart.series[1], static_cast<double>(i + 1), 1000.0 * found.lines[i].mean_m);
  }
  return chart;
}

/// From where on a calibration does not pass: the paper's error of the corners with a quarter of
/// it for other boards and light, and the accuracies of docs/calibration_chain.md.
constexpr double kMostError_px = 0.45;
constexpr double kMostAxis_rad = 0.0006, kMostLidar_rad = 0.0035, kMostLidar_m = 0.003;
constexpr double kMostStamp_s = 0.001;

std::string LimitsInWords() {
  return fmt::format(
      "corners {:.2f} px (the paper: 0.360 px), deviations of the motor's axis {:.3f} deg, of the "
      "lidar {:.1f} deg and {:.0f} mm, of its stamps {:.0f} ms",
      kMostError_px, DegreesFromRadians(kMostAxis_rad), DegreesFromRadians(kMostLidar_rad),
      1000.0 * kMostLidar_m, 1000.0 * kMostStamp_s);
}

std::vector<std::string> FaultsOf(const ChainCalibration& found) {
  std::vector<std::string> faults;
  if (!(found.mean_error_px <= kMostError_px))
    faults.push_back(fmt::format("corners are {:.3f} px off in the mean, more than {:.2f} px",
                                 found.mean_error_px, kMostError_px));
  if (!found.covariance) {
    faults.emplace_back("deviations are not known: only the joint solve has them");
    return faults;
  }
  const auto check = [&](const char* start, double most) {
    for (std::size_t i = 0; i < found.covariance->unknowns.size(); ++i) {
      const SharedUnknown& unknown = found.covariance->unknowns[i];
      const double sigma = found.covariance->Sigma(static_cast<int>(i));
      if (!unknown.name.starts_with(start) || sigma <= most) continue;
      const Shown shown = ShownAs(unknown.unit);
      faults.push_back(fmt::format("{} is known to +- {:.3g} {} only, {:.3g} are allowed",
                                   unknown.name, shown.scale * sigma, shown.unit,
                                   shown.scale * most));
    }
  };
  check("axis turn", kMostAxis_rad);
  check("lidar turn", kMostLidar_rad);
  check("lidar shift", kMostLidar_m);
  check("stamp offset", kMostStamp_s);
  return faults;
}

}  // namespace

Eigen::Vector3d AxisPoint(const SensorRig& rig) {
  const Eigen::Vector3d axis = rig.camera_from_head.Rotate(Eigen::Vector3d::UnitX());
  const Eigen::Vector3d& t = rig.camera_from_head.translation();
  return t - axis * axis.dot(t);
}

nlohmann::ordered_json CalibrationJson(const ChainCalibration& found) {
  const SensorRig& rig = found.rig;
  nlohmann::ordered_json json = {{"rig_id", RigId(rig)}, {"model", rig.camera.Key()}};
  const auto names = rig.camera.ParameterNames();
  const auto values = rig.camera.Values();
  for (std::size_t i = 0; i < names.size(); ++i)
    json["camera"][std::string(names[i])] = values[static_cast<Eigen::Index>(i)];
  const Eigen::Vector3d axis = rig.camera_from_head.Rotate(Eigen::Vector3d::UnitX());
  const Eigen::Vector3d point = AxisPoint(rig);
  json["axis_in_camera"] = {axis.x(), axis.y(), axis.z()};
  json["axis_point_in_camera_m"] = {point.x(), point.y(), point.z()};
  json["camera_from_head"] = ToJson(rig.camera_from_head);
  json["angles"] = nlohmann::ordered_json::array();
  for (const auto& knot : rig.angle_correction.knots())
    json["angles"].push_back({{"motor_deg", DegreesFromRadians(knot.motor_rad)},
                              {"plate_deg", DegreesFromRadians(knot.plate_rad)}});
  json["board_a_from_b"] = ToJson(found.state.a_from_b);
  json["corners"] = ToJson(found.corners, "rms_px", 1.0);
  json["mean_error_px"] = found.mean_error_px;
  if (found.ranges.count > 0) {
    json["camera_from_lidar"] = ToJson(rig.camera_from_lidar);
    json["range_offset_mm"] = 1000.0 * rig.lidar.range_offset_m;
    json["stamp_offset_ms"] = 1000.0 * rig.lidar.stamp_offset_s;
    json["lidar"] = ToJson(found.ranges, "rms_mm", 1000.0);
    json["range_sigma_mm"] = 1000.0 * found.range_sigma_m;
  }
  if (found.linear)
    json["linear_check"] = {{"turn_deg", DegreesFromRadians(found.linear->turn_rad)},
                            {"shift_mm", 1000.0 * found.linear->shift_m}};
  if (found.fit) json["reduced_chi_square"] = found.fit->ReducedChiSquare();
  if (found.covariance) json["sigma"] = SigmasJson(*found.covariance);
  json["weakest"] = found.weakest;
  json["images"] = nlohmann::ordered_json::array();
  for (const ImageFit& image : found.images)
    json["images"].push_back({{"source", image.source},
                              {"corners", image.corners},
                              {"rms_px", image.rms_px},
                              {"mean_px", image.mean_px}});
  json["lines"] = nlohmann::ordered_json::array();
  for (const LineFit& line : found.lines)
    json["lines"].push_back({{"source", line.source},
                             {"returns", line.returns},
                             {"rms_mm", 1000.0 * line.rms_m},
                             {"mean_mm", 1000.0 * line.mean_m}});
  json["notes"] = found.notes;
  const auto& s = found.seconds;
  json["seconds"] = {{"camera", s.camera},
                     {"motor", s.motor},
                     {"lidar", s.lidar},
                     {"time", s.time},
                     {"joint", s.joint}};
  return json;
}

std::string DescribeCalibration(const ChainCalibration& found) {
  std::string text;
  for (const auto& rows : {QualityRows(found), ValueRows(found)})
    for (const auto& row : rows)
      text += fmt::format("{}{:<29}{}", text.empty() ? "" : "\n", row.name, row.value);
  return text;
}

HtmlReport CalibrationReport(const ChainCalibration& found, const std::string& session) {
  HtmlReport report;
  report.title = "Calibration of " + session;
  report.summary = fmt::format(
      "Mean error of the corners {:.3f} px (the paper: 0.360 px).{} Deviations are one sigma{}. "
      "Rig {}.",
      found.mean_error_px,
      found.fit ? fmt::format(" Reduced chi-square {:.3f}.", found.fit->ReducedChiSquare()) : "",
      found.covariance ? ", of the joint solve" : "; only the joint solve has them",
      ShortRigId(found.rig));
  report.tables = {{"How well it fits", QualityRows(found)},
                   {"Values", ValueRows(found)},
                   {"Images", ImageRows(found)}};
  report.charts = {
      {SvgOf(CornerChart(found)), "A round cloud about 0 is noise; a shape in it is an error."},
      {SvgOf(AngleChart(found)), "What Eq. (5) calls A, against the commanded angle."}};
  if (!found.lines.empty())
    report.charts.push_back(
        {SvgOf(RangeChart(found)),
         "A line whose mean is far from 0 is not on the board it was given to."});
  return report;
}

PdfReport CalibrationSheet(const ChainCalibration& found, const CalibrationSession& session,
                           const std::vector<ComparedValue>& paper) {
  // The plate's angles are in a chart.
  const auto rows_of = [](const std::vector<HtmlReport::Row>& rows) {
    std::vector<PdfReport::Row> sheet;
    for (const HtmlReport::Row& row : rows)
      if (!row.name.starts_with("plate angle")) sheet.push_back({row.name, row.value});
    return sheet;
  };
  const std::vector<std::string> faults = FaultsOf(found);
  PdfReport sheet;
  sheet.title = "Calibration of " + session.name;
  sheet.good = faults.empty();
  sheet.verdict = faults.empty()
                      ? fmt::format("Within all limits: {}.", LimitsInWords())
                      : fmt::format("Not within the limits: {}.", fmt::join(faults, "; "));
  sheet.subject = {{"session", session.name},
                   {"its measurements", "SHA-256 " + SessionHash(session)},
                   {"rig", RigId(found.rig)},
                   {"made from rig", RigId(session.prior)},
                   {"date", found.rig.date_utc}};
  sheet.charts = {CornerChart(found), AngleChart(found)};
  if (!found.lines.empty()) sheet.charts.push_back(RangeChart(found));
  sheet.tables = {{"How well it fits", rows_of(QualityRows(found))},
                  {"Values, with one standard deviation", rows_of(ValueRows(found))}};
  if (!paper.empty()) {
    PdfReport::Table table{"Beside the paper's sequence (Section III-B as printed)", {}};
    for (const ComparedValue& value : paper) {
      if (value.name.starts_with("plate angle") || !std::isfinite(value.paper)) continue;
      const std::string sigma =
          std::isfinite(value.sigma) ? fmt::format(" +- {:.3g}", value.sigma) : "";
      table.rows.push_back({value.name, fmt::format("ours {:.6g}{}, the paper's {:.6g} {}",
                                                    value.ours, sigma, value.paper, value.unit)});
    }
    sheet.tables.insert(sheet.tables.begin() + 1, std::move(table));
  }
  return sheet;
}

}  // namespace foresight
