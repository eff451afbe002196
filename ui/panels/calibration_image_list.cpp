#include "ui/panels/calibration_image_list.h"

#include <QSignalBlocker>
#include <cmath>

#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QIcon IconOf(const GrayImage& image) {
  QPixmap pixmap = EmptyThumbnail();
  if (!image.empty()) {
    const QImage borrowed(image.data(), image.width(), image.height(), image.width(),
                          QImage::Format_Grayscale8);
    pixmap = QPixmap::fromImage(
        borrowed.scaled(kThumbnailSize, Qt::KeepAspectRatio, Qt::SmoothTransformation));
  }
  // No second look for a row that is selected: it would tint the image.
  QIcon icon(pixmap);
  icon.addPixmap(pixmap, QIcon::Selected);
  return icon;
}

QString RatingText(const CalibrationImageRow& row) {
  QString text =
      CalibrationImageList::tr("covers %1 %").arg(100.0 * row.rating.coverage, 0, 'f', 0);
  if (std::isfinite(row.rating.edge_width_px))
    text += CalibrationImageList::tr(", edges %1 px").arg(row.rating.edge_width_px, 0, 'f', 1);
  return text;
}

/// Two lines: the name, and what became of the image.
QString TextOf(const CalibrationImageRow& row) {
  using State = CalibrationImageRow::State;
  switch (row.state) {
    case State::kReading:
    case State::kExcluded:
      return row.name + QLatin1Char('\n') + row.reason;
    case State::kRejected:
      return CalibrationImageList::tr("%1\nnot used: %2").arg(row.name, row.reason);
    case State::kUsed:
      break;
  }
  const QString error = std::isfinite(row.rms_px)
                            ? CalibrationImageList::tr("rms %1 px, ").arg(row.rms_px, 0, 'f', 2)
                            : QString();
  return row.name + QLatin1Char('\n') + error + RatingText(row);
}

}  // namespace

CalibrationImageList::CalibrationImageList(QWidget* parent) : QListWidget(parent) {
  setAccessibleName(tr("Images of the board"));
  setToolTip(tr("Clear the mark of an image to leave it out; Ctrl+Z takes that back"));
  setIconSize(kThumbnailSize);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setWordWrap(true);
  setFixedHeight(176);
  connect(this, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
    Q_EMIT marked(row(item), item->checkState() != Qt::Checked);
  });
}

void CalibrationImageList::Show(const std::vector<CalibrationImageRow>& rows) {
  const QSignalBlocker quiet(this);
  while (count() > static_cast<int>(rows.size())) delete takeItem(count() - 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CalibrationImageRow& row = rows[i];
    if (static_cast<int>(i) >= count()) addItem(new QListWidgetItem);
    QListWidgetItem* entry = item(static_cast<int>(i));
    const QString key = row.name + QString::number(row.thumbnail.width());
    if (entry->data(Qt::UserRole).toString() != key) {
      entry->setIcon(IconOf(row.thumbnail));
      entry->setData(Qt::UserRole, key);
    }
    entry->setText(TextOf(row));
    entry->setToolTip(row.reason.isEmpty() ? row.origin
                                           : row.origin + QLatin1Char('\n') + row.reason);
    entry->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    const bool excluded = row.state == CalibrationImageRow::State::kExcluded;
    entry->setCheckState(excluded ? Qt::Unchecked : Qt::Checked);
    const bool bad = row.state == CalibrationImageRow::State::kRejected;
    entry->setForeground(bad ? QBrush(state_color::kCaution) : palette().brush(QPalette::Text));
  }
  setVisible(!rows.empty());
}

}  // namespace foresight
