#include "ui/panels/objects_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/command_button.h"
#include "ui/panels/detection_card.h"
#include "ui/panels/theme.h"
#include "ui/viewmodels/advice.h"
#include "ui/viewmodels/no_scan_hint.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

constexpr int kFewestRows = 3;
constexpr int kMostRows = 6;

/// "Valve", "Drill", "Terrain", "Door handle", "Cylinder".
QString TitleOf(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::kValve:
      return ObjectsPanel::tr("Valve");
    case ObjectKind::kDrill:
      return ObjectsPanel::tr("Drill");
    case ObjectKind::kHandle:
      return ObjectsPanel::tr("Door handle");
    case ObjectKind::kCylinder:
      return ObjectsPanel::tr("Cylinder");
    case ObjectKind::kTerrain:
      break;
  }
  return ObjectsPanel::tr("Terrain");
}

/// "Valve 2", or the name that the operator gave.
QString NameOf(const FoundObject& object, std::size_t index) {
  if (!object.name.isEmpty()) return object.name;
  return ObjectsPanel::tr("%1 %2").arg(TitleOf(ObjectKindOf(object.detection))).arg(index + 1);
}

}  // namespace

ObjectsPanel::ObjectsPanel(SessionModel* session, FitViewModel* fit, CommandTable* commands,
                           QWidget* parent)
    : QWidget(parent),
      session_(session),
      fit_(fit),
      list_(new QListWidget),
      empty_(new QLabel),
      card_(new DetectionCard) {
  empty_->setWordWrap(true);
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setObjectName(QStringLiteral("faint"));
  list_->setAccessibleName(tr("Found objects"));
  list_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
  // An entry that is too long is cut off: a bar below the list would cover a row.
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setTextElideMode(Qt::ElideRight);
  decisions_ = BuildDecisions(commands);
  auto* inner = new QWidget;
  auto* layout = new QVBoxLayout(inner);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(8);
  layout->addWidget(BuildFitRow(commands));
  layout->addWidget(empty_, 1);
  layout->addWidget(list_);
  layout->addWidget(decisions_);
  layout->addWidget(card_);
  layout->addStretch(1);
  FillWithScroll(this, inner);
  setMinimumWidth(200);

  connect(session_, &SessionModel::objectsChanged, this, &ObjectsPanel::ShowObjects);
  connect(session_, &SessionModel::earlierChanged, this, &ObjectsPanel::ShowEmpty);
  connect(list_, &QListWidget::currentRowChanged, session_, &SessionModel::SelectObject);
  connect(list_, &QListWidget::itemChanged, this, &ObjectsPanel::TakeName);
  connect(card_, &DetectionCard::nextAsked, session_, &SessionModel::nextCandidate);
  connect(card_, &DetectionCard::previousAsked, session_, &SessionModel::previousCandidate);
  connect(fit_, &FitViewModel::changed, this, &ObjectsPanel::ShowFit);
  connect(&age_timer_, &QTimer::timeout, this, &ObjectsPanel::ShowAge);
  age_timer_.start(1000);
  ShowEmpty();
  ShowObjects();
  ShowFit();
}

void ObjectsPanel::ShowEmpty() {
  const QString hint =
      tr("No objects yet. Choose what it is, as Valve (V), and draw a region over it "
         "in the image, the depth map or the cloud.");
  const QString earlier = EarlierObjectsHint(*session_);
  empty_->setText(earlier.isEmpty() ? hint : hint + QStringLiteral("\n\n") + earlier);
}

QWidget* ObjectsPanel::BuildDecisions(CommandTable* commands) {
  auto* rows = new QWidget;
  auto* whole = new QVBoxLayout(rows);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->setSpacing(6);
  auto* layout = new QHBoxLayout;
  layout->setSpacing(6);
  whole->addLayout(layout);
  auto* accept = new QPushButton(Icon("confirmed"), tr("Accept"));
  auto* reject = new QPushButton(Icon("unsure"), tr("Reject"));
  accept->setObjectName(QStringLiteral("acceptButton"));
  reject->setObjectName(QStringLiteral("rejectButton"));
  BindButton(accept, commands, "object.accept");
  BindButton(reject, commands, "object.reject");
  auto* more = new QToolButton;
  more->setText(tr("More"));
  more->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(more);
  for (const char* id : {"object.copy", "object.delete"})
    menu->addAction(commands->Get(id).text, commands, [commands, id] { commands->Run(id); });
  menu->addAction(tr("Rename"), this, [this] {
    if (list_->currentItem() != nullptr) list_->editItem(list_->currentItem());
  });
  more->setMenu(menu);
  layout->addWidget(accept, 1);
  layout->addWidget(reject, 1);
  layout->addWidget(more);
  if (commands->Has("object.send")) {  // a head at the far end of a link, with a robot behind it
    auto* send = new QPushButton(Icon("export"), tr("Send to robot"));
    send->setObjectName(QStringLiteral("sendButton"));
    BindButton(send, commands, "object.send");
    whole->addWidget(send);
  }
  return rows;
}

QWidget* ObjectsPanel::BuildFitRow(CommandTable* commands) {
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
  source_->addItem(tr("to depth map alone"));
  source_->setItemData(2, tr("The masked depth, without the lidar's points behind it"),
                       Qt::ToolTipRole);
  source_->setToolTip(tr("Which measurements the template is fitted to"));
  fit_button_ = new QPushButton(Icon("fit"), {});
  layout->addWidget(shape_, 0, 0);
  layout->addWidget(source_, 0, 1);
  layout->addWidget(fit_button_, 1, 0, 1, 2);
  connect(shape_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { fit_->SetShape(static_cast<RegionShape>(index)); });
  BindButton(fit_button_, commands, "object.fit");
  for (QComboBox* box : {shape_, source_}) {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(4);
  }
  connect(source_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { fit_->SetSource(static_cast<FitSource>(index)); });
  return row;
}

void ObjectsPanel::ShowObjects() {
  const auto& objects = session_->Objects();
  const QSignalBlocker blocker(list_);
  list_->clear();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Detection& found = objects[i].detection;
    const QString state = StateText(objects[i], session_->IsCurrent(objects[i]));
    auto* item =
        new QListWidgetItem(Icon(KindOf(found)), tr("%1: %2").arg(NameOf(objects[i], i), state));
    item->setToolTip(tr("%1\nDouble-click or press F2 to rename").arg(item->text()));
    item->setFlags(item->flags() | Qt::ItemIsEditable);
    list_->addItem(item);
  }
  list_->setCurrentRow(session_->SelectedObject());
  const int rows = std::clamp(list_->count(), kFewestRows, kMostRows);
  list_->setFixedHeight(rows * std::max(24, list_->sizeHintForRow(0)) + 2 * list_->frameWidth());
  const FoundObject* chosen = session_->Selected();
  empty_->setVisible(objects.empty());
  list_->setVisible(!objects.empty());
  card_->setVisible(chosen != nullptr);
  decisions_->setVisible(chosen != nullptr);
  if (chosen != nullptr)
    card_->Show(*chosen, session_->Candidate(), session_->IsCurrent(*chosen), session_->Mode());
}

void ObjectsPanel::TakeName(const QListWidgetItem* item) {
  const QString name = item->text().section(QLatin1Char(':'), 0, 0).trimmed();
  // After this signal: the list is made anew then.
  QMetaObject::invokeMethod(
      this, [this, name] { session_->RenameSelected(name); }, Qt::QueuedConnection);
}

void ObjectsPanel::ShowFit() {
  source_->setCurrentIndex(static_cast<int>(fit_->From()));
  fit_button_->setText(tr("Fit %1").arg(TitleOf(fit_->Kind()).toLower()));
}

void ObjectsPanel::ShowAge() {
  if (const FoundObject* chosen = session_->Selected()) card_->ShowAge(*chosen);
}

}  // namespace foresight
