#pragma once

#include <QObject>

#include "ui/viewmodels/review_view_model.h"
#include "ui/viewmodels/scan_check_model.h"

namespace foresight {

/// Brings the checks that were kept with a mission's scans to the review's lamp, the newest of the
/// mission and of its review, and keeps a check that is made meanwhile beside the mission.
class ReviewCheckFlow : public QObject {
  Q_OBJECT

 public:
  ReviewCheckFlow(ReviewViewModel* review, SessionModel* session, ScanCheckModel* check,
                  QObject* parent = nullptr);

  /// How often the mission was asked for a check that was kept.
  int ReadCount() const { return read_count_; }

 private:
  void FindKept();
  void ShowNewest(const std::vector<KeptCheck>& checks, const std::string& scan_uuid);
  void Keep(const KeptCheck& check);

  ReviewViewModel* review_;
  SessionModel* session_;
  ScanCheckModel* check_;
  TaskRunner reader_{session_->Tasks()};
  std::string asked_for_;  ///< scan that a check was looked for, whether one was found or not
  int read_count_ = 0;
};

}  // namespace foresight
