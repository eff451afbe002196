#pragma once

#include <QObject>
#include <QString>
#include <QStringList>

#include "core/exchange/assemble_scan.h"
#include "ui/viewmodels/session_model.h"
#include "ui/viewmodels/task_runner.h"

namespace foresight {

/// Makes missions of other programs' files (core/exchange/import_mission.h).
class ImportViewModel : public QObject {
  Q_OBJECT

 public:
  /// What it has to say goes to the session.
  explicit ImportViewModel(SessionModel* session, QObject* parent = nullptr);

  TaskRunner* Runner() { return &runner_; }
  /// Into a new file in `folder` that is named after the first of the files; nothing is replaced.
  /// One import after the other, each can be cancelled.
  void Import(const QStringList& files, const QString& folder, const ImportOptions& options = {});

 Q_SIGNALS:
  void imported(const QString& mission);

 private:
  SessionModel* session_;
  TaskRunner runner_{session_->Tasks(), TaskPolicy::kQueue};
};

}  // namespace foresight
