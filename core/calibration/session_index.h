#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/calibration/calibration_session.h"

namespace foresight {

/// Files are named as seen from the session's folder, and lie in it. What is excluded stays on the
/// disk and takes no part in a calibration.

/// One image, or the corners that were found in it; both empty = no image.
struct SessionViewFiles {
  std::string image;
  std::string corners;
  bool excluded = false;
  std::string origin = {};  ///< as people know the image: the file that it came from

  bool empty() const { return image.empty() && corners.empty(); }
  const std::string& File() const { return image.empty() ? corners : image; }
  bool operator==(const SessionViewFiles&) const = default;
};

struct SessionStopFiles {
  double motor_rad = 0.0;              ///< commanded
  std::optional<double> measured_rad;  ///< mean of the encoder while the head stood
  SessionViewFiles view;
  std::string lines;  ///< empty = none
  bool lines_excluded = false;
  bool excluded = false;  ///< the whole stop, e.g. because it was captured again

  bool operator==(const SessionStopFiles&) const = default;
};

struct SessionSweepFiles {
  std::string lines;
  std::string motor;
  bool excluded = false;

  bool operator==(const SessionSweepFiles&) const = default;
};

/// One place of the stand.
struct SessionPoseFiles {
  std::string name;
  std::vector<SessionStopFiles> stops;    ///< those that are not excluded are all different angles
  std::vector<SessionSweepFiles> sweeps;  ///< at most one is not excluded
  bool excluded = false;

  bool operator==(const SessionPoseFiles&) const = default;
};

/// What session.yaml says: where everything of a session is. The files are not looked at.
struct SessionIndex {
  std::string name = "unnamed";
  std::string rig = "rig.yaml";
  BoardMount mount;
  std::optional<CalibrationBoard> intrinsic_board;  ///< there where there are intrinsic views
  std::vector<SessionViewFiles> intrinsic_views;
  std::vector<SessionPoseFiles> poses;

  /// Fails with kInvalidInput, naming pose and stop.
  Status Check() const;
  bool operator==(const SessionIndex&) const = default;
};

/// Fails with kIo; with kBadData, naming the line of session.yaml.
Result<SessionIndex> ReadSessionIndex(const std::filesystem::path& folder);
/// Replaces session.yaml as a whole. Fails with kInvalidInput, kIo.
Status WriteSessionIndex(const SessionIndex& index, const std::filesystem::path& folder);

/// Whether the folder has a session.yaml.
bool IsCalibrationSession(const std::filesystem::path& folder);

}  // namespace foresight
