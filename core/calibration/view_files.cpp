#include "core/calibration/view_files.h"

#include <algorithm>

#include "core/calibration/board_detector.h"
#include "core/calibration/mount_detector.h"
#include "core/calibration/session_tables.h"
#include "core/io/image_file.h"

namespace foresight {

namespace fs = std::filesystem;

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

SessionViewFiles ViewFromYaml(YamlMap& map) {
  SessionViewFiles view{.image = OptionalFileNameFromYaml(map, "image"),
                        .corners = OptionalFileNameFromYaml(map, "corners"),
                        .origin = map.Text("origin", "")};
  if (!view.image.empty() && !view.corners.empty())
    map.Fault(map.Node("image"), "a view has an image or corners, not both");
  return view;
}

Result<MountView> ReadView(const fs::path& folder, const SessionViewFiles& files,
                           const CameraModel& camera, const BoardMount& mount,
                           SearchEffort effort) {
  MountView view;
  if (!files.corners.empty()) {
    FORESIGHT_TRY(view, ReadCorners(folder / files.corners));
    view.source = files.corners;
    return view;
  }
  const fs::path file = folder / files.image;
  FORESIGHT_TRY(const GrayImage image, ReadImageGray(file));
  if (image.width() != camera.width || image.height() != camera.height)
    return Fail(ErrorCode::kBadData, "{}: {} x {} pixels, the rig's camera has {} x {}",
                file.string(), image.width(), image.height(), camera.width, camera.height);
  if (mount.b) {
    view = DetectMount(image, mount, camera);
  } else if (BoardDetection found = DetectBoard(image, mount.a, effort); found.rejection.empty()) {
    view.a = std::move(found.view);
  } else {
    view.fault = std::move(found.rejection);
  }
  view.source = files.image;
  return view;
}

}  // namespace foresight
