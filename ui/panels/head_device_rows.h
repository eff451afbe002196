#pragma once

#include <QWidget>
#include <array>

#include "ui/viewmodels/head_view_model.h"

class QLabel;

namespace foresight {

/// How lidar, camera and motor do: a row a device, an icon and words.
class HeadDeviceRows : public QWidget {
  Q_OBJECT

 public:
  explicit HeadDeviceRows(HeadViewModel* head, QWidget* parent = nullptr);

 private:
  struct Row {
    QLabel* lamp;
    QLabel* title;
    QLabel* detail;
  };
  void Show();

  HeadViewModel* head_;
  std::array<Row, 3> rows_;
};

}  // namespace foresight
