#pragma once

#include <QMessageBox>
#include <QObject>
#include <QPointer>
#include <functional>

#include "ui/viewmodels/recording_view_model.h"

namespace foresight {

/// Asks before a window closes over scans, objects and decisions that no file has taken: a full
/// disk, a file that is another program's. Writes them once more first. The default is to stay.
class UnsavedQuestion : public QObject {
  Q_OBJECT

 public:
  /// `choose_file` lets the operator record into another file.
  UnsavedQuestion(RecordingViewModel* recording, std::function<void()> choose_file,
                  QWidget* window);

  /// Whether the window may close now. Where it may not, the operator is asked. Runs the event loop
  /// for some seconds while a last try writes.
  bool MayClose();

 private:
  void Ask();

  RecordingViewModel* recording_;
  std::function<void()> choose_file_;
  QWidget* window_;
  QPointer<QMessageBox> question_;
  bool allowed_ = false;
  bool trying_ = false;
};

}  // namespace foresight
