#pragma once

#include <QObject>
#include <QString>
#include <QTimer>

#include "core/mission/mission_index.h"
#include "ui/viewmodels/review_view_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Searches all missions of a folder while the operator types, as `foresightctl mission search`
/// does, and opens what was found for review.
class MissionSearchModel : public QObject {
  Q_OBJECT

 public:
  /// What a search is limited to.
  enum class What { kEverything, kScans, kObjects, kAccepted, kRejected, kLog };

  MissionSearchModel(ReviewViewModel* review, TaskQueue* tasks, QString folder,
                     QObject* parent = nullptr);

  QString Folder() const { return folder_; }
  QString Text() const { return text_; }
  /// The newest first, at most kAtMost.
  const std::vector<MissionHit>& Hits() const { return found_.hits; }
  /// "12 found in 40 missions", why nothing could be searched, or that it is being done.
  QString Summary() const;
  /// One line a mission that could not be read.
  const std::vector<std::string>& Unreadable() const { return found_.unreadable; }
  bool Busy() const { return runner_.Busy(); }

  void SetFolder(const QString& folder);
  /// Words that all must be there.
  void SetText(const QString& text);
  void SetWhat(What what);
  /// Opens the mission for review and shows the scan.
  void Open(int hit);

  static constexpr std::size_t kAtMost = 500;

 public Q_SLOTS:
  /// At once.
  void search();

 Q_SIGNALS:
  void changed();
  void folderChanged();

 private:
  MissionQuery Query() const;

  ReviewViewModel* review_;
  TaskRunner runner_;
  QString folder_;
  QString text_;
  What what_ = What::kEverything;
  MissionHits found_;
  QString problem_;
  bool searched_ = false;
  QTimer wait_;
};

}  // namespace foresight
