#include "core/evaluation/stereo_calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/io/image_limits.h"

namespace foresight {
namespace {

constexpr std::size_t kLimit_bytes = 1 << 16;

using Keys = std::map<std::string, std::string>;

std::string Trim(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

Keys ReadKeys(const std::string& text) {
  Keys keys;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (const auto equals = line.find('='); equals != std::string::npos)
      keys[Trim(line.substr(0, equals))] = Trim(line.substr(equals + 1));
  return keys;
}

/// The numbers of a value such as "[ 989.9 0 392.9 ; 0 989.9 243.2 ; 0 0 1 ]".
Result<std::vector<double>> Numbers(const Keys& keys, const std::string& key, std::size_t count,
                                    const std::string& file) {
  const auto found = keys.find(key);
  if (found == keys.end()) return Fail(ErrorCode::kBadData, "{}: '{}' is missing", file, key);
  std::string text = found->second;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '[' || c == ']' || c == ';'; }, ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) numbers.push_back(number);
  const bool finite =
      std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
  if (numbers.size() != count || !stream.eof() || !finite)
    return Fail(ErrorCode::kBadData, "{}: '{}' is '{}', not {} numbers", file, key, found->second,
                count);
  return numbers;
}

/// A side of the images; 0 where the file does not say.
Result<int> Side(const Keys& keys, const std::string& key, const std::string& file) {
  if (!keys.contains(key)) return 0;
  FORESIGHT_TRY(const std::vector<double> side, Numbers(keys, key, 1, file));
  if (!(side[0] >= 1.0 && side[0] <= kMaxImageSide) || side[0] != std::floor(side[0]))
    return Fail(ErrorCode::kBadData, "{}: '{}' is {}, not a whole number from 1 to {}", file, key,
                side[0], kMaxImageSide);
  return static_cast<int>(side[0]);
}

}  // namespace

Result<StereoCalibration> ReadStereoCalibration(const std::filesystem::path& path) {
  FORESIGHT_TRY(const std::string text, ReadFile(path, kLimit_bytes));
  const Keys keys = ReadKeys(text);
  const std::string file = path.string();
  FORESIGHT_TRY(const std::vector<double> left, Numbers(keys, "cam0", 9, file));
  FORESIGHT_TRY(const std::vector<double> right, Numbers(keys, "cam1", 9, file));
  FORESIGHT_TRY(const std::vector<double> offset, Numbers(keys, "doffs", 1, file));
  FORESIGHT_TRY(const std::vector<double> baseline, Numbers(keys, "baseline", 1, file));
  StereoCalibration calibration;
  FORESIGHT_TRY(calibration.width, Side(keys, "width", file));
  FORESIGHT_TRY(calibration.height, Side(keys, "height", file));
  calibration.focal_px = left[0];
  calibration.left_cx = left[2];
  calibration.right_cx = right[2];
  calibration.cy = left[5];
  calibration.disparity_offset_px = offset[0];
  calibration.baseline_m = 1e-3 * baseline[0];
  if (!(left[0] > 0.0) || !(baseline[0] > 0.0))
    return Fail(ErrorCode::kBadData, "{}: focal length {} px and baseline {} mm must be positive",
                file, left[0], baseline[0]);
  if (left[0] != right[0])
    return Fail(ErrorCode::kBadData,
                "{}: cam0 and cam1 have focal lengths of {} and {} px: the pair is not rectified",
                file, left[0], right[0]);
  return calibration;
}

}  // namespace foresight
