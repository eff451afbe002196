#include "ui/panels/objects_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/detection_card.h"
#include "ui/panels/theme.h"

namespace foresight {
namespace {

/// "Valve", "Drill", "Terrain".
QString TitleOf(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::kValve:
      return ObjectsPanel::tr("Valve");
    case ObjectKind::kDrill:
      return ObjectsPanel::tr("Drill");
    case ObjectKind::kTerrain:
      break;
  }
  return ObjectsPanel::tr("Terrain");
}

}  // namespace

ObjectsPanel::ObjectsPanel(SessionModel* session, FitViewModel* fit, QWidget* parent)
    : QWidget(parent),
      session_(session),
      fit_(fit),
      list_(new QListWidget),
      empty_(
          new QLabel(tr("No objects yet. Choose a tool, valve (V), drill (D) or terrain (T), and "
                        "draw a region over it in the picture, the depth map or the cloud."))),
      card_(new DetectionCard) {
  empty_->setWordWrap(true);
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setObjectName(QStringLiteral("faint"));
  list_->setAccessibleName(tr("Found objects"));
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* inner = new QWidget;
  auto* inner_layout = new QVBoxLayout(inner);
  inner_layout->setContentsMargins(0, 0, 0, 0);
  inner_layout->addWidget(card_);
  inner_layout->addStretch(1);
  scroll->setWidget(inner);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 12, 12, 12);
  layout->setSpacing(8);
  layout->addWidget(BuildFitRow());
  layout->addWidget(empty_, 1);
  layout->addWidget(list_);
  layout->addWidget(scroll, 3);
  setMinimumWidth(300);

  connect(session_, &SessionModel::objectsChanged, this, &ObjectsPanel::ShowObjects);
  connect(list_, &QListWidget::currentRowChanged, session_, &SessionModel::SelectObject);
  connect(card_, &DetectionCard::nextAsked, session_, &SessionModel::nextCandidate);
  connect(card_, &DetectionCard::previousAsked, session_, &SessionModel::previousCandidate);
  connect(fit_, &FitViewModel::changed, this, &ObjectsPanel::ShowFit);
  connect(&age_timer_, &QTimer::timeout, this, &ObjectsPanel::ShowAge);
  age_timer_.start(1000);
  ShowObjects();
  ShowFit();
}

QWidget* ObjectsPanel::BuildFitRow() {
  auto* row = new QWidget;
  auto* layout = new QGridLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setColumnStretch(0, 1);
  layout->setColumnStretch(1, 1);
  shape_ = new QComboBox;
  shape_->setAccessibleName(tr("Shape of the region"));
  shape_->addItem(tr("Rectangle"));
  shape_->setItemData(0, tr("Drag from corner to corner"), Qt::ToolTipRole);
  shape_->addItem(tr("Polygon"));
  shape_->setItemData(1,
                      tr("Click the corners; Enter or a double click closes, Backspace takes "
                         "one back, Esc ends"),
                      Qt::ToolTipRole);
  shape_->addItem(tr("Two clicks"));
  shape_->setItemData(2, tr("Click two points on opposite sides of the object"), Qt::ToolTipRole);
  shape_->setToolTip(tr("How a region is drawn"));
  source_ = new QComboBox;
  source_->addItem(tr("to lidar points"));
  source_->addItem(tr("to depth map"));
  source_->setItemData(1, tr("The masked depth, and the lidar's points behind it"),
                       Qt::ToolTipRole);
  source_->setToolTip(tr("Which measurements the template is fitted to"));
  fit_button_ = new QPushButton(Icon("fit"), {});
  layout->addWidget(shape_, 0, 0);
  layout->addWidget(source_, 0, 1);
  layout->addWidget(fit_button_, 1, 0, 1, 2);
  connect(shape_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { fit_->SetShape(static_cast<RegionShape>(index)); });
  connect(fit_button_, &QPushButton::clicked, fit_, &FitViewModel::fit);
  connect(source_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { fit_->SetSource(index == 0 ? FitSource::kRaw : FitSource::kDepth); });
  return row;
}

void ObjectsPanel::ShowObjects() {
  const auto& objects = session_->Objects();
  const QSignalBlocker blocker(list_);
  list_->clear();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Detection& found = objects[i].detection;
    QString text = tr("%1 %2, %3")
                       .arg(TitleOf(ObjectKindOf(found)))
                       .arg(i + 1)
                       .arg(QString::fromUtf8(ToString(VerdictOf(found).level)));
    if (!session_->IsCurrent(objects[i])) text += tr(" (earlier scan)");
    list_->addItem(new QListWidgetItem(Icon(KindOf(found)), text));
  }
  list_->setCurrentRow(session_->SelectedObject());
  const int rows = std::min(6, list_->count());
  list_->setFixedHeight(rows * std::max(24, list_->sizeHintForRow(0)) + 2 * list_->frameWidth());
  const FoundObject* chosen = session_->Selected();
  empty_->setVisible(objects.empty());
  list_->setVisible(!objects.empty());
  card_->setVisible(chosen != nullptr);
  if (chosen != nullptr) card_->Show(*chosen, session_->Candidate(), session_->IsCurrent(*chosen));
}

void ObjectsPanel::ShowFit() {
  fit_button_->setEnabled(fit_->CanFit());
  fit_button_->setText(tr("Fit %1").arg(TitleOf(fit_->Kind()).toLower()));
  fit_button_->setToolTip(fit_->CanFit() ? tr("Fit the object into the drawn region")
                                         : tr("Draw a region over the object first"));
}

void ObjectsPanel::ShowAge() {
  if (const FoundObject* chosen = session_->Selected()) card_->ShowAge(*chosen);
}

}  // namespace foresight
