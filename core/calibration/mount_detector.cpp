#include "core/calibration/mount_detector.h"

#include <algorithm>
#include <limits>

#include "core/calibration/board_detector.h"
#include "core/calibration/board_pose.h"
#include "core/calibration/grid_growth.h"
#include "core/calibration/image_rating.h"
#include "core/calibration/tangent.h"

namespace foresight {
namespace {

using BoardKind = CalibrationBoard::Kind;

/// A grid of the image that can be a board.
struct MountCandidate {
  std::size_t grid = 0;
  BoardView view;
  bool has_margin = false;
  std::optional<CameraFromPattern> pose;
};

/// The same corners as the board has them upside down.
BoardView UpsideDown(BoardView view, const CalibrationBoard& board) {
  for (int& id : view.corner_ids) id = board.CornerCount() - 1 - id;
  std::reverse(view.corner_ids.begin(), view.corner_ids.end());
  std::reverse(view.pixels.begin(), view.pixels.end());
  return view;
}

/// A board that looks the same upside down is there both ways up.
std::vector<MountCandidate> CandidatesFor(const CalibrationBoard& board, const GrayImage& image,
                                          const std::vector<CornerGrid>& grids,
                                          const CameraModel& camera, std::string* fault) {
  std::vector<MountCandidate> candidates;
  const auto add = [&](std::size_t grid, BoardView view, bool has_margin) {
    MountCandidate candidate{grid, std::move(view), has_margin, {}};
    if (const auto pose = FindBoardPose(board, candidate.view, camera))
      candidate.pose = pose->camera_from_pattern;
    candidates.push_back(std::move(candidate));
  };
  for (std::size_t i = 0; i < grids.size(); ++i) {
    BoardDetection found = DetectBoard(image, {grids[i]}, board, SearchEffort::kQuick);
    if (!found.rejection.empty()) {
      if (found.rating.light_level > 0.0) *fault = found.rejection;  // the board was there
      continue;
    }
    const bool has_margin = HasMargin(image, grids[i]);
    if (board.LooksSameUpsideDown()) add(i, UpsideDown(found.view, board), has_margin);
    add(i, std::move(found.view), has_margin);
  }
  return candidates;
}

/// Whether a part of a board can have the corners of another one.
bool Contains(const CalibrationBoard& large, const CalibrationBoard& small) {
  const auto [short_side, long_side] = std::minmax(small.columns, small.rows);
  const auto [low, high] = std::minmax(large.columns, large.rows);
  return short_side <= low && long_side <= high;
}

/// How far two grids are from standing to each other as drawn, in parts of what a roughly known
/// camera makes of it: above 1 they do not.
double MisfitOf(const MountCandidate& a, const MountCandidate& b, const BoardMount& mount) {
  // Wide on purpose: two grids one square apart differ by 50 mm, but BestPair asks for the best one
  // clearly. A rough camera whose focal length is a third off tells distances a third wrong.
  constexpr double kMostTurn_rad = 0.6, kMostShift_m = 0.05, kMostShiftRatio = 0.35;
  if (!a.pose || !b.pose) return std::numeric_limits<double>::infinity();
  const auto step = StepBetween(mount.a_from_b, a.pose->Inverse() * *b.pose);
  return std::max(step.head<3>().norm() / kMostTurn_rad,
                  step.tail<3>().norm() /
                      (kMostShift_m + kMostShiftRatio * mount.a_from_b.translation().norm()));
}

/// The two that stand to each other best, as drawn; `second` is the misfit of the next best two.
struct Pair {
  const MountCandidate* a = nullptr;
  const MountCandidate* b = nullptr;
  double misfit = std::numeric_limits<double>::infinity();
  double second = std::numeric_limits<double>::infinity();
};

Pair BestPair(const std::vector<MountCandidate>& all_a, const std::vector<MountCandidate>& all_b,
              const BoardMount& mount) {
  Pair best;
  for (const MountCandidate& a : all_a)
    for (const MountCandidate& b : all_b) {
      if (a.grid == b.grid) continue;
      const double misfit = MisfitOf(a, b, mount);
      best.second = std::min(best.second, std::max(misfit, best.misfit));
      if (misfit < best.misfit) best = {&a, &b, misfit, best.second};
    }
  return best;
}

/// Whether most of a grid lies where a board is.
bool LiesOn(const CornerGrid& grid, const CalibrationBoard& board,
            const CameraFromPattern& camera_from_board, const CameraModel& camera) {
  const auto board_from_camera = camera_from_board.Inverse();
  const Eigen::Vector3d& from = board_from_camera.translation();
  const double beside_m = 2.0 * board.square_m;  // the outer squares, and what the camera is off by
  int inside = 0;
  for (const Eigen::Vector2d& pixel : grid.pixels) {
    const auto ray = camera.Unproject(pixel);
    if (!ray) continue;
    const Eigen::Vector3d direction = board_from_camera.Rotate(*ray);
    const double distance = -from.z() / direction.z();
    if (!(distance > 0.0) || !(direction.z() > 0.0)) continue;  // or seen from behind
    const Eigen::Vector3d p = from + distance * direction;
    inside += p.x() > -beside_m && p.y() > -beside_m &&
                      p.x() < (board.columns - 1) * board.square_m + beside_m &&
                      p.y() < (board.rows - 1) * board.square_m + beside_m
                  ? 1
                  : 0;
  }
  return 2 * inside > static_cast<int>(grid.pixels.size());
}

/// A board of a mount, and where the other one is, seen from it.
struct Side {
  const CalibrationBoard& board;
  const CalibrationBoard& other;
  BoardFromBoard board_from_other;
};

/// Whether a grid can be the board without the other board being found. Only the other board tells
/// which way up a board is that looks the same upside down. Where the grid could be a part of the
/// other board, the margin must be seen, and other grids must lie where the other board is then.
bool CanBeAlone(const MountCandidate& candidate, const Side& side,
                const std::vector<CornerGrid>& grids, const CameraModel& camera) {
  if (side.board.LooksSameUpsideDown()) return false;
  if (!Contains(side.other, side.board)) return true;
  if (!candidate.has_margin || !candidate.pose) return false;
  const CameraFromPattern camera_from_other = *candidate.pose * side.board_from_other;
  for (std::size_t i = 0; i < grids.size(); ++i)
    if (i != candidate.grid && !LiesOn(grids[i], side.other, camera_from_other, camera))
      return false;
  return true;
}

/// The only one that can be; empty where there are more.
std::optional<BoardView> AloneIn(const std::vector<MountCandidate>& candidates, const Side& side,
                                 const std::vector<CornerGrid>& grids, const CameraModel& camera) {
  std::optional<BoardView> only;
  for (const MountCandidate& candidate : candidates) {
    if (!CanBeAlone(candidate, side, grids, camera)) continue;
    if (only) return std::nullopt;
    only = candidate.view;
  }
  return only;
}

MountView DetectCheckerboards(const GrayImage& image, const BoardMount& mount,
                              const CameraModel& camera) {
  MountView view;
  const CalibrationBoard& b = *mount.b;
  const bool a_in_b = Contains(b, mount.a), b_in_a = Contains(mount.a, b);
  const std::vector<CornerGrid> grids = FindGrids(image);
  const auto all_a = CandidatesFor(mount.a, image, grids, camera, &view.fault);
  const auto all_b = CandidatesFor(b, image, grids, camera, &view.fault);
  // A symmetric board's other order is half a turn off, an equal board elsewhere at least its
  // width: both are many times the misfit of the right pair.
  constexpr double kClearlyBetter = 2.0;
  const Pair pair = BestPair(all_a, all_b, mount);
  if (pair.misfit <= 1.0 && kClearlyBetter * pair.misfit < pair.second) {
    view.a = pair.a->view;
    view.b = pair.b->view;
    view.fault.clear();
    return view;
  }
  if (a_in_b && b_in_a) return view;
  view.a = AloneIn(all_a, {mount.a, b, mount.a_from_b}, grids, camera);
  view.b = AloneIn(all_b, {b, mount.a, mount.a_from_b.Inverse()}, grids, camera);
  return view;
}

bool AreCheckerboards(const BoardMount& mount) {
  return mount.b && mount.a.kind == BoardKind::kCheckerboard &&
         mount.b->kind == BoardKind::kCheckerboard;
}

/// Of a board that no other checkerboard stands beside.
Status CheckUpright(const CalibrationBoard& board) {
  if (!board.LooksSameUpsideDown()) return {};
  return Fail(ErrorCode::kInvalidOptions,
              "the stand's checkerboard of {} x {} inner corners looks the same upside down: an "
              "image does not tell which of its corners is the first; take one with one count odd "
              "and one even, such as 7 x 6, or a ChArUco board",
              board.columns, board.rows);
}

MountView DetectEach(const GrayImage& image, const BoardMount& mount) {
  MountView view;
  const auto find = [&](const CalibrationBoard& board, std::optional<BoardView>* found) {
    BoardDetection detection = DetectBoard(image, board, SearchEffort::kQuick);
    if (detection.rejection.empty())
      *found = std::move(detection.view);
    else if (detection.rating.light_level > 0.0)  // the board was there
      view.fault = std::move(detection.rejection);
  };
  find(mount.a, &view.a);
  if (mount.b) find(*mount.b, &view.b);
  return view;
}

}  // namespace

MountView DetectMount(const GrayImage& image, const BoardMount& mount, const CameraModel& camera) {
  if (!CheckInImages(mount)) return {};
  MountView view = AreCheckerboards(mount) ? DetectCheckerboards(image, mount, camera)
                                           : DetectEach(image, mount);
  if (view.empty() && view.fault.empty()) view.fault = ImageFault(image);
  return view;
}

Status CheckInImages(const BoardMount& mount) {
  FORESIGHT_CHECK(mount.Check());
  if (!AreCheckerboards(mount)) {
    FORESIGHT_CHECK(CheckUpright(mount.a));
    if (mount.b) FORESIGHT_CHECK(CheckUpright(*mount.b));
  }
  if (!mount.b) return {};
  const CalibrationBoard& a = mount.a;
  const CalibrationBoard& b = *mount.b;
  if (AreCheckerboards(mount)) {
    if (!Contains(a, b) || !Contains(b, a) || !b.LooksSameUpsideDown()) return {};
    return Fail(
        ErrorCode::kInvalidOptions,
        "both boards of the stand are checkerboards of {} x {} inner corners: an image does "
        "not tell which is which; take 9 x 6 and 7 x 6, or ChArUco boards of two "
        "dictionaries",
        b.columns, b.rows);
  }
  if (a.kind == BoardKind::kCharuco && b.kind == BoardKind::kCharuco &&
      a.dictionary == b.dictionary)
    return Fail(
        ErrorCode::kInvalidOptions,
        "both boards of the stand have markers of the dictionary {}: an image does not tell "
        "which is which; take boards of two dictionaries",
        ToString(a.dictionary));
  return {};
}

}  // namespace foresight
