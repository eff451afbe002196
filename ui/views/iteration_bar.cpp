#include "ui/views/iteration_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>

namespace foresight {

/// The mean change of each pass as a bar with its millimetres.
class ChangeBars : public QWidget {
 public:
  ChangeBars() {
    setFixedHeight(44);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  }
  void Show(const std::vector<double>& change_m, int current) {
    change_m_ = change_m;
    current_ = current;
    setFixedWidth(kBarWidth_px * static_cast<int>(change_m.size()));
    QStringList spoken;
    for (const double change : change_m) spoken << QString::number(1e3 * change, 'f', 2);
    setAccessibleName(tr("Mean change of each pass: %1 mm").arg(spoken.join(QStringLiteral(", "))));
    setToolTip(tr("Mean change of depth in each pass, mm"));
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    QFont small = font();
    small.setPointSizeF(0.8 * small.pointSizeF());
    painter.setFont(small);
    const int line = painter.fontMetrics().height();
    const double largest =
        change_m_.empty() ? 0.0 : *std::max_element(change_m_.begin(), change_m_.end());
    for (int i = 0; i < static_cast<int>(change_m_.size()); ++i) {
      const double change = change_m_[static_cast<std::size_t>(i)];
      const double fraction = largest > 0.0 ? change / largest : 0.0;
      const int bar = std::max(1, static_cast<int>(fraction * (height() - line - 2)));
      const QRect column(i * kBarWidth_px, 0, kBarWidth_px, height());
      painter.fillRect(
          column.left() + 6, height() - bar, kBarWidth_px - 12, bar,
          palette().color(i + 1 == current_ ? QPalette::Highlight : QPalette::PlaceholderText));
      painter.setPen(palette().color(QPalette::WindowText));
      painter.drawText(column.adjusted(0, 0, 0, -bar - 1), Qt::AlignHCenter | Qt::AlignBottom,
                       QString::number(1e3 * change, 'f', 1e3 * change < 10.0 ? 2 : 1));
    }
  }

 private:
  static constexpr int kBarWidth_px = 40;
  std::vector<double> change_m_;
  int current_ = -1;  ///< the pass whose result is shown
};

IterationBar::IterationBar(SessionModel* session, DepthViewModel* depth, LayersViewModel* layers,
                           QWidget* parent)
    : QWidget(parent),
      session_(session),
      depth_(depth),
      layers_(layers),
      text_(new QLabel),
      slider_(new QSlider(Qt::Horizontal)),
      bars_(new ChangeBars),
      unit_(new QLabel(tr("mm"))) {
  text_->setMinimumWidth(110);
  slider_->setPageStep(1);
  slider_->setTickPosition(QSlider::TicksBelow);
  slider_->setAccessibleName(tr("Pass of the filter"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 4, 8, 0);
  row->setSpacing(8);
  row->addWidget(text_);
  row->addWidget(slider_, 1);
  row->addWidget(bars_);
  unit_->setObjectName(QStringLiteral("faint"));
  row->addWidget(unit_, 0, Qt::AlignBottom);
  connect(slider_, &QSlider::valueChanged, layers_, &LayersViewModel::SetIteration);
  connect(layers_, &LayersViewModel::changed, this, &IterationBar::Refresh);
  connect(session_, &SessionModel::depthChanged, this, &IterationBar::Refresh);
  connect(depth_->Runner(), &TaskRunner::changed, this, &IterationBar::Refresh);
  Refresh();
}

void IterationBar::Refresh() {
  setVisible(layers_->IterationsOpen());
  const auto& depth = session_->Depth();
  const int maps = depth ? static_cast<int>(depth->dense.iterations.size()) : 0;
  slider_->setEnabled(maps > 0);
  const bool has_passes = depth && !depth->dense.mean_change_m.empty();
  bars_->setVisible(has_passes);
  unit_->setVisible(has_passes);
  if (!depth || maps == 0) {
    text_->setText(depth_->Runner()->Busy() ? tr("Computing the passes …")
                   : depth                  ? tr("This method has no passes")
                                            : tr("No depth yet"));
    if (depth) bars_->Show(depth->dense.mean_change_m, -1);
    return;
  }
  const int chosen = layers_->IterationOf(depth->dense);
  const int current = chosen < 0 ? maps - 1 : chosen;
  const QSignalBlocker blocker(slider_);
  slider_->setRange(0, maps - 1);
  slider_->setValue(current);
  text_->setText(tr("Pass D%1 of D%2").arg(current).arg(maps - 1));
  bars_->Show(depth->dense.mean_change_m, current);
}

}  // namespace foresight
