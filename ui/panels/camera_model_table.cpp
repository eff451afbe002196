#include "ui/panels/camera_model_table.h"

#include <QHeaderView>
#include <cmath>

#include "ui/panels/theme.h"

namespace foresight {
namespace {

QString Pixels(double value) {
  return std::isfinite(value) ? QString::number(value, 'f', 3) : QStringLiteral("–");
}

}  // namespace

QString ShortNameOf(LensModel model) {
  switch (model) {
    case LensModel::kFisheyeK:
      return CameraModelTable::tr("k");
    case LensModel::kExtendedUnified:
      return CameraModelTable::tr("EUCM");
    case LensModel::kKannalaBrandt:
      return CameraModelTable::tr("KB4");
    case LensModel::kRadialTangential:
      break;
  }
  return CameraModelTable::tr("radtan");
}

CameraModelTable::CameraModelTable(QWidget* parent) : QTableWidget(0, 4, parent) {
  setHorizontalHeaderLabels({tr("model"), tr("mean"), tr("rms"), tr("unseen")});
  horizontalHeaderItem(1)->setToolTip(
      tr("Mean distance of corners in used images, px: the paper's measure"));
  horizontalHeaderItem(2)->setToolTip(tr("Root mean square of the same, px: OpenCV's measure"));
  horizontalHeaderItem(3)->setToolTip(
      tr("Cross-validation: mean distance in images that were not used, px"));
  verticalHeader()->hide();
  setAccessibleName(tr("Camera models"));
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  horizontalHeader()->setMinimumSectionSize(40);
}

void CameraModelTable::Show(const std::vector<CalibrationModelRow>& rows, int chosen) {
  setRowCount(static_cast<int>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CalibrationModelRow& row = rows[i];
    const QStringList texts = {ShortNameOf(row.model), Pixels(row.mean_error_px),
                               Pixels(row.rms_px), Pixels(row.cross_validation_px)};
    for (int column = 0; column < texts.size(); ++column) {
      auto* item = new QTableWidgetItem(texts[column]);
      item->setToolTip(row.title + QLatin1Char('\n') +
                       (row.failure.isEmpty() ? row.parameters : row.failure));
      if (!row.failure.isEmpty()) item->setForeground(state_color::kCaution);
      if (column > 0) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      setItem(static_cast<int>(i), column, item);
    }
  }
  if (chosen >= 0) selectRow(chosen);
  setVisible(!rows.empty());
  setFixedHeight(horizontalHeader()->height() + verticalHeader()->length() + 2 * frameWidth());
}

}  // namespace foresight
