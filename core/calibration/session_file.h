#pragma once

#include <filesystem>
#include <map>

#include "core/base/run_context.h"
#include "core/calibration/calibration_session.h"

namespace foresight {

/// What was found in the images of a session, by their files' names. Files of a session never
/// change, so it stays true as long as the session's boards are the same.
struct FoundViews {
  std::map<std::string, MountView> intrinsic;  ///< the intrinsic board is `a`
  std::map<std::string, MountView> stops;
};

/// Reads a session's folder, docs/formats.md. Boards are looked for in its images, on all threads;
/// an intrinsic image without a board is left out, a stop's image then shows nothing. What is
/// excluded is not read. Everything is checked, and an error names the file and the place in it.
/// Files outside of the folder are refused. Images in `found` are not looked at again, others are
/// added to it.
Result<CalibrationSession> ReadCalibrationSession(const std::filesystem::path& folder,
                                                  const RunContext& context,
                                                  FoundViews* found = nullptr);

/// What stands for the intrinsic views in a session's files; stops have corners.
enum class SessionViews { kCorners, kImages };

/// Writes a session into `folder`, which is made where it is not there; one that has files is
/// refused. With kImages, session.yaml names an image of every intrinsic view instead of its
/// corners, and the caller writes it. Reading gives the same session, but for the last digits of
/// motor angles.
Status WriteCalibrationSession(const CalibrationSession& session,
                               const std::filesystem::path& folder,
                               SessionViews views = SessionViews::kCorners);

/// SHA-256 of everything that was measured, the boards and the rig it was measured with: 64
/// hexadecimal digits. Two sessions of one hash give the same calibration, whatever their files and
/// they themselves are called. O(ranges).
std::string SessionHash(const CalibrationSession& session);

/// The image that session.yaml names then, in the session's folder.
std::string ImageNameOfView(std::size_t view);

}  // namespace foresight
