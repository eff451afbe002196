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
#include "core/fitting/valve/valve_detection.h"
#include "core/registration/register_scan.h"
#include "core/sensor/scan.h"
#include "ui/viewmodels/notice.h"

namespace foresight {

/// Where the data on the screen come from.
enum class SessionMode { kLive, kSimulation, kReplay };

/// A valve that was found, with where it comes from.
struct FoundValve {
  ValveDetection detection;
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

  void SetRoi(std::optional<ImageRoi> roi);
  const std::optional<ImageRoi>& Roi() const { return roi_; }
  bool CanUndoRoi() const { return !roi_history_.empty(); }

  void AddValve(FoundValve valve);
  void ClearValves();
  const std::vector<FoundValve>& Valves() const { return valves_; }
  int SelectedValve() const { return selected_valve_; }
  void SelectValve(int index);
  /// Whether a found valve belongs to the scan on the screen.
  bool IsCurrent(const FoundValve& valve) const;

  void Report(const Notice& notice) { Q_EMIT noticed(notice); }

 public Q_SLOTS:
  void undoRoi();

 Q_SIGNALS:
  void modeChanged();
  void scanChanged();
  void pictureChanged();
  void cloudChanged();
  void depthChanged();
  void maskChanged();
  void roiChanged();
  void valvesChanged();
  void noticed(const foresight::Notice& notice);

 private:
  SessionMode mode_;
  std::shared_ptr<const Scan> scan_;
  bool expects_scan_ = false;
  int picture_ = -1;
  std::shared_ptr<const RegisteredScan> cloud_;
  SensorRig rig_;
  std::shared_ptr<const DepthResult> depth_;
  std::shared_ptr<const MaskImage> mask_;
  std::optional<ImageRoi> roi_;
  std::vector<std::optional<ImageRoi>> roi_history_;
  std::vector<FoundValve> valves_;
  int selected_valve_ = -1;
};

}  // namespace foresight
