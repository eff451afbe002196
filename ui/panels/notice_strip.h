#pragma once

#include <QFrame>

#include "ui/viewmodels/notice.h"

class QLabel;

namespace foresight {

/// Says what happened and what to do next, without stopping anything. Stays until it is closed or
/// something newer happens.
class NoticeStrip : public QFrame {
  Q_OBJECT

 public:
  explicit NoticeStrip(QWidget* parent = nullptr);
  const Notice& Shown() const { return notice_; }

 public Q_SLOTS:
  void show(const foresight::Notice& notice);

 private:
  QLabel* icon_;
  QLabel* text_;
  Notice notice_;
};

}  // namespace foresight
