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

#include "ui/panels/theme.h"
#include "ui/panels/valve_card.h"

namespace foresight {

ObjectsPanel::ObjectsPanel(SessionModel* session, FitViewModel* fit, QWidget* parent)
    : QWidget(parent),
      session_(session),
      fit_(fit),
      list_(new QListWidget),
      empty_(new QLabel(tr("No objects yet. Choose the valve tool (V) and drag a rectangle over a "
                           "valve in the picture or the depth map."))),
      card_(new ValveCard) {
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

  connect(session_, &SessionModel::valvesChanged, this, &ObjectsPanel::ShowValves);
  connect(list_, &QListWidget::currentRowChanged, session_, &SessionModel::SelectValve);
  connect(fit_, &FitViewModel::changed, this, &ObjectsPanel::ShowFit);
  connect(&age_timer_, &QTimer::timeout, this, &ObjectsPanel::ShowAge);
  age_timer_.start(1000);
  ShowValves();
  ShowFit();
}

QWidget* ObjectsPanel::BuildFitRow() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  source_ = new QComboBox;
  source_->addItem(tr("to lidar points"));
  source_->addItem(tr("to depth map"));
  source_->setToolTip(tr("Which measurements the template is fitted to"));
  fit_button_ = new QPushButton(Icon("fit"), tr("Fit valve"));
  layout->addWidget(fit_button_, 1);
  layout->addWidget(source_);
  connect(fit_button_, &QPushButton::clicked, fit_, &FitViewModel::fit);
  connect(source_, QOverload<int>::of(&QComboBox::activated), this, [this](int index) {
    fit_->SetSource(index == 0 ? FitSource::kRaw : FitSource::kDepth);
  });
  return row;
}

void ObjectsPanel::ShowValves() {
  const auto& valves = session_->Valves();
  const QSignalBlocker blocker(list_);
  list_->clear();
  for (std::size_t i = 0; i < valves.size(); ++i) {
    const Verdict& verdict = valves[i].detection.verdict;
    QString text = tr("Valve %1, %2").arg(i + 1).arg(QString::fromUtf8(ToString(verdict.level)));
    if (!session_->IsCurrent(valves[i])) text += tr(" (earlier scan)");
    list_->addItem(new QListWidgetItem(Icon("valve"), text));
  }
  list_->setCurrentRow(session_->SelectedValve());
  const int rows = std::min(6, list_->count());
  list_->setFixedHeight(rows * std::max(24, list_->sizeHintForRow(0)) + 2 * list_->frameWidth());
  const bool chosen = session_->SelectedValve() >= 0;
  empty_->setVisible(valves.empty());
  list_->setVisible(!valves.empty());
  card_->setVisible(chosen);
  if (!chosen) return;
  const FoundValve& valve = valves[static_cast<std::size_t>(session_->SelectedValve())];
  card_->Show(valve, session_->IsCurrent(valve));
}

void ObjectsPanel::ShowFit() {
  fit_button_->setEnabled(fit_->CanFit());
  fit_button_->setToolTip(fit_->CanFit() ? tr("Fit a valve into the drawn region")
                                         : tr("Draw a region over a valve first"));
}

void ObjectsPanel::ShowAge() {
  if (session_->SelectedValve() >= 0)
    card_->ShowAge(session_->Valves()[static_cast<std::size_t>(session_->SelectedValve())]);
}

}  // namespace foresight
