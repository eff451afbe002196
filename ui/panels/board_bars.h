#pragma once

#include <QStringList>
#include <QWidget>
#include <vector>

#include "core/calibration/chain_residuals.h"

namespace foresight {

/// Residuals of each board at each place of the stand: corners in px, lidar in mm.
class BoardBars : public QWidget {
  Q_OBJECT

 public:
  explicit BoardBars(QWidget* parent = nullptr);

  /// `poses` are the names of the places.
  void Show(const std::vector<BoardFit>& boards, const QStringList& poses);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<BoardFit> boards_;
  QStringList poses_;
};

}  // namespace foresight
