#include "core/sensor/rig_id.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>

#include "core/base/sha256.h"
#include "core/sensor/sensor_rig.h"

namespace foresight {
namespace {

/// The shortest text that reads as the same number. 0 and -0 are one value.
std::string Text(double value) {
  return fmt::format(" {}", value == 0.0 ? 0.0 : value);
}

template <class To, class From>
std::string Text(const Rigid<To, From>& transform) {
  // q and -q are one rotation: the first component that is not 0 is made positive.
  Eigen::Vector4d q(transform.rotation().w(), transform.rotation().x(), transform.rotation().y(),
                    transform.rotation().z());
  for (const double component : q) {
    if (component == 0.0) continue;
    if (component < 0.0) q = -q;
    break;
  }
  std::string text;
  for (const double component : q) text += Text(component);
  for (const double component : transform.translation()) text += Text(component);
  return text;
}

/// What is hashed: a line for each part of the rig, its values in the order of the rig's file.
std::string CanonicalText(const SensorRig& rig) {
  const LidarModel& l = rig.lidar;
  std::string text = fmt::format("foresight rig 1\ncamera {} {} {}", rig.camera.Key(),
                                 rig.camera.width, rig.camera.height);
  for (const double value : rig.camera.Values()) text += Text(value);
  text += fmt::format("\nlidar {}", l.beams);
  for (const double value : {l.first_angle_rad, l.angle_step_rad, l.period_s, l.min_range_m,
                             l.max_range_m, l.range_offset_m, l.stamp_offset_s})
    text += Text(value);
  text += "\ncamera_from_head" + Text(rig.camera_from_head);
  text += "\ncamera_from_lidar" + Text(rig.camera_from_lidar);
  text += "\nrobot_from_base" + Text(rig.robot_from_base);
  text += "\nangle_correction";
  for (const auto& knot : rig.angle_correction.knots())
    text += Text(knot.motor_rad) + Text(knot.plate_rad);
  return text + "\n";
}

/// The number in `text` from `at` on, `digits` long; -1 where there is something else.
int NumberAt(const std::string& text, std::size_t at, std::size_t digits) {
  int value = -1;
  const char* begin = text.data() + at;
  if (std::isdigit(static_cast<unsigned char>(*begin)) == 0) return -1;
  const auto [end, error] = std::from_chars(begin, begin + digits, value);
  return error == std::errc() && end == begin + digits ? value : -1;
}

bool IsUtcDate(const std::string& date) {
  const std::string form = "dddd-dd-ddTdd:dd:ddZ";
  if (date.size() != form.size()) return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] != 'd' && date[i] != form[i]) return false;
  const int year = NumberAt(date, 0, 4), month = NumberAt(date, 5, 2), day = NumberAt(date, 8, 2);
  const int hour = NumberAt(date, 11, 2), minute = NumberAt(date, 14, 2);
  const int second = NumberAt(date, 17, 2);
  if (std::min({year, month, day, hour, minute, second}) < 0) return false;
  const std::chrono::year_month_day calendar{std::chrono::year(year),
                                             std::chrono::month(static_cast<unsigned>(month)),
                                             std::chrono::day(static_cast<unsigned>(day))};
  return calendar.ok() && hour < 24 && minute < 60 && second < 60;
}

}  // namespace

std::string RigId(const SensorRig& rig) {
  return Sha256Hex(CanonicalText(rig));
}

std::string ShortRigId(const SensorRig& rig) {
  return RigId(rig).substr(0, 8);
}

Status CheckRigId(const std::string& id) {
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (id.size() == 64 && std::all_of(id.begin(), id.end(), is_digit)) return {};
  return Fail(ErrorCode::kInvalidOptions, "'{}' is not an id of 64 lower-case hexadecimal digits",
              id);
}

Status CheckUtcDate(const std::string& date) {
  if (IsUtcDate(date)) return {};
  return Fail(ErrorCode::kInvalidOptions, "'{}' is not a date in UTC such as 2026-03-01T09:30:00Z",
              date);
}

}  // namespace foresight
