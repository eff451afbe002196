#include "core/calibration/locate_board.h"

#include "core/calibration/board_pose.h"

namespace foresight {

Result<LocatedBoard> LocateBoard(const CameraModel& camera, const CalibrationBoard& board,
                                 const BoardView& view, const std::string& source) {
  constexpr std::size_t kLeastCorners = 6;
  if (view.corner_ids.size() < kLeastCorners)
    return Fail(ErrorCode::kTooFewPoints,
                "{}: {} corners of the board are seen, at least {} are needed", source,
                view.corner_ids.size(), kLeastCorners);
  const auto pose = FindBoardPose(board, view, camera);
  if (!pose)
    return Fail(ErrorCode::kTooFewPoints,
                "{}: the {} corners lie on a line, or outside of what the camera can see", source,
                view.corner_ids.size());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int id : view.corner_ids)
    centre += board.Corner(id) / static_cast<double>(view.corner_ids.size());
  const CameraFromPattern& found = pose->camera_from_pattern;
  if (found.Rotate(Eigen::Vector3d::UnitZ()).dot(found * centre) < 0.0)
    return Fail(ErrorCode::kInvalidInput,
                "{}: the board is seen from behind, so its corners are mirrored. Check the image "
                "and the print, and that columns and rows are not exchanged",
                source);
  return LocatedBoard{found, pose->rms_px};
}

}  // namespace foresight
