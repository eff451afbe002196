#include "core/evaluation/stereo_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/io/pfm.h"
#include "core/io/png.h"

namespace foresight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
/// Neighbours whose disparity differs by more, in pixels, lie on different surfaces.
constexpr float kOneSurface_px = 1.0f;

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

Status ReadCalibration(const std::filesystem::path& path, StereoScene& scene) {
  FORESIGHT_TRY(const std::string text, ReadFile(path, 1 << 16));
  const Keys keys = ReadKeys(text);
  FORESIGHT_TRY(const std::vector<double> left, Numbers(keys, "cam0", 9, path.string()));
  FORESIGHT_TRY(const std::vector<double> right, Numbers(keys, "cam1", 9, path.string()));
  FORESIGHT_TRY(const std::vector<double> offset, Numbers(keys, "doffs", 1, path.string()));
  FORESIGHT_TRY(const std::vector<double> baseline, Numbers(keys, "baseline", 1, path.string()));
  scene.focal_px = left[0];
  scene.left_cx = left[2];
  scene.right_cx = right[2];
  scene.cy = left[5];
  scene.disparity_offset_px = offset[0];
  scene.baseline_m = 1e-3 * baseline[0];
  if (!(scene.focal_px > 0.0) || !(scene.baseline_m > 0.0))
    return Fail(ErrorCode::kBadData, "{}: focal length {} px and baseline {} mm must be positive",
                path.string(), left[0], baseline[0]);
  return {};
}

/// Unknown is infinite in these files; a disparity that gives no positive depth is as good as
/// unknown.
void MarkUnknown(StereoScene& scene) {
  for (float& disparity : scene.left_disparity.values())
    if (!std::isfinite(disparity) || !(disparity + scene.disparity_offset_px > 0.0))
      disparity = kNaN;
}

float EnlargedDisparity(const FloatImage& disparity, double x, double y) {
  const int width = disparity.width();
  const int height = disparity.height();
  const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, width - 1);
  const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, height - 1);
  const int x1 = std::min(x0 + 1, width - 1);
  const int y1 = std::min(y0 + 1, height - 1);
  const float corners[] = {disparity(x0, y0), disparity(x1, y0), disparity(x0, y1),
                           disparity(x1, y1)};
  const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
  const bool known =
      std::none_of(std::begin(corners), std::end(corners), [](float d) { return std::isnan(d); });
  if (known && *high - *low <= kOneSurface_px) {
    const auto fx = static_cast<float>(std::clamp(x - x0, 0.0, 1.0));
    const auto fy = static_cast<float>(std::clamp(y - y0, 0.0, 1.0));
    const float top = corners[0] + fx * (corners[1] - corners[0]);
    const float bottom = corners[2] + fx * (corners[3] - corners[2]);
    return top + fy * (bottom - top);
  }
  const int nearest_x = std::clamp(static_cast<int>(std::lround(x)), 0, width - 1);
  const int nearest_y = std::clamp(static_cast<int>(std::lround(y)), 0, height - 1);
  return disparity(nearest_x, nearest_y);
}

ColorImage EnlargeImage(const ColorImage& image, int factor) {
  ColorImage enlarged(image.width() * factor, image.height() * factor);
  const cv::Mat from(image.height(), image.width(), CV_8UC3, const_cast<Rgb8*>(image.data()));
  cv::Mat to(enlarged.height(), enlarged.width(), CV_8UC3, enlarged.data());
  cv::resize(from, to, to.size(), 0.0, 0.0, cv::INTER_CUBIC);
  return enlarged;
}

}  // namespace

Result<StereoScene> LoadStereoScene(const std::filesystem::path& folder) {
  StereoScene scene;
  scene.name = std::filesystem::weakly_canonical(folder).filename().string();
  FORESIGHT_CHECK(ReadCalibration(folder / "calib.txt", scene));
  FORESIGHT_TRY(const ColorImage left, ReadPng(folder / "im0.png"));
  FORESIGHT_TRY(scene.right, ReadPng(folder / "im1.png"));
  FORESIGHT_TRY(scene.left_disparity, ReadPfm(folder / "disp0GT.pfm"));
  if (!left.SameSize(scene.right) || !left.SameSize(scene.left_disparity))
    return Fail(ErrorCode::kBadData,
                "{}: im0.png {} x {}, im1.png {} x {} and disp0GT.pfm {} x {} differ in size",
                folder.string(), left.width(), left.height(), scene.right.width(),
                scene.right.height(), scene.left_disparity.width(), scene.left_disparity.height());
  scene.left_in_both = MaskImage(left.width(), left.height(), 255);
  const std::filesystem::path mask = folder / "mask0nocc.png";
  if (std::filesystem::exists(mask)) {
    FORESIGHT_TRY(scene.left_in_both, ReadPngGray(mask));
    if (!left.SameSize(scene.left_in_both))
      return Fail(ErrorCode::kBadData, "{}: {} x {}, but the images have {} x {}", mask.string(),
                  scene.left_in_both.width(), scene.left_in_both.height(), left.width(),
                  left.height());
  }
  MarkUnknown(scene);
  return scene;
}

StereoScene EnlargeScene(const StereoScene& scene, int factor) {
  FORESIGHT_EXPECTS(factor >= 1, "a scene is enlarged by a whole factor");
  if (factor == 1) return scene;
  StereoScene enlarged = scene;
  const auto scaled_centre = [&](double c) { return (c + 0.5) * factor - 0.5; };
  enlarged.focal_px = scene.focal_px * factor;
  enlarged.left_cx = scaled_centre(scene.left_cx);
  enlarged.right_cx = scaled_centre(scene.right_cx);
  enlarged.cy = scaled_centre(scene.cy);
  enlarged.disparity_offset_px = scene.disparity_offset_px * factor;
  enlarged.right = EnlargeImage(scene.right, factor);
  enlarged.left_disparity = FloatImage(enlarged.right.width(), enlarged.right.height());
  enlarged.left_in_both = MaskImage(enlarged.right.width(), enlarged.right.height());
  for (int y = 0; y < enlarged.right.height(); ++y)
    for (int x = 0; x < enlarged.right.width(); ++x) {
      const double from_x = (x + 0.5) / factor - 0.5;
      const double from_y = (y + 0.5) / factor - 0.5;
      enlarged.left_disparity(x, y) =
          static_cast<float>(factor) * EnlargedDisparity(scene.left_disparity, from_x, from_y);
      enlarged.left_in_both(x, y) = scene.left_in_both(x / factor, y / factor);
    }
  return enlarged;
}

}  // namespace foresight
