#include "ui/panels/map_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPixmap>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "ui/panels/command_button.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QIcon Swatch(Rgb8 color) {
  QPixmap pixmap(14, 14);
  pixmap.fill(QColor(color.r, color.g, color.b));
  return QIcon(pixmap);
}

}  // namespace

MapPanel::MapPanel(MapViewModel* map, ClipBoxModel* clip, CommandTable* commands, QWidget* parent)
    : QWidget(parent),
      map_(map),
      clip_(clip),
      empty_(new QLabel(tr("No map yet. Make map brings the scans of the mission together."))),
      scans_(new QListWidget),
      before_(new QComboBox),
      after_(new QComboBox),
      find_(new QPushButton(tr("Find changes"))),
      changes_text_(new QLabel),
      changes_(new QListWidget) {
  empty_->setWordWrap(true);
  empty_->setObjectName(QStringLiteral("faint"));
  scans_->setAccessibleName(tr("Scans of the map"));
  scans_->setWordWrap(true);
  scans_->setSelectionMode(QAbstractItemView::NoSelection);
  auto* make = new QPushButton(tr("Make map"));
  BindButton(make, commands, "map.make");
  auto* with_odometry = NarrowButton("mapWithOdometry", tr("With odometry"));
  BindButton(with_odometry, commands, "map.make_with_odometry");
  auto* cancel = new QPushButton(tr("Cancel"));
  BindButton(cancel, commands, "map.cancel");
  auto* row = new QHBoxLayout;
  row->addWidget(make);
  row->addWidget(with_odometry);
  row->addWidget(cancel);
  row->addStretch(1);
  auto* inner = new QWidget;
  auto* layout = new QVBoxLayout(inner);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(8);
  layout->addLayout(row);
  layout->addWidget(empty_);
  layout->addWidget(scans_, 1);
  layout->addWidget(changes_box_ = BuildChanges());
  layout->addWidget(BuildClip(commands));
  layout->addStretch(0);  // takes the room while there are no lists
  FillWithScroll(this, inner);
  setMinimumWidth(200);
  connect(map_, &MapViewModel::changed, this, &MapPanel::ShowMap);
  connect(clip_, &ClipBoxModel::changed, this, &MapPanel::ShowClip);
  ShowMap();
  ShowClip();
}

QWidget* MapPanel::BuildChanges() {
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  auto* row = new QHBoxLayout;
  before_->setAccessibleName(tr("Earlier scan"));
  after_->setAccessibleName(tr("Later scan"));
  row->addWidget(before_, 1);
  row->addWidget(new QLabel(tr("to")));
  row->addWidget(after_, 1);
  row->addWidget(find_);
  changes_text_->setWordWrap(true);
  changes_->setAccessibleName(tr("Changes"));
  changes_->setWordWrap(true);
  changes_->setToolTip(tr("Orange has appeared, blue is gone. Click to look at it"));
  layout->addLayout(row);
  layout->addWidget(changes_text_);
  layout->addWidget(changes_);
  connect(find_, &QPushButton::clicked, this, [this] {
    map_->FindChanges(before_->currentData().toInt(), after_->currentData().toInt());
  });
  connect(changes_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { map_->lookAtChange(changes_->row(item)); });
  return box;
}

QWidget* MapPanel::BuildClip(CommandTable* commands) {
  auto* box = new QWidget;
  auto* layout = new QGridLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* on = new QPushButton(tr("Clip box"));
  on->setCheckable(true);
  BindButton(on, commands, "view.clip_box");
  connect(clip_, &ClipBoxModel::changed, on, [on, this] { on->setChecked(clip_->On()); });
  auto* reset = new QPushButton(tr("Reset box"));
  connect(reset, &QPushButton::clicked, clip_, &ClipBoxModel::reset);
  layout->addWidget(on, 0, 0, 1, 2);
  layout->addWidget(reset, 0, 2);
  static const char* const kAxes[] = {"x", "y", "z"};
  for (int side = 0; side < 6; ++side) {
    auto* field = new QDoubleSpinBox;
    field->setRange(-10'000.0, 10'000.0);
    field->setDecimals(3);
    field->setSingleStep(0.05);
    field->setSuffix(tr(" m"));
    field->setKeyboardTracking(false);
    const QString axis = QString::fromLatin1(kAxes[side / 2]);
    field->setAccessibleName(side % 2 == 0 ? tr("Clip box, least %1").arg(axis)
                                           : tr("Clip box, largest %1").arg(axis));
    connect(field, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &MapPanel::TakeClip);
    if (side % 2 == 0) layout->addWidget(new QLabel(axis), 1 + side / 2, 0);
    layout->addWidget(field, 1 + side / 2, 1 + side % 2);
    sides_[static_cast<std::size_t>(side)] = field;
  }
  return box;
}

void MapPanel::ShowMap() {
  const std::vector<QString> texts = map_->PlaceTexts();
  empty_->setVisible(texts.empty());
  scans_->setVisible(!texts.empty());
  scans_->clear();
  const std::size_t count = map_->Map() ? map_->Map()->map.scans.size() : 0;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    auto* item = new QListWidgetItem(texts[i], scans_);
    item->setToolTip(texts[i]);
    if (i < count && map_->Map()->map.scans[i].place.InMap()) item->setIcon(Swatch(ColorOfScan(i)));
  }
  if (listed_ != map_->Map()) {
    listed_ = map_->Map();
    for (QComboBox* choice : {before_, after_}) {
      choice->clear();
      for (std::size_t i = 0; i < count; ++i)
        if (listed_->map.scans[i].place.InMap())
          choice->addItem(tr("Scan %1").arg(listed_->map.scans[i].id), static_cast<int>(i));
    }
    after_->setCurrentIndex(after_->count() - 1);
  }
  changes_box_->setVisible(count > 0);
  find_->setEnabled(before_->count() > 1 && !map_->Busy());
  find_->setToolTip(before_->count() > 1 ? tr("Mark what appeared or is gone between two scans")
                                         : tr("It takes two scans that are in the map."));
  changes_text_->setText(map_->ChangesText());
  changes_text_->setVisible(!map_->ChangesText().isEmpty());
  const QSignalBlocker blocker(changes_);
  changes_->clear();
  for (const ScanChange& change : map_->Changes())
    changes_->addItem(QString::fromStdString(ChangeText(change)));
  changes_->setVisible(changes_->count() > 0);
}

void MapPanel::ShowClip() {
  const Eigen::AlignedBox3d& box = clip_->LastBox();
  for (int side = 0; side < 6; ++side) {
    QDoubleSpinBox* field = sides_[static_cast<std::size_t>(side)];
    const QSignalBlocker blocker(field);
    field->setEnabled(clip_->On());
    if (!box.isEmpty()) field->setValue((side % 2 == 0 ? box.min() : box.max())[side / 2]);
  }
}

void MapPanel::TakeClip() {
  Eigen::AlignedBox3d box = clip_->LastBox();
  for (int side = 0; side < 6; ++side) {
    // A field that was not touched keeps all digits of its side.
    double& value = (side % 2 == 0 ? box.min() : box.max())[side / 2];
    const double typed = sides_[static_cast<std::size_t>(side)]->value();
    if (std::abs(typed - value) > 0.0006) value = typed;
  }
  clip_->SetBox(box);
}

}  // namespace foresight
