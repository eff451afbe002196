#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/calibration/lens_model.h"
#include "core/objects/calibration_board.h"

namespace foresight {

/// One image of a session.
struct CameraSessionImage {
  std::string file;       ///< in the session's folder "images"
  std::string name;       ///< as people know it: the file that it came from
  bool excluded = false;  ///< by the operator

  bool operator==(const CameraSessionImage&) const = default;
};

/// A calibration of a camera that is under way, as a folder keeps it: camera_session.yaml, and the
/// images in "images". Nothing computed is kept; it is made again from the images.
struct CameraSession {
  CalibrationBoard board;
  std::vector<LensModel> models;
  std::vector<CameraSessionImage> images = {};

  bool operator==(const CameraSession&) const = default;
};

/// Whether the folder holds a session.
bool IsCameraSession(const std::filesystem::path& folder);
/// Where the images of a session are.
std::filesystem::path CameraSessionImages(const std::filesystem::path& folder);

/// The file is replaced as a whole, so that it is complete whenever the power goes. Makes the
/// folder where there is none. Fails with kIo.
Status SaveCameraSession(const CameraSession& session, const std::filesystem::path& folder);

/// Images that are in the folder and not in its file come last: the program ended before it could
/// list them. Fails with kIo; with kBadData, naming the line.
Result<CameraSession> LoadCameraSession(const std::filesystem::path& folder);

}  // namespace foresight
