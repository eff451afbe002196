#pragma once

#include <QObject>

#include "core/registration/growing_registration.h"
#include "ui/viewmodels/head_view_model.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Brings a scan from the head into the session: the points while they arrive, over a link also
/// those behind a gap, and the whole scan at its end. Depth follows by itself, because the session
/// has a new scan then.
class ScanFlow : public QObject {
  Q_OBJECT

 public:
  ScanFlow(HeadViewModel* head, SessionModel* session, QObject* parent = nullptr);

 private:
  void Begin();
  void Grow(const std::shared_ptr<const Scan>& scan);
  void Come(const std::shared_ptr<const EarlyScan>& early);
  /// What of a scan can be placed for good, and where.
  struct Placed {
    RegisteredScan cloud;
    std::shared_ptr<const Scan> part;
  };
  void Show(Result<Placed> placed, int of_lines);
  void End(const std::shared_ptr<const Scan>& scan);

  HeadViewModel* head_;
  SessionModel* session_;
  std::shared_ptr<GrowingRegistration>
      points_;  ///< of the running scan; one task at a time uses it
  TaskRunner runner_{session_->Tasks()};
};

}  // namespace foresight
