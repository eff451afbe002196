#include "ui/panels/timeline_panel.h"

#include <QDateTime>
#include <QHBoxLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/panels/command_button.h"
#include "ui/panels/theme.h"
#include "ui/panels/timeline_view.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {

TimelinePanel::TimelinePanel(TimelineModel* timeline, ReplayModel* replay, ReviewViewModel* review,
                             CommandTable* commands, QWidget* parent)
    : QWidget(parent),
      timeline_(timeline),
      replay_(replay),
      review_(review),
      commands_(commands),
      pages_(new QStackedWidget),
      view_(new TimelineView(timeline)) {
  auto* controls = new QHBoxLayout;
  controls->setContentsMargins(8, 2, 8, 2);
  controls->setSpacing(2);
  controls->addWidget(Button("timeline_previous", "review.previous_event"));
  play_ = Button("timeline_play", "review.play");
  controls->addWidget(play_);
  controls->addWidget(Button("timeline_next", "review.next_event"));
  controls->addWidget(Button("timeline_slower", "review.slower"));
  speed_ = new QLabel;
  speed_->setAlignment(Qt::AlignCenter);
  speed_->setMinimumWidth(speed_->fontMetrics().horizontalAdvance(QStringLiteral("0.25×")) + 8);
  controls->addWidget(speed_);
  controls->addWidget(Button("timeline_faster", "review.faster"));
  controls->addWidget(Button("timeline_whole", "review.whole"));
  moment_ = new QuietLabel(QuietLabel::Ground::kWindow);
  controls->addWidget(moment_, 1);

  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(controls);
  column->addWidget(view_, 1);
  auto* hint =
      new QLabel(tr("The timeline of a mission appears here when it is open for review "
                    "(Ctrl+O)"));
  hint->setObjectName(QStringLiteral("emptyState"));
  hint->setAlignment(Qt::AlignCenter);
  hint->setWordWrap(true);
  pages_->addWidget(hint);
  pages_->addWidget(page);
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->addWidget(pages_);

  connect(view_, &TimelineView::chosen, this, &TimelinePanel::GoTo);
  connect(view_, &TimelineView::sought, replay_, &ReplayModel::SeekTo);
  connect(timeline_, &TimelineModel::changed, this, &TimelinePanel::ShowMoment);
  connect(replay_, &ReplayModel::moved, this, [this] {
    if (replay_->Playing()) timeline_->BringIntoSight(replay_->Now());
    ShowMoment();
  });
  connect(replay_, &ReplayModel::changed, this, &TimelinePanel::ShowMoment);
  ShowMoment();
}

QToolButton* TimelinePanel::Button(const char* icon, const char* command) {
  auto* button = new QToolButton;
  button->setIcon(Icon(icon));
  button->setAutoRaise(true);
  button->setObjectName(QString::fromLatin1(command));
  button->setAccessibleName(commands_->Get(command).text);
  BindButton(button, commands_, command);
  return button;
}

void TimelinePanel::GoTo(const TimelineEntry& entry) {
  if (!entry.scan_uuid.empty())
    review_->Open(review_->Path(), entry.scan_uuid, entry.object_uuid);
  else
    replay_->SeekTo(entry.begin_utc_ns);  // what was to be seen when that happened
}

QString TimelinePanel::MomentText() const {
  if (replay_->Now() == 0) return {};
  const QDateTime time = QDateTime::fromMSecsSinceEpoch(replay_->Now() / 1'000'000);
  QString text = time.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz")).chopped(2);
  text += replay_->Active() ? tr(", the moment in the replay") : tr(", all of the scan");
  if (replay_->Loading()) text += tr(", loading the scan …");
  return text;
}

void TimelinePanel::ShowMoment() {
  pages_->setCurrentIndex(timeline_->Timeline() ? 1 : 0);
  const int scan = review_->ScanIndex();
  const bool known = scan >= 0 && scan < static_cast<int>(review_->Scans().size());
  view_->SetNow(replay_->Now(),
                known ? review_->Scans()[static_cast<std::size_t>(scan)].uuid : std::string());
  moment_->SetText(MomentText());
  const QString speed = tr("%1×").arg(replay_->Speed());
  if (speed_->text() != speed) speed_->setText(speed);
  const bool playing = replay_->Playing();
  if (play_->property("playing").toBool() != playing) {
    play_->setProperty("playing", playing);
    play_->setIcon(Icon(playing ? "timeline_pause" : "timeline_play"));
  }
}

}  // namespace foresight
