#pragma once

#include <QTemporaryDir>
#include <string>

#include "core/mission/mission_file.h"
#include "core/sensor/scan.h"

namespace foresight {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A mission with two scans of two seconds each, one minute apart. In the first one, a second after
/// its end the depth is computed, after three a valve is found, and after four it is accepted. Then
/// the link is lost, and there is a warning.
class MissionForReview {
 public:
  MissionForReview();

  QString Path() const { return path_; }
  QString Folder() const { return folder_.path(); }
  const Scan& First() const { return first_; }
  const Scan& Second() const { return second_; }
  std::int64_t FirstBegin() const;
  std::int64_t FirstEnd() const;
  std::int64_t SecondBegin() const;
  /// Another mission beside it, with the second scan alone.
  QString MakeAnother(const QString& name) const;
  /// All bytes of the file.
  std::string Bytes() const;

  static constexpr const char* kValve = "valve-of-the-first-scan";

 private:
  QTemporaryDir folder_;
  QString path_;
  Scan first_, second_;
};

}  // namespace foresight
