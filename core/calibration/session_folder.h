#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/image.h"
#include "core/calibration/session_index.h"

namespace foresight {

/// What a session is recorded with.
struct SessionSetup {
  std::string name = "unnamed";
  BoardMount mount;
  CalibrationBoard intrinsic_board;
  SensorRig prior;  ///< as CalibrationSession has it
};

/// One capture of a session, or one place of the stand with all that was captured there; numbers
/// count from 0 in the lists of SessionIndex, and never change.
struct SessionCapture {
  enum class Kind { kIntrinsicImage, kPose, kStop, kStopImage, kStopLines, kSweep };
  Kind kind = Kind::kIntrinsicImage;
  int pose = -1;
  int number = -1;

  bool operator==(const SessionCapture&) const = default;
};

/// What the head captured at one stop.
struct RecordedStop {
  double commanded_rad = 0.0;
  std::optional<double> measured_rad;  ///< mean of the encoder while the head stood
  std::optional<ColorImage> image;
  std::vector<LidarLine> lines;
};

/// A calibration session's folder (docs/formats.md) while it is recorded, for
/// ReadCalibrationSession. Each call ends with everything on the disk: files first, then
/// session.yaml, which is replaced as a whole, so a folder that is cut off at any moment opens with
/// all that was complete. Nothing is ever deleted or written over: what is excluded stays, and can
/// be taken in again. A call that fails changes nothing. One thread at a time; calls wait for the
/// disk.
class SessionFolder {
 public:
  /// `folder` is made where it is not there. Fails with kInvalidInput, kInvalidOptions (also for
  /// boards that images do not tell apart); with kIo where it has files.
  static Result<SessionFolder> Create(const std::filesystem::path& folder,
                                      const SessionSetup& setup);
  /// Goes on with a session. Its files are not looked at. Fails with kIo, kBadData.
  static Result<SessionFolder> Open(const std::filesystem::path& folder);

  const std::filesystem::path& Path() const { return folder_; }
  const SessionIndex& Index() const { return index_; }
  const SensorRig& Prior() const { return prior_; }

  /// Other boards than was thought; the images stay. Fails as Create.
  Status SetBoards(const BoardMount& mount, const CalibrationBoard& intrinsic_board);

  /// `origin` is the image as people know it. Fails with kInvalidInput where it has another size
  /// than the camera's.
  Result<SessionCapture> AddIntrinsicImage(const ColorImage& image, const std::string& origin);
  /// The same of a file's bytes: PNG, JPEG or PGM. Fails with kBadData where they are damaged.
  Result<SessionCapture> AddIntrinsicFile(std::string_view bytes, const std::string& origin);

  /// The stand was put to another place. Without a name it is "pose N".
  Result<SessionCapture> AddPose(const std::string& name = {});
  /// A stop at an angle that was captured here already excludes the earlier one. Fails with
  /// kInvalidInput for images and lines of another camera or lidar.
  Result<SessionCapture> AddStop(int pose, const RecordedStop& stop);
  /// A further sweep excludes the earlier one.
  Result<SessionCapture> AddSweep(int pose, const MountSweep& sweep);

  /// Which of some captures are excluded.
  using LeftOut = std::vector<std::pair<SessionCapture, bool>>;
  /// Leaves a capture out of the calibration, or takes it in again, which leaves out what it takes
  /// the place of: the undo of AddStop is to take in the stop before, or to exclude the stop.
  /// Returns how it was before: of the capture, and of all that take its place or it theirs.
  /// @pre the capture is there
  Result<LeftOut> SetExcluded(const SessionCapture& capture, bool excluded);
  /// Goes back to how captures were before; one that came since is left out where one that is taken
  /// in takes its place. Returns as SetExcluded. @pre the captures are there
  Result<LeftOut> Restore(const LeftOut& before);
  /// Whether it takes part in the calibration.
  bool Used(const SessionCapture& capture) const;

 private:
  SessionFolder(std::filesystem::path folder, SessionIndex index, SensorRig prior);

  Result<SessionCapture> AddIntrinsicBytes(std::string_view bytes, const std::string& extension,
                                           const std::string& origin);
  Status CheckImageSize(int width, int height, const std::string& what) const;
  Status CheckLines(const std::vector<LidarLine>& lines, const std::string& what) const;
  Status MakeFolder(const std::string& name) const;
  /// Puts `index` on the disk and in force.
  Status Keep(SessionIndex index);

  std::filesystem::path folder_;
  SessionIndex index_;
  SensorRig prior_;
};

}  // namespace foresight
