#include "core/evaluation/board_search_trial.h"

#include <algorithm>
#include <chrono>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/calibration/mount_detector.h"
#include "core/calibration/session_index.h"
#include "core/io/image_file.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;
using CameraFromBoard = Rigid<frame::Camera, frame::Pattern>;

/// A board as the camera has it before it.
struct PlacedBoard {
  CalibrationBoard board;
  CameraFromBoard camera_from_board;
  std::vector<std::optional<Eigen::Vector2d>> corners;
  bool whole = false;
};

bool Within(const GrayImage& image, const std::optional<Eigen::Vector2d>& pixel) {
  return pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() <= image.width() - 1.0 &&
         pixel->y() <= image.height() - 1.0;
}

PlacedBoard Placed(const BoardTruth& truth, const Rigid<frame::Camera, frame::Robot>& camera,
                   const CameraModel& model, const GrayImage& image) {
  PlacedBoard placed{truth.board, camera * truth.robot_from_pattern, {}};
  const auto project = [&](const Eigen::Vector3d& point) {
    return model.Project(placed.camera_from_board * point);
  };
  const Eigen::Vector3d middle = placed.camera_from_board * (0.5 * truth.corners.back());
  placed.whole = placed.camera_from_board.Rotate(Eigen::Vector3d::UnitZ()).dot(middle) > 0.0;
  for (const Eigen::Vector3d& corner : truth.corners) placed.corners.push_back(project(corner));
  for (const auto& corner : placed.corners) placed.whole = placed.whole && Within(image, corner);
  for (const Eigen::Vector3d& corner : truth.board.Outline())
    placed.whole = placed.whole && Within(image, project(corner));
  return placed;
}

/// Fills what is seen of a polygon in the board's plane, and says which of its corners are under
/// it.
void Cover(const std::vector<Eigen::Vector2d>& polygon_m, const CameraModel& model, double grey,
           GrayImage* image, PlacedBoard* placed) {
  std::vector<cv::Point> outline;
  std::vector<cv::Point2f> plane;
  for (std::size_t i = 0; i < polygon_m.size(); ++i) {
    const Eigen::Vector2d& from = polygon_m[i];
    const Eigen::Vector2d& to = polygon_m[(i + 1) % polygon_m.size()];
    plane.emplace_back(static_cast<float>(from.x()), static_cast<float>(from.y()));
    for (const double t : {0.0, 0.2, 0.4, 0.6, 0.8}) {  // straight lines are bent by the lens
      const Eigen::Vector2d p = from + t * (to - from);
      if (const auto pixel =
              model.Project(placed->camera_from_board * Eigen::Vector3d(p.x(), p.y(), 0.0)))
        outline.emplace_back(static_cast<int>(std::lround(pixel->x())),
                             static_cast<int>(std::lround(pixel->y())));
    }
  }
  if (outline.size() < 3) return;
  cv::Mat pixels(image->height(), image->width(), CV_8UC1, image->data());
  cv::fillPoly(pixels, std::vector<std::vector<cv::Point>>{outline}, cv::Scalar(grey));
  for (int id = 0; id < placed->board.CornerCount(); ++id) {
    const Eigen::Vector3d corner = placed->board.Corner(id);
    if (cv::pointPolygonTest(
            plane, {static_cast<float>(corner.x()), static_cast<float>(corner.y())}, false) >= 0.0)
      placed->whole = false;
  }
}

std::vector<Eigen::Vector2d> RandomCover(const CalibrationBoard& board, Random& random) {
  const double square = board.square_m;
  const double right = board.columns * square, bottom = board.rows * square;
  if (random.Uniform(0.0, 1.0) < 0.5) {
    const Eigen::Vector2d middle(random.Uniform(-square, right), random.Uniform(-square, bottom));
    const double radius = random.Uniform(0.6, 2.0) * square;
    std::vector<Eigen::Vector2d> disc;
    disc.reserve(16);
    for (int i = 0; i < 16; ++i)
      disc.push_back(middle +
                     radius * Eigen::Vector2d(std::cos(i * M_PI / 8.0), std::sin(i * M_PI / 8.0)));
    return disc;
  }
  double from_x = -2.0 * square, to_x = right + square, from_y = -2.0 * square,
         to_y = bottom + square;
  const double depth = random.Uniform(0.3, 3.5) * square;  // of the squares that it covers
  switch (static_cast<int>(random.Uniform(0.0, 4.0))) {
    case 0:
      to_x = -square + depth;
      break;
    case 1:
      from_x = right - depth;
      break;
    case 2:
      to_y = -square + depth;
      break;
    default:
      from_y = bottom - depth;
      break;
  }
  return {{from_x, from_y}, {to_x, from_y}, {to_x, to_y}, {from_x, to_y}};
}

void Compare(const std::optional<BoardView>& found, const PlacedBoard& placed,
             BoardSearchOutcome* outcome) {
  outcome->whole = placed.whole;
  outcome->found = found.has_value();
  if (!found) return;
  outcome->worst_px = 0.0;
  for (std::size_t i = 0; i < found->corner_ids.size(); ++i) {
    const auto& corner = placed.corners[static_cast<std::size_t>(found->corner_ids[i])];
    outcome->worst_px =
        std::max(outcome->worst_px, corner ? (*corner - found->pixels[i]).norm() : 1e9);
  }
}

/// The session's boards are those of the scene, in their order.
Status CheckBoards(const BoardMount& mount, const Scene& scene, const fs::path& session) {
  std::vector<CalibrationBoard> boards = {mount.a};
  if (mount.b) boards.push_back(*mount.b);
  if (scene.boards.size() != boards.size())
    return Fail(ErrorCode::kBadData, "{}: the session's stand has {} boards, the scene's {}",
                session.string(), boards.size(), scene.boards.size());
  for (std::size_t i = 0; i < boards.size(); ++i)
    if (!(scene.boards[i].board == boards[i]))
      return Fail(ErrorCode::kBadData,
                  "{}: board {} of the session is {}, that of the scene {}; take the scene that "
                  "the session was recorded in",
                  session.string(), "AB"[i], ToText(boards[i]), ToText(scene.boards[i].board));
  return {};
}

}  // namespace

Result<BoardSearchTrial> RunBoardSearchTrial(const fs::path& session, const World& world,
                                             const BoardSearchTrialOptions& options,
                                             const RunContext& context) {
  FORESIGHT_TRY(const SessionIndex index, ReadSessionIndex(session));
  FORESIGHT_TRY(const SensorRig prior, LoadSensorRig(session / index.rig));
  const SensorRig& rig = world.true_rig();
  BoardSearchTrial trial;
  Random random(options.cover_seed);
  for (const SessionPoseFiles& pose : index.poses) {
    const auto& places = world.scene().places;
    const auto place = std::find_if(places.begin(), places.end(),
                                    [&](const StandPlace& p) { return p.name == pose.name; });
    if (place == places.end())
      return Fail(ErrorCode::kBadData, "{}: pose '{}' is no place of scene '{}'", session.string(),
                  pose.name, world.scene().name);
    const Scene there = AtPlace(world.scene(), static_cast<int>(place - places.begin()) + 1);
    FORESIGHT_CHECK(CheckBoards(index.mount, there, session));
    for (const SessionStopFiles& stop : pose.stops) {
      if (context.Cancelled()) return Fail(ErrorCode::kCancelled, "search for boards: cancelled");
      if (stop.view.image.empty()) continue;
      FORESIGHT_TRY(GrayImage image, ReadImageGray(session / stop.view.image));
      const auto camera_from_robot = rig.camera_from_head *
                                     HeadFromBase(world.PlateAngle(stop.motor_rad, true)) *
                                     world.BaseFromRobot();
      std::vector<PlacedBoard> placed;
      for (const BoardTruth& truth : there.boards) {
        placed.push_back(Placed(truth, camera_from_robot, rig.camera, image));
        if (options.cover && random.Uniform(0.0, 1.0) < 0.5)
          Cover(RandomCover(truth.board, random), rig.camera, random.Uniform(0.0, 255.0), &image,
                &placed.back());
      }
      const auto start = std::chrono::steady_clock::now();
      const MountView view = DetectMount(image, index.mount, prior.camera);
      trial.search_s +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      for (std::size_t i = 0; i < placed.size() && i < 2; ++i) {
        BoardSearchOutcome& outcome = trial.boards.emplace_back();
        outcome.image = stop.view.image;
        outcome.board = i == 0 ? 'A' : 'B';
        Compare(i == 0 ? view.a : view.b, placed[i], &outcome);
      }
    }
  }
  return trial;
}

}  // namespace foresight
