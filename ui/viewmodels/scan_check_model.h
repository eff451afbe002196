#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "core/mission/gather_checks.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// What the scan on the screen says about itself (core/selfcheck), and all scans of its mission
/// that were taken with its rig together, for a lamp. Where `automatic`, each whole scan is checked
/// by itself when its depth map is there, or at once where it has no image; else a check that was
/// kept is shown, or one is made when asked for. One task in the background, which any other thread
/// goes before; another scan cancels it.
class ScanCheckModel : public QObject {
  Q_OBJECT

 public:
  enum class State {
    kNoScan,
    kNotChecked,
    kChecking,
    kChecked,
    kFailed,  ///< or it was cancelled; Failure() says why
  };

  explicit ScanCheckModel(SessionModel* session, QObject* parent = nullptr);

  /// False until it is set: the scans of a review were checked when they were taken.
  void SetAutomatic(bool automatic) { automatic_ = automatic; }

  State Now() const { return state_; }
  /// Of the scan on the screen; nullptr unless kChecked.
  const KeptCheck* Check() const { return check_ ? &*check_ : nullptr; }
  const QString& Failure() const { return failure_; }
  /// What the scans of the mission that have the rig of the scan on the screen say together;
  /// nullptr unless kChecked, and where fewer than two were checked.
  const GatheredCheck* Together() const { return together_ ? &*together_ : nullptr; }
  /// The colour of the lamp: that of the scan, or of all scans together where these are amber or
  /// red and graver. kNotSeen unless kChecked.
  CheckLight Light() const;
  /// One sentence beside the lamp, in every state.
  QString Sentence() const;
  TaskRunner* Runner() { return &runner_; }

  /// From now on scans are of another mission: those that were checked before take no part in what
  /// scans say together, and neither does `scan_of_before`, which may be checked later.
  void BeginMission(const std::string& scan_of_before = {});
  /// What other scans of the mission said. The checks that are made or shown are among them.
  void AddKept(const std::vector<KeptCheck>& checks);
  /// Shows a check out of a file; ignored where it is of another scan than the one on the screen.
  void ShowKept(const KeptCheck& check);

 public Q_SLOTS:
  /// Checks the scan on the screen with its depth map's options, in place of a check that runs.
  /// Accepted objects of the scan are fitted again. Nothing without a whole scan and its points.
  void check();
  void cancel() { runner_.cancel(); }

 Q_SIGNALS:
  void changed();
  /// A check has ended and wants to be kept.
  void checked(const foresight::KeptCheck& check);

 private:
  void FollowScan();
  void FollowParts();
  bool IsOnScreen(const Scan& scan) const;
  void Set(State state);
  void SetChecked(KeptCheck check);
  void Gather();
  bool TogetherIsGraver() const;
  std::vector<DetectionRecord> AcceptedRecords() const;

  SessionModel* session_;
  TaskRunner runner_{session_->Tasks()};
  bool automatic_ = false;
  std::shared_ptr<const Scan> scan_;  ///< that the state is of
  State state_ = State::kNoScan;
  std::optional<KeptCheck> check_;
  std::vector<KeptCheck> of_mission_;
  std::string scan_of_before_;  ///< uuid; empty = none
  std::optional<GatheredCheck> together_;
  QString failure_;
};

}  // namespace foresight
