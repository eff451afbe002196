#include "core/calibration/view_files.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/board_detector.h"
#include "core/calibration/number_table.h"
#include "core/io/image_file.h"

namespace foresight {
namespace {

namespace fs = std::filesystem;

const NumberTable kCornerTable{{"board", "corner", "u", "v"}, false, "ab"};

Result<MountView> ReadCorners(const fs::path& path) {
  MountView view;
  const auto on_row = [&](int line, std::span<const double> row) -> Status {
    if (row[0] != 0.0 && row[0] != 1.0)
      return Fail(ErrorCode::kBadData, "{}:{}: the board is a or b", path.string(), line);
    if (row[1] < 0.0 || row[1] > 10000.0 || row[1] != std::floor(row[1]))
      return Fail(ErrorCode::kBadData, "{}:{}: {} is no corner", path.string(), line, row[1]);
    auto& board = row[0] == 0.0 ? view.a : view.b;
    if (!board) board.emplace();
    board->corner_ids.push_back(static_cast<int>(row[1]));
    board->pixels.emplace_back(row[2], row[3]);
    return {};
  };
  FORESIGHT_CHECK(ReadNumberTable(path, kCornerTable, on_row));
  return view;
}

}  // namespace

const char* const kCornerHeader = "board,corner,u,v\n";

std::string FileNameFromYaml(YamlMap& map, const std::string& key) {
  const std::string name = map.Text(key);
  const fs::path path(name);
  const bool leaves =
      path.is_absolute() ||
      std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  if (name.empty() || leaves)
    map.Fault(map.Node(key), "'" + key + "' is not a file in the session's folder");
  return name;
}

std::string OptionalFileNameFromYaml(YamlMap& map, const std::string& key) {
  return map.Has(key) ? FileNameFromYaml(map, key) : std::string();
}

CalibrationBoard BoardFromYaml(YamlMap& map, const std::string& key) {
  const auto board = CalibrationBoardFromText(map.Text(key));
  if (!board) map.Fault(map.Node(key), board.error().message);
  return *board;
}

ViewEntry ViewFromYaml(YamlMap& map) {
  ViewEntry view{OptionalFileNameFromYaml(map, "image"), OptionalFileNameFromYaml(map, "corners")};
  if (!view.image.empty() && !view.corners.empty())
    map.Fault(map.Node("image"), "a view has an image or corners, not both");
  return view;
}

Result<MountView> ReadView(const fs::path& folder, const ViewEntry& entry,
                           const CameraModel& camera, const CalibrationBoard* a,
                           const CalibrationBoard* b, SearchEffort effort) {
  MountView view;
  if (!entry.corners.empty()) {
    FORESIGHT_TRY(view, ReadCorners(folder / entry.corners));
    view.source = entry.corners;
    return view;
  }
  view.source = entry.image;
  const fs::path file = folder / entry.image;
  FORESIGHT_TRY(const GrayImage image, ReadImageGray(file));
  if (image.width() != camera.width || image.height() != camera.height)
    return Fail(ErrorCode::kBadData, "{}: {} x {} pixels, the rig's camera has {} x {}",
                file.string(), image.width(), image.height(), camera.width, camera.height);
  const auto find = [&](const CalibrationBoard* board, std::optional<BoardView>* found) {
    if (board == nullptr) return;
    BoardDetection detection = DetectBoard(image, *board, effort);
    if (detection.rejection.empty()) *found = std::move(detection.view);
  };
  find(a, &view.a);
  find(b, &view.b);
  return view;
}

}  // namespace foresight
