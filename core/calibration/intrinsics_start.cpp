#include "core/calibration/intrinsics_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"

namespace foresight {
namespace {

constexpr std::size_t kViewsTried = 12;
constexpr std::size_t kStartsAdjusted = 4;
/// A view that fits worse than this says nothing more about a focal length.
constexpr double kWorstView_px = 50.0;
/// Before the lens is known, good corners are some pixels off.
constexpr double kStartLoss_px = 3.0;

struct Attempt {
  CameraModel camera;
  double cost = std::numeric_limits<double>::infinity();
};

/// Focal lengths in widths of the image: equidistant lenses of 200 to 40 deg over the width,
/// pinholes of 90 to 10 deg.
std::vector<Attempt> Attempts(int width, int height) {
  std::vector<Attempt> attempts;
  const auto add = [&](double k, double focal_per_width) {
    const double focal = focal_per_width * width;
    attempts.push_back({.camera = {.width = width,
                                   .height = height,
                                   .fx = focal,
                                   .fy = focal,
                                   .cx = 0.5 * (width - 1),
                                   .cy = 0.5 * (height - 1),
                                   .lens = FisheyeLens{k}}});
  };
  for (const double f : {0.15, 0.2, 0.24, 0.29, 0.34, 0.4, 0.48, 0.6, 0.8, 1.2}) add(1.0, f);
  for (const double f : {0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 5.0}) add(0.0, f);
  return attempts;
}

/// Views spread over the list.
std::vector<std::size_t> ViewsToTry(std::size_t count) {
  const std::size_t tried = std::min(count, kViewsTried);
  std::vector<std::size_t> views;
  for (std::size_t i = 0; i < tried; ++i) views.push_back(i * count / tried);
  return views;
}

double CostOf(const CameraModel& camera, const CalibrationBoard& board,
              const std::vector<BoardView>& views, const std::vector<std::size_t>& tried) {
  double cost = 0.0;
  for (const std::size_t view : tried) {
    const auto pose = FindBoardPose(board, views[view], camera);
    const double rms = pose ? std::min(pose->rms_px, kWorstView_px) : kWorstView_px;
    cost += rms * rms;
  }
  return cost;
}

/// The lens may be a pinhole: then k, which must not be 0 to be moved, starts small.
CameraModel WithMovableLens(CameraModel camera) {
  if (auto* lens = std::get_if<FisheyeLens>(&camera.lens); lens != nullptr && lens->k == 0.0)
    lens->k = 0.3;
  return camera;
}

/// Poses of the views that have one near enough.
IntrinsicsStart Posed(const CameraModel& camera, const CalibrationBoard& board,
                      const std::vector<BoardView>& views) {
  IntrinsicsStart start;
  start.bundle.board = board;
  start.bundle.camera = camera;
  for (std::size_t view = 0; view < views.size(); ++view) {
    const auto pose = FindBoardPose(board, views[view], camera);
    if (!pose || pose->rms_px > kWorstView_px) continue;
    start.bundle.views.push_back(views[view]);
    start.bundle.poses.push_back(pose->camera_from_pattern);
    start.views.push_back(view);
  }
  return start;
}

Result<IntrinsicsStart> Adjusted(const Attempt& attempt, const CalibrationBoard& board,
                                 const std::vector<BoardView>& views, const RunContext& context) {
  IntrinsicsStart start = Posed(attempt.camera, board, views);
  if (2 * start.views.size() < views.size())
    return Fail(ErrorCode::kNoConvergence, "only {} of {} images have a pose", start.views.size(),
                views.size());
  BundleOptions options{.free_lens = false,
                        .free_principal_point = false,
                        .loss_px = kStartLoss_px,
                        .max_iterations = 30};
  FORESIGHT_CHECK(AdjustBundle(start.bundle, options, context));
  FORESIGHT_TRY(start.bundle, WithCamera(start.bundle, WithMovableLens(start.bundle.camera)));
  options.free_lens = true;
  FORESIGHT_CHECK(AdjustBundle(start.bundle, options, context));
  options.free_principal_point = true;
  options.max_iterations = 50;
  FORESIGHT_CHECK(AdjustBundle(start.bundle, options, context));
  // With the lens known, a view that had no pose may have one.
  return Posed(start.bundle.camera, board, views);
}

/// Cauchy's, so that a wrong corner does not choose the lens; a view without a pose is all wrong.
double RobustCost(const IntrinsicsStart& start, const std::vector<BoardView>& views) {
  constexpr double kScale = kStartLoss_px * kStartLoss_px;
  const auto cost_of = [](double squared) { return kScale * std::log1p(squared / kScale); };
  double cost = 0.0;
  std::size_t corners = 0;
  for (std::size_t view = 0; view < start.bundle.views.size(); ++view)
    for (const Eigen::Vector2d& error : ViewErrors(start.bundle, view)) {
      ++corners;
      cost += cost_of(error.allFinite() ? error.squaredNorm() : kWorstView_px * kWorstView_px);
    }
  std::size_t all = 0;
  for (const BoardView& view : views) all += view.pixels.size();
  return cost + static_cast<double>(all - corners) * cost_of(kWorstView_px * kWorstView_px);
}

}  // namespace

Result<CameraBundle> WithCamera(const CameraBundle& bundle, const CameraModel& camera) {
  CameraBundle result = bundle;
  result.camera = camera;
  for (std::size_t view = 0; view < bundle.views.size(); ++view) {
    auto pose = FindBoardPose(bundle.board, bundle.views[view], camera, bundle.warp);
    const auto refined =
        RefineBoardPose(bundle.board, bundle.views[view], camera, bundle.poses[view], bundle.warp);
    if (refined && (!pose || refined->rms_px < pose->rms_px)) pose = refined;
    if (!pose) return Fail(ErrorCode::kNoConvergence, "view {}: the board has no pose", view + 1);
    result.poses[view] = pose->camera_from_pattern;
    for (const Eigen::Vector2d& error : ViewErrors(result, view))
      if (!error.allFinite())
        return Fail(ErrorCode::kNoConvergence,
                    "view {}: corners lie outside of what the lens shows", view + 1);
  }
  return result;
}

Result<IntrinsicsStart> FindIntrinsicsStart(const CalibrationBoard& board,
                                            const std::vector<BoardView>& views, int width,
                                            int height, const RunContext& context) {
  std::vector<Attempt> attempts = Attempts(width, height);
  const std::vector<std::size_t> tried = ViewsToTry(views.size());
  const bool finished = ParallelFor(static_cast<int>(attempts.size()), context, [&](int i) {
    Attempt& attempt = attempts[static_cast<std::size_t>(i)];
    attempt.cost = CostOf(attempt.camera, board, views, tried);
  });
  if (!finished) return Fail(ErrorCode::kCancelled, "calibration was cancelled");
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const Attempt& a, const Attempt& b) { return a.cost < b.cost; });

  std::optional<IntrinsicsStart> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kStartsAdjusted; ++i) {
    auto start = Adjusted(attempts[i], board, views, context);
    if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "calibration was cancelled");
    if (!start || start->views.empty()) continue;
    const double cost = RobustCost(*start, views);
    if (cost >= best_cost) continue;
    best = std::move(*start);
    best_cost = cost;
  }
  if (!best)
    return Fail(ErrorCode::kNoConvergence,
                "no lens of 10 to 200 deg explains the corners of the {} images", views.size());
  return *best;
}

}  // namespace foresight
