#include "core/evaluation/stereo_scene.h"

#include <cmath>
#include <limits>

#include "core/evaluation/stereo_calibration.h"
#include "core/io/pfm.h"
#include "core/io/png.h"

namespace foresight {
namespace {

/// Also where it cannot be looked at, as a circle of links: whoever reads it says so then.
bool IsThere(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::symlink_status(path, error).type() !=
         std::filesystem::file_type::not_found;
}

/// A view's disparity in the reduced sets of the third evaluation, and in the full-size folders.
struct DisparityNames {
  const char* reduced;
  const char* full_size;
};
constexpr DisparityNames kLeftNames = {"disp0GT.pfm", "disp0.pfm"};
constexpr DisparityNames kRightNames = {"disp1GT.pfm", "disp1.pfm"};

/// The file that is there; an empty path when neither is.
std::filesystem::path FindDisparity(const std::filesystem::path& folder,
                                    const DisparityNames& names) {
  for (const char* name : {names.reduced, names.full_size})
    if (IsThere(folder / name)) return folder / name;
  return {};
}

void TakeCalibration(const StereoCalibration& calibration, StereoScene& scene) {
  scene.focal_px = calibration.focal_px;
  scene.left_cx = calibration.left_cx;
  scene.right_cx = calibration.right_cx;
  scene.cy = calibration.cy;
  scene.disparity_offset_px = calibration.disparity_offset_px;
  scene.baseline_m = calibration.baseline_m;
}

/// Fails unless an image has the size of im1.png.
template <class T>
Status CheckSize(const Image<T>& image, const std::filesystem::path& path,
                 const StereoScene& scene) {
  if (image.SameSize(scene.right)) return {};
  return Fail(ErrorCode::kBadData, "{}: {} x {} pixels, but im1.png has {} x {}", path.string(),
              image.width(), image.height(), scene.right.width(), scene.right.height());
}

Status ReadImages(const std::filesystem::path& folder, const StereoCalibration& calibration,
                  StereoScene& scene) {
  FORESIGHT_TRY(scene.right, ReadPng(folder / "im1.png"));
  {
    // Only looked at for its size: a folder whose views differ is damaged.
    FORESIGHT_TRY(const ColorImage left, ReadPng(folder / "im0.png"));
    FORESIGHT_CHECK(CheckSize(left, folder / "im0.png", scene));
  }
  const bool width_fits = calibration.width == 0 || calibration.width == scene.right.width();
  const bool height_fits = calibration.height == 0 || calibration.height == scene.right.height();
  if (width_fits && height_fits) return {};
  return Fail(ErrorCode::kBadData, "{}: is for {} x {} pixels, but im1.png has {} x {}",
              (folder / "calib.txt").string(), calibration.width, calibration.height,
              scene.right.width(), scene.right.height());
}

/// Unknown is infinite in these files; a disparity that gives no positive depth is as good as
/// unknown.
Result<FloatImage> ReadDisparity(const std::filesystem::path& path, const StereoScene& scene) {
  FORESIGHT_TRY(FloatImage disparity, ReadPfm(path));
  FORESIGHT_CHECK(CheckSize(disparity, path, scene));
  for (float& value : disparity.values())
    if (!std::isfinite(value) || !(value + scene.disparity_offset_px > 0.0))
      value = std::numeric_limits<float>::quiet_NaN();
  return disparity;
}

}  // namespace

Result<StereoScene> LoadStereoScene(const std::filesystem::path& folder) {
  StereoScene scene;
  scene.name = std::filesystem::weakly_canonical(folder).filename().string();
  FORESIGHT_TRY(const StereoCalibration calibration, ReadStereoCalibration(folder / "calib.txt"));
  TakeCalibration(calibration, scene);
  FORESIGHT_CHECK(ReadImages(folder, calibration, scene));

  const std::filesystem::path left = FindDisparity(folder, kLeftNames);
  if (left.empty())
    return Fail(ErrorCode::kIo, "{}: neither {} nor {} is there", folder.string(),
                kLeftNames.reduced, kLeftNames.full_size);
  FORESIGHT_TRY(scene.left_disparity, ReadDisparity(left, scene));
  if (const auto right = FindDisparity(folder, kRightNames); !right.empty()) {
    FORESIGHT_TRY(scene.right_disparity, ReadDisparity(right, scene));
  }

  scene.left_in_both = MaskImage(scene.right.width(), scene.right.height(), 255);
  const std::filesystem::path mask = folder / "mask0nocc.png";
  if (IsThere(mask)) {
    FORESIGHT_TRY(scene.left_in_both, ReadPngGray(mask));
    FORESIGHT_CHECK(CheckSize(scene.left_in_both, mask, scene));
  }
  return scene;
}

}  // namespace foresight
