#include "ui/panels/board_fields.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSpinBox>
#include <algorithm>

#include "core/objects/board_dictionaries.h"

namespace foresight {
namespace {

QSpinBox* CornerNumber(const QString& name) {
  auto* box = new QSpinBox;
  box->setRange(3, 60);
  box->setAccessibleName(name);
  box->setToolTip(BoardFields::tr("Inner corners: where two black squares touch"));
  box->setKeyboardTracking(false);
  box->setMinimumWidth(56);
  return box;
}

}  // namespace

BoardFields::BoardFields(QWidget* parent)
    : QWidget(parent),
      kind_(new QComboBox),
      columns_(CornerNumber(tr("Inner corners in a row"))),
      rows_(CornerNumber(tr("Inner corners in a column"))),
      square_mm_(new QDoubleSpinBox) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(3, 1);
  kind_->addItem(tr("Checkerboard"));
  for (const CalibrationBoard::Dictionary dictionary : BoardDictionaries())
    kind_->addItem(
        tr("ChArUco, %1").arg(QString::fromStdString(std::string(ToString(dictionary)))));
  kind_->setAccessibleName(tr("Kind of board"));
  kind_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  kind_->setMinimumContentsLength(6);
  square_mm_->setRange(1.0, 1000.0);
  square_mm_->setDecimals(2);
  square_mm_->setSuffix(tr(" mm"));
  square_mm_->setAccessibleName(tr("Side of a square"));
  square_mm_->setKeyboardTracking(false);
  grid->addWidget(kind_, 0, 0, 1, 4);
  grid->addWidget(new QLabel(tr("Corners")), 1, 0);
  grid->addWidget(columns_, 1, 1);
  grid->addWidget(new QLabel(QStringLiteral("×")), 1, 2);
  grid->addWidget(rows_, 1, 3);
  grid->addWidget(new QLabel(tr("Square")), 2, 0);
  grid->addWidget(square_mm_, 2, 1, 1, 3);
  connect(kind_, QOverload<int>::of(&QComboBox::activated), this, &BoardFields::edited);
  for (QSpinBox* box : {columns_, rows_})
    connect(box, QOverload<int>::of(&QSpinBox::valueChanged), this, &BoardFields::edited);
  connect(square_mm_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          &BoardFields::edited);
}

void BoardFields::Show(const CalibrationBoard& board) {
  shown_ = board;
  const QSignalBlocker quiet_columns(columns_), quiet_rows(rows_), quiet_square(square_mm_);
  const auto all = BoardDictionaries();
  const auto at = std::find(all.begin(), all.end(), board.dictionary);
  kind_->setCurrentIndex(board.kind == CalibrationBoard::Kind::kCheckerboard
                             ? 0
                             : 1 + static_cast<int>(at - all.begin()));
  if (!columns_->hasFocus()) columns_->setValue(board.columns);
  if (!rows_->hasFocus()) rows_->setValue(board.rows);
  if (!square_mm_->hasFocus()) square_mm_->setValue(1e3 * board.square_m);
}

CalibrationBoard BoardFields::Board() const {
  CalibrationBoard board = shown_;
  const int kind = kind_->currentIndex();
  board.kind = kind == 0 ? CalibrationBoard::Kind::kCheckerboard : CalibrationBoard::Kind::kCharuco;
  if (kind > 0) board.dictionary = BoardDictionaries()[static_cast<std::size_t>(kind - 1)];
  board.columns = columns_->value();
  board.rows = rows_->value();
  board.square_m = 1e-3 * square_mm_->value();
  return board;
}

}  // namespace foresight
