#include "core/calibration/select_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/calibration/fit_lens.h"
#include "core/calibration/intrinsics_start.h"

namespace foresight {
namespace {

constexpr int kMostRounds = 6;
/// Of an image whose corners are wrong in more than this fraction, the board was not found but
/// something else.
constexpr double kMostWrongCorners = 0.2;
/// A corner that is a pixel off counts half as much.
constexpr BundleOptions kRobust{.free_warp = true, .loss_px = 1.0};
/// The median of the distance of two normal coordinates, in standard deviations of one.
constexpr double kMedianDistance = 1.1774;

/// 0 where there is none.
double Median(std::vector<double> values) {
  return values.empty() ? 0.0 : UpperMedian(std::move(values));
}

/// Corners of one view that are too far off.
std::vector<bool> WrongCorners(const std::vector<Eigen::Vector2d>& errors, double limit_px) {
  std::vector<bool> wrong;
  for (const Eigen::Vector2d& error : errors) wrong.push_back(!(error.norm() <= limit_px));
  return wrong;
}

BoardView Without(const BoardView& view, const std::vector<bool>& wrong) {
  BoardView rest;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (wrong[i]) continue;
    rest.corner_ids.push_back(view.corner_ids[i]);
    rest.pixels.push_back(view.pixels[i]);
  }
  return rest;
}

class ImageSelection {
 public:
  ImageSelection(const std::vector<IntrinsicsImage>& images, const IntrinsicsOptions& options,
                 IntrinsicsStart start)
      : images_(images), options_(options) {
    selected_.bundle = std::move(start.bundle);
    selected_.images = std::move(start.views);
    std::size_t next = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (next < selected_.images.size() && selected_.images[next] == i)
        ++next;
      else
        Reject(i,
               "its corners fit no pose of the board in a camera that explains the other images");
    }
  }

  /// Adjusts and leaves out; false where nothing was left out.
  Result<bool> Round(const RunContext& context) {
    FORESIGHT_CHECK(AdjustBundle(selected_.bundle, kRobust, context));
    const bool corners = LeaveOutCorners();
    const bool images = LeaveOutImages();
    return corners || images;
  }

  CameraBundle& bundle() { return selected_.bundle; }
  SelectedImages&& Take() && { return std::move(selected_); }

 private:
  void Reject(std::size_t image, std::string reason) {
    selected_.rejected.push_back({images_[image].name, std::move(reason)});
  }

  void Drop(std::size_t view) {
    const auto at = static_cast<std::ptrdiff_t>(view);
    selected_.bundle.views.erase(selected_.bundle.views.begin() + at);
    selected_.bundle.poses.erase(selected_.bundle.poses.begin() + at);
    selected_.images.erase(selected_.images.begin() + at);
  }

  bool LeaveOutCorners() {
    if (options_.corner_outlier_ratio == 0.0) return false;
    std::vector<double> distances;
    for (std::size_t view = 0; view < selected_.bundle.views.size(); ++view)
      for (const Eigen::Vector2d& error : ViewErrors(selected_.bundle, view))
        distances.push_back(error.norm());
    const double sigma = Median(distances) / kMedianDistance;
    const double limit =
        std::max(options_.corner_outlier_ratio * sigma, options_.corner_outlier_floor_px);
    bool changed = false;
    for (std::size_t view = selected_.bundle.views.size(); view-- > 0;) {
      const auto wrong = WrongCorners(ViewErrors(selected_.bundle, view), limit);
      const auto count = std::count(wrong.begin(), wrong.end(), true);
      if (count == 0) continue;
      changed = true;
      if (static_cast<double>(count) > kMostWrongCorners * static_cast<double>(wrong.size())) {
        Reject(selected_.images[view],
               fmt::format("{} of its {} corners are more than {:.1f} px off what the other images "
                           "say",
                           count, wrong.size(), limit));
        Drop(view);
        continue;
      }
      selected_.corners_rejected += static_cast<int>(count);
      selected_.bundle.views[view] = Without(selected_.bundle.views[view], wrong);
    }
    return changed;
  }

  bool LeaveOutImages() {
    if (options_.image_outlier_ratio == 0.0) return false;
    std::vector<double> rms;
    for (std::size_t view = 0; view < selected_.bundle.views.size(); ++view)
      rms.push_back(SummarizeErrors(ViewErrors(selected_.bundle, view)).rms_px);
    const double median = Median(rms);
    const double limit =
        std::max(options_.image_outlier_ratio * median, options_.image_outlier_floor_px);
    bool changed = false;
    for (std::size_t view = rms.size(); view-- > 0;) {
      if (rms[view] <= limit) continue;
      Reject(selected_.images[view],
             fmt::format("its corners are {:.2f} px (rms) off what the other images say; their "
                         "median is {:.2f} px",
                         rms[view], median));
      Drop(view);
      changed = true;
    }
    return changed;
  }

  const std::vector<IntrinsicsImage>& images_;
  const IntrinsicsOptions& options_;
  SelectedImages selected_;
};

}  // namespace

Result<SelectedImages> SelectImages(const CalibrationBoard& board,
                                    const std::vector<IntrinsicsImage>& images, int width,
                                    int height, const IntrinsicsOptions& options,
                                    const RunContext& context) {
  std::vector<BoardView> views;
  for (const IntrinsicsImage& image : images) views.push_back(image.view);
  FORESIGHT_TRY(IntrinsicsStart start, FindIntrinsicsStart(board, views, width, height, context));
  context.Report(0.2, "images that contradict the others");
  ImageSelection selection(images, options, std::move(start));
  FORESIGHT_TRY(selection.bundle(),
                FitLens(selection.bundle(), LensModel::kKannalaBrandt, kRobust, context));
  for (int round = 0; round < kMostRounds; ++round) {
    FORESIGHT_TRY(const bool changed, selection.Round(context));
    if (!changed) break;
    if (static_cast<int>(selection.bundle().views.size()) < options.min_images) break;
  }
  SelectedImages selected = std::move(selection).Take();
  const std::size_t left = selected.images.size();
  if (static_cast<int>(left) < options.min_images || 3 * left < 2 * images.size())
    return Fail(ErrorCode::kTooFewPoints,
                "the images contradict each other: {} of {} do not fit to the rest, e.g. {}: {}. "
                "Was the zoom or the focus changed, or is the board not flat?",
                images.size() - left, images.size(), selected.rejected.front().name,
                selected.rejected.front().reason);
  return selected;
}

}  // namespace foresight
