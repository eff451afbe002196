#pragma once

#include <QMessageBox>
#include <QObject>
#include <QPointer>
#include <QTimer>
#include <functional>

#include "ui/viewmodels/recording_view_model.h"

namespace foresight {

/// Asks before a window closes over what no file has taken (a full disk, a file that is another
/// program's), or over a mission file that was moved or deleted. Writes it once more first. The
/// default is to stay. Holds nothing up: the head can be stopped meanwhile.
class UnsavedQuestion : public QObject {
  Q_OBJECT

 public:
  /// `choose_file` lets the operator record into another file.
  UnsavedQuestion(RecordingViewModel* recording, std::function<void()> choose_file,
                  QWidget* window);

  /// Whether the window may close now. Where it may not, it closes by itself as soon as all is
  /// written, or the operator is asked.
  bool MayClose();

 Q_SIGNALS:
  void stayed();  ///< the operator does not want the window to close

 private:
  bool Asks() const;
  void GoOn();
  void CloseNow();
  void Ask();
  QString WhatIsNotSafe() const;

  RecordingViewModel* recording_;
  std::function<void()> choose_file_;
  QWidget* window_;
  QPointer<QMessageBox> question_;
  QTimer last_try_;       ///< runs while the window waits for what is being written
  bool allowed_ = false;  ///< to lose it, while the window closes
};

}  // namespace foresight
