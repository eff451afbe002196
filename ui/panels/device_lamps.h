#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "ui/viewmodels/head_view_model.h"

class QLabel;

namespace foresight {

/// The sign of a device's state; every state has its own shape, not only its own colour.
QPixmap LampPixmap(DeviceRow::Lamp lamp);

/// Lidar, camera and motor, and the link to a head elsewhere, at a glance: a lamp and a name each,
/// what is the matter in the tooltip and, when a device is not well, in words.
class DeviceLamps : public QWidget {
  Q_OBJECT

 public:
  explicit DeviceLamps(HeadViewModel* head, QWidget* parent = nullptr);

 private:
  struct Lamp {
    QLabel* sign;
    QLabel* name;
    std::optional<DeviceRow::Lamp> shown;
  };
  void Show();

  HeadViewModel* head_;
  std::vector<Lamp> lamps_;
};

}  // namespace foresight
