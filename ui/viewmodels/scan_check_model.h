#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "core/mission/kept_check.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// What the scan on the screen says about itself (core/selfcheck), for a lamp. Where `automatic`,
/// each whole scan is checked by itself when its depth map is there, or at once where it has no
/// image; else a check that was kept is shown, or one is made when asked for. One task in the
/// background, which any other thread goes before; another scan cancels it.
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
  /// The colour of the lamp: kNotSeen unless kChecked.
  CheckLight Light() const { return check_ ? check_->light : CheckLight::kNotSeen; }
  /// One sentence beside the lamp, in every state.
  QString Sentence() const;
  TaskRunner* Runner() { return &runner_; }

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
  std::vector<DetectionRecord> AcceptedRecords() const;

  SessionModel* session_;
  TaskRunner runner_{session_->Tasks()};
  bool automatic_ = false;
  std::shared_ptr<const Scan> scan_;  ///< that the state is of
  State state_ = State::kNoScan;
  std::optional<KeptCheck> check_;
  QString failure_;
};

}  // namespace foresight
