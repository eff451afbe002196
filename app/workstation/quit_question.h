#pragma once

#include <QMessageBox>
#include <QObject>
#include <QPointer>

#include "ui/viewmodels/head_view_model.h"

namespace foresight {

/// Asks before a window closes in the middle of a sweep that is this station's: another operator's
/// goes on, and nobody is asked. The question holds nothing up, goes when
/// the sweep is over, and its default is to stay.
class QuitQuestion : public QObject {
  Q_OBJECT

 public:
  QuitQuestion(HeadViewModel* head, QWidget* window);

  /// Whether the window may close now. Where it may not, the operator is asked; if the answer is to
  /// quit, the head is stopped and the window closes when the scan has ended.
  bool MayClose();
  /// From now on nobody is asked.
  void Allow() { allowed_ = true; }
  /// The operator stays after all.
  void Forget() { allowed_ = quitting_ = false; }

 private:
  bool Sweeps() const;
  void Ask();
  void SayWhatItDoes();
  void CloseOnce();

  HeadViewModel* head_;
  QWidget* window_;
  QPointer<QMessageBox> question_;
  bool allowed_ = false;
  bool quitting_ = false;  ///< when the scan has ended
};

}  // namespace foresight
