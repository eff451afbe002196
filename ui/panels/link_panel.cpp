#include "ui/panels/link_panel.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "ui/widgets/dock_parts.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {
namespace {

constexpr int kRowRole = Qt::UserRole;
using Place = LinkedScan::Place;

bool OnItsWay(Place place) {
  return place == Place::kComing || place == Place::kWaiting;
}

QString TextOf(const LinkedScanRow& row) {
  QString text = row.title + QLatin1Char('\n') + row.detail;
  if (!row.trouble.isEmpty()) text += QLatin1Char('\n') + row.trouble;
  return text;
}

}  // namespace

LinkPanel::LinkPanel(LinkViewModel* link, QWidget* parent) : QWidget(parent), link_(link) {
  auto* inner = new QWidget;
  auto* layout = new QVBoxLayout(inner);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->setSpacing(8);
  layout->addWidget(BuildFigures());
  layout->addWidget(SectionTitle(tr("Control")));
  layout->addWidget(BuildControl());
  layout->addWidget(SectionTitle(tr("Scans, in the order in which they come")));
  layout->addWidget(BuildScans(), 1);
  FillWithScroll(this, inner);
  setMinimumWidth(200);
  connect(link_, &LinkViewModel::changed, this, &LinkPanel::Show);
  Show();
}

QWidget* LinkPanel::BuildFigures() {
  auto* figures = new QWidget;
  auto* form = new QFormLayout(figures);
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(4);
  const auto add = [form](const QString& title, const char* name) {
    auto* label = new QuietLabel(QuietLabel::Ground::kWindow);
    label->setObjectName(QString::fromLatin1(name));
    form->addRow(title, label);
    return label;
  };
  state_ = new QLabel;
  state_->setObjectName(QStringLiteral("linkState"));
  form->addRow(tr("Link"), state_);
  last_word_ = add(tr("Last word"), "linkLastWord");
  round_trip_ = add(tr("Round trip"), "linkRoundTrip");
  rate_ = add(tr("Rate"), "linkRate");
  left_ = add(tr("To come"), "linkLeft");
  trouble_ = WordsLabel("linkTrouble");
  form->addRow(trouble_);
  return figures;
}

QWidget* LinkPanel::BuildControl() {
  auto* part = new QWidget;
  auto* layout = new QVBoxLayout(part);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  control_ = WordsLabel("linkControl");
  successor_ = new QLineEdit;
  successor_->setObjectName(QStringLiteral("successor"));
  successor_->setPlaceholderText(tr("to whom (empty: anybody)"));
  successor_->setToolTip(tr("The name in the certificate of who may take control next"));
  take_ = NarrowButton("takeControl", tr("Take control"));
  give_ = NarrowButton("giveControl", tr("Give away"));
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(take_);
  buttons->addWidget(give_);
  layout->addWidget(control_);
  layout->addLayout(buttons);
  layout->addWidget(successor_);
  connect(take_, &QPushButton::clicked, link_, &LinkViewModel::takeControl);
  connect(give_, &QPushButton::clicked, this, [this] { link_->GiveControl(successor_->text()); });
  return part;
}

QWidget* LinkPanel::BuildScans() {
  auto* part = new QWidget;
  auto* layout = new QVBoxLayout(part);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  list_ = new QListWidget;
  list_->setObjectName(QStringLiteral("linkedScans"));
  list_->setAccessibleName(tr("Scans at the head"));
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setTextElideMode(Qt::ElideRight);
  list_->setMinimumHeight(60);
  first_ = NarrowButton("bringFirst", tr("Bring first"));
  pause_ = NarrowButton("pauseScan", tr("Pause"));
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(first_);
  buttons->addWidget(pause_);
  layout->addWidget(list_, 1);
  layout->addLayout(buttons);
  connect(list_, &QListWidget::currentRowChanged, this, &LinkPanel::ShowButtons);
  connect(first_, &QPushButton::clicked, this, [this] { link_->BringFirst(Chosen()); });
  connect(pause_, &QPushButton::clicked, this, [this] {
    const int row = list_->currentRow();
    if (row < 0) return;
    if (OnItsWay(shown_[row].place))
      link_->Pause(Chosen());
    else
      link_->Bring(Chosen());
  });
  return part;
}

void LinkPanel::Show() {
  const LinkText& text = link_->Text();
  if (state_->text() != text.state) state_->setText(text.state);
  last_word_->SetText(text.last_word);
  round_trip_->SetText(text.round_trip);
  rate_->SetText(text.rate);
  left_->SetText(text.left);
  if (trouble_->text() != text.trouble) trouble_->setText(text.trouble);
  trouble_->setVisible(!text.trouble.isEmpty());
  if (control_->text() != text.control) control_->setText(text.control);
  ShowPossible(take_, tr("Command the head from here"), link_->WhyNotTake());
  ShowPossible(give_, tr("Let another operator command the head"), link_->WhyNotGive());
  ShowScans();
  ShowButtons();
}

/// A row keeps its scan chosen wherever it moves to.
void LinkPanel::ShowScans() {
  const QVector<LinkedScanRow>& rows = link_->Scans();
  if (rows == shown_) return;
  const QString chosen = Chosen();
  const QSignalBlocker quiet(list_);
  while (list_->count() > rows.size()) delete list_->takeItem(list_->count() - 1);
  int at = -1;
  for (int i = 0; i < rows.size(); ++i) {
    if (i >= list_->count()) list_->addItem(new QListWidgetItem);
    QListWidgetItem* item = list_->item(i);
    if (i >= shown_.size() || !(shown_[i] == rows[i])) {
      item->setText(TextOf(rows[i]));
      item->setToolTip(rows[i].trouble);
      item->setData(kRowRole, rows[i].scan_id);
    }
    if (rows[i].scan_id == chosen) at = i;
  }
  shown_ = rows;
  list_->setCurrentRow(at);
}

void LinkPanel::ShowButtons() {
  const int row = list_->currentRow();
  const bool any = row >= 0 && row < shown_.size();
  const Place place = any ? shown_[row].place : Place::kHere;
  const QString why = !any                    ? tr("Choose a scan in the list.")
                      : place == Place::kHere ? tr("All of it is here already.")
                                              : QString();
  ShowPossible(first_, tr("Bring this scan before all others"), why);
  ShowPossible(pause_,
               any && !OnItsWay(place) ? tr("Bring this scan behind those that wait")
                                       : tr("Leave the rest of this scan at the head for now"),
               why);
  const QString word = !any || OnItsWay(place)   ? tr("Pause")
                       : place == Place::kPaused ? tr("Go on")
                                                 : tr("Bring");
  if (pause_->text() != word) pause_->setText(word);
}

QString LinkPanel::Chosen() const {
  const QListWidgetItem* item = list_->currentItem();
  return item == nullptr ? QString() : item->data(kRowRole).toString();
}

}  // namespace foresight
