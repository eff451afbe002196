#pragma once

#include <QImage>
#include <QWidget>
#include <vector>

#include "core/base/image.h"
#include "core/calibration/calibration_session.h"
#include "core/calibration/chain_residuals.h"

namespace foresight {

/// The boards of one stop with the lidar's returns on them, coloured by how far each lies from its
/// board: blue = too near, white = on it, orange = too far.
class LidarImageView : public QWidget {
  Q_OBJECT

 public:
  /// With the lidar where it was thought to be, or where it was found.
  enum class Which { kBefore, kAfter };

  explicit LidarImageView(QWidget* parent = nullptr);

  /// `image` may be empty, `view` nullptr.
  void Show(const GrayImage& image, const MountView* view, int width, int height,
            const std::vector<LidarImagePoint>& points, Which which);

  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  QSize sizeHint() const override { return {280, heightForWidth(280)}; }
  QSize minimumSizeHint() const override { return {160, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void PaintScale(QPainter& painter) const;

  QImage image_;
  std::vector<Eigen::Vector2d> corners_;
  int width_ = 4;
  int height_ = 3;
  std::vector<LidarImagePoint> points_;
  Which which_ = Which::kAfter;
};

}  // namespace foresight
