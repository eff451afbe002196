#pragma once

#include <QPointer>
#include <memory>

#include "app/workstation/connect_model.h"
#include "app/workstation/workbench.h"

namespace foresight {

class ConnectDialog;

/// The command that connects to another head, its dialogue, and the addresses that were used.
class HeadSwitch : public QObject {
  Q_OBJECT

 public:
  /// @param keys folder of this station's keys, empty = the user's.
  HeadSwitch(Workbench* bench, std::string keys);
  ~HeadSwitch() override;

  /// Above which window the dialogue opens.
  void Use(QWidget* window) { window_ = window; }
  std::optional<OpenedHead> TakeHead() { return model_->TakeHead(); }

 Q_SIGNALS:
  void opened();  ///< TakeHead has the head that takes the present one's place

 private:
  void Open();

  Workbench* bench_;
  const std::string keys_;
  QWidget* window_ = nullptr;
  std::unique_ptr<ConnectModel> model_;  ///< when it was first asked for
  QPointer<ConnectDialog> dialog_;
};

}  // namespace foresight
