#include "ui/panels/live_board_view.h"

#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {

/// The image as wide as there is room, corners drawn over it.
class LiveBoardView::Picture : public QWidget {
 public:
  Picture() {
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    setAccessibleName(LiveBoardView::tr("Live image"));
  }
  void Show(const LiveImage& live, const std::vector<std::vector<Eigen::Vector2d>>& corners) {
    const ColorImage& image = live.image;
    const QImage borrowed(reinterpret_cast<const uchar*>(image.data()), image.width(),
                          image.height(), image.width() * 3, QImage::Format_RGB888);
    image_ = borrowed.copy();
    corners_ = corners;
    updateGeometry();
    update();
  }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override {
    return image_.isNull() ? width * 3 / 4 : width * image_.height() / image_.width();
  }
  QSize sizeHint() const override { return {280, heightForWidth(280)}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    if (image_.isNull()) return;
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(rect(), image_);
    painter.setRenderHint(QPainter::Antialiasing);
    const double scale = static_cast<double>(width()) / image_.width();
    painter.setPen(Qt::NoPen);
    for (std::size_t board = 0; board < corners_.size(); ++board) {
      painter.setBrush(board == 0 ? state_color::kGood : state_color::kActive);
      for (const Eigen::Vector2d& corner : corners_[board])
        painter.drawEllipse(QPointF((corner.x() + 0.5) * scale, (corner.y() + 0.5) * scale), 2.5,
                            2.5);
    }
  }

 private:
  QImage image_;
  std::vector<std::vector<Eigen::Vector2d>> corners_;
};

LiveBoardView::LiveBoardView(LiveBoardModel* model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      toggle_(NarrowButton("liveView", tr("Live view"),
                           tr("Show what the camera sees, and look for the boards in it"))),
      picture_(new Picture),
      text_(WordsLabel("liveText")) {
  toggle_->setCheckable(true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(toggle_);
  layout->addWidget(picture_);
  layout->addWidget(text_);
  connect(toggle_, &QPushButton::clicked, this,
          [this](bool on) { on ? model_->start() : model_->stop(); });
  connect(model_, &LiveBoardModel::changed, this, &LiveBoardView::Refresh);
  Refresh();
}

void LiveBoardView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  Refresh();
}

void LiveBoardView::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  model_->stop();
}

void LiveBoardView::Refresh() {
  toggle_->setChecked(model_->Running());
  picture_->setVisible(model_->Image() != nullptr);
  text_->setVisible(!model_->Text().isEmpty());
  text_->setText(model_->Text());
  if (model_->Image()) picture_->Show(*model_->Image(), model_->Corners());
}

}  // namespace foresight
