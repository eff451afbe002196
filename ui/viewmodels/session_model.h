#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/depth/pipeline.h"
#include "core/detection/detection.h"
#include "core/registration/register_scan.h"
#include "core/sensor/scan.h"
#include "ui/viewmodels/notice.h"

namespace foresight {

/// Where the data on the screen come from.
enum class SessionMode { kLive, kSimulation, kReplay };

/// An object that was found, with where it comes from.
struct FoundObject {
  Detection detection;
  SensorRig rig;  ///< of the scan it was found in
  std::string scan_uuid;
  QDateTime scan_time;
  std::chrono::steady_clock::time_point found = std::chrono::steady_clock::now();
};

/// The document: the current scan and all that was made from it. Every part is immutable and
/// replaced as a whole; a part that no longer fits the scan is dropped, never shown as current.
class SessionModel : public QObject {
  Q_OBJECT

 public:
  explicit SessionModel(SessionMode mode, QObject* parent = nullptr);

  SessionMode Mode() const { return mode_; }
  void SetMode(SessionMode mode);

  /// A new scan: drops the points, depth and regions of the one before; found objects stay listed.
  void SetScan(std::shared_ptr<const Scan> scan);
  const std::shared_ptr<const Scan>& CurrentScan() const { return scan_; }
  /// Drops the scan as SetScan(nullptr) does, because a new one is on its way.
  void ExpectScan();
  bool ExpectsScan() const { return expects_scan_; }
  /// The scan that was expected will not come.
  void GiveUpScan();
  QDateTime ScanTime() const;

  void SelectPicture(int index);
  int PictureIndex() const { return picture_; }
  const CameraFrame* Picture() const;

  /// The points of the current scan, or of the part of it that has arrived.
  void SetCloud(std::shared_ptr<const RegisteredScan> cloud, const SensorRig& rig);
  const std::shared_ptr<const RegisteredScan>& Cloud() const { return cloud_; }
  /// The calibration that belongs to the points.
  const SensorRig& Rig() const { return rig_; }

  void SetDepth(std::shared_ptr<const DepthResult> depth);
  const std::shared_ptr<const DepthResult>& Depth() const { return depth_; }
  void SetMask(std::shared_ptr<const MaskImage> mask);
  const std::shared_ptr<const MaskImage>& Mask() const { return mask_; }

  void SetRoi(std::optional<Roi> roi);
  const std::optional<Roi>& Region() const { return roi_; }
  bool CanUndoRoi() const { return !roi_history_.empty(); }

  void AddObject(FoundObject object);
  void ClearObjects();
  const std::vector<FoundObject>& Objects() const { return objects_; }
  int SelectedObject() const { return selected_object_; }
  void SelectObject(int index);
  /// The selected object; nullptr = none.
  const FoundObject* Selected() const;
  /// Which answer of the selected object is looked at: 0 = the best (core/detection/candidates.h).
  int Candidate() const { return candidate_; }
  /// The candidate that is drawn of an object.
  int CandidateOf(std::size_t index) const {
    return static_cast<int>(index) == selected_object_ ? candidate_ : 0;
  }
  /// Whether a found object belongs to the scan on the screen.
  bool IsCurrent(const FoundObject& object) const;

  void Report(const Notice& notice) { Q_EMIT noticed(notice); }

 public Q_SLOTS:
  void undoRoi();
  /// The next or the last candidate of the selected object, round and round.
  void nextCandidate() { StepCandidate(1); }
  void previousCandidate() { StepCandidate(-1); }

 Q_SIGNALS:
  void modeChanged();
  void scanChanged();
  void pictureChanged();
  void cloudChanged();
  void depthChanged();
  void maskChanged();
  void roiChanged();
  void objectsChanged();
  void noticed(const foresight::Notice& notice);

 private:
  void StepCandidate(int by);

  SessionMode mode_;
  std::shared_ptr<const Scan> scan_;
  bool expects_scan_ = false;
  int picture_ = -1;
  std::shared_ptr<const RegisteredScan> cloud_;
  SensorRig rig_;
  std::shared_ptr<const DepthResult> depth_;
  std::shared_ptr<const MaskImage> mask_;
  std::optional<Roi> roi_;
  std::vector<std::optional<Roi>> roi_history_;
  std::vector<FoundObject> objects_;
  int selected_object_ = -1;
  int candidate_ = 0;
};

}  // namespace foresight
