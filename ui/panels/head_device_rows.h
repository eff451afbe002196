#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "ui/viewmodels/head_view_model.h"

class QLabel;

namespace foresight {

/// How lidar, camera and motor do: a row a device, an icon and words; the tip says which rig is in
/// force.
class HeadDeviceRows : public QWidget {
  Q_OBJECT

 public:
  explicit HeadDeviceRows(HeadViewModel* head, QWidget* parent = nullptr);

 protected:
  bool event(QEvent* event) override;

 private:
  struct Row {
    QLabel* lamp;
    QLabel* title;
    QLabel* detail;
    std::optional<DeviceRow::Lamp> shown;
  };
  void Show();

  HeadViewModel* head_;
  std::vector<Row> rows_;
};

}  // namespace foresight
