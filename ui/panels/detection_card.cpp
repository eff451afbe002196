#include "ui/panels/detection_card.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/detection/candidates.h"
#include "core/detection/facts.h"
#include "ui/panels/theme.h"
#include "ui/viewmodels/advice.h"
#include "ui/viewmodels/age_text.h"
#include "ui/widgets/quiet_label.h"

namespace foresight {
namespace {

/// Before a row was laid out its width is not known; a text that wraps needs no more lines than
/// here.
constexpr int kNarrowValue_px = 150;

struct Look {
  const char* icon;
  QColor color;
};

Look LookOf(VerdictLevel level) {
  switch (level) {
    case VerdictLevel::kConfirmed:
      return {"confirmed", state_color::kGood};
    case VerdictLevel::kLikely:
      return {"likely", state_color::kCaution};
    case VerdictLevel::kUnsure:
      break;
  }
  return {"unsure", state_color::kBad};
}

QLabel* Wrapped(const char* object_name = "") {
  auto* label = new QLabel;
  label->setWordWrap(true);
  label->setObjectName(QString::fromLatin1(object_name));
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

QLabel* Faint(const QString& text = {}) {
  auto* label = new QLabel(text);
  label->setObjectName(QStringLiteral("faint"));
  return label;
}

QString LinesText(const std::optional<ScanPart>& part) {
  if (!part) return DetectionCard::tr("all of the scan");
  return part->of_lines > part->lines
             ? DetectionCard::tr("%1 of %2, before the rest came")
                   .arg(part->lines)
                   .arg(part->of_lines)
             : DetectionCard::tr("%1, before the scan's end").arg(part->lines);
}

}  // namespace

DetectionCard::DetectionCard(QWidget* parent)
    : QFrame(parent),
      stale_(Wrapped()),
      reason_(Wrapped()),
      advice_(Wrapped("faint")),
      answer_(Wrapped("answer")),
      facts_(new QFormLayout),
      age_(new QuietLabel(QuietLabel::Ground::kCard)) {
  setObjectName(QStringLiteral("card"));
  stale_->setText(tr("From an earlier scan: not drawn"));
  answer_->setAccessibleName(tr("Answer"));
  facts_->setVerticalSpacing(6);
  facts_->setHorizontalSpacing(12);
  facts_->setContentsMargins(0, 0, 0, 0);
  facts_->addRow(Faint(tr("Found")), age_);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(10);
  layout->addWidget(BuildBadge(), 0, Qt::AlignLeft);
  layout->addWidget(stale_);
  layout->addWidget(reason_);
  layout->addWidget(advice_);
  layout->addWidget(BuildSteps());
  layout->addLayout(facts_);
}

QWidget* DetectionCard::BuildBadge() {
  badge_ = new QFrame;
  badge_icon_ = new QLabel;
  badge_text_ = new QLabel;
  auto* row = new QHBoxLayout(badge_);
  row->setContentsMargins(8, 4, 12, 4);
  row->addWidget(badge_icon_);
  row->addWidget(badge_text_);
  return badge_;
}

QWidget* DetectionCard::BuildSteps() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  steps_ = new QWidget;
  auto* steps = new QHBoxLayout(steps_);
  steps->setContentsMargins(0, 0, 0, 0);
  steps->setSpacing(2);
  auto* previous = new QToolButton;
  previous->setArrowType(Qt::LeftArrow);
  previous->setToolTip(tr("The answer before (Shift+N)"));
  previous->setAccessibleName(tr("Previous answer"));
  auto* next = new QToolButton;
  next->setArrowType(Qt::RightArrow);
  next->setToolTip(tr("The next answer (N)"));
  next->setAccessibleName(tr("Next answer"));
  steps->addWidget(previous);
  steps->addWidget(next);
  layout->addWidget(answer_, 1);
  layout->addWidget(steps_, 0, Qt::AlignTop);
  connect(previous, &QToolButton::clicked, this, &DetectionCard::previousAsked);
  connect(next, &QToolButton::clicked, this, &DetectionCard::nextAsked);
  return row;
}

void DetectionCard::ShowRows(const QVector<std::pair<QString, QString>>& rows) {
  while (rows_.size() < rows.size()) {
    QLabel* title = Faint();
    QLabel* value = Wrapped();
    facts_->insertRow(rows_.size(), title, value);
    rows_ << std::pair(title, value);
  }
  for (int i = 0; i < rows_.size(); ++i) {
    const auto& [title, value] = rows_[i];
    const bool shown = i < rows.size();
    title->setVisible(shown);
    value->setVisible(shown);
    if (!shown) continue;
    title->setText(rows[i].first);
    if (value->text() == rows[i].second) continue;
    value->setText(rows[i].second);
    value->setMinimumHeight(value->heightForWidth(std::max(value->width(), kNarrowValue_px)));
  }
}

void DetectionCard::Show(const FoundObject& object, int candidate, bool is_current,
                         SessionMode mode) {
  const Detection& found = object.detection;
  const Advice advice = AdviceFor(object, candidate, is_current, mode);
  const Look look = LookOf(advice.level);
  const QString style = QStringLiteral(
                            "QFrame { background: %1; border-radius: 4px; } "
                            "QLabel { color: #16181c; font-weight: bold; }")
                            .arg(look.color.name());
  if (badge_->styleSheet() != style) badge_->setStyleSheet(style);
  badge_icon_->setPixmap(Icon(look.icon).pixmap(20, 20));
  badge_text_->setText(advice.badge);
  advice_->setText(advice.text);
  reason_->setText(ReasonFor(found, candidate));
  reason_->setVisible(!reason_->text().isEmpty());
  stale_->setVisible(!is_current);
  steps_->setVisible(CandidateCount(found) > 1);

  QVector<std::pair<QString, QString>> rows;
  for (const Fact& fact : FactsOf(found, candidate, object.rig.robot_from_base))
    rows << std::pair(QString::fromStdString(fact.name), QString::fromStdString(fact.value));
  answer_->setText(rows.takeFirst().second);
  const auto behind = MarginBehindBest(found, candidate);
  answer_->setToolTip(behind ? tr("%1 nats behind the best answer").arg(*behind, 0, 'f', 0)
                             : QString());
  QString source = QString::fromStdString(SourceTitle(OriginOf(found).source));
  if (OriginOf(found).image) source = tr("%1 and the image").arg(source);
  rows << std::pair(tr("Fitted to"), object.by_robot ? tr("%1, on the robot").arg(source) : source)
       << std::pair(tr("Lines"), LinesText(object.part))
       << std::pair(tr("Scan"), object.scan_time.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")))
       << std::pair(tr("Kept"), object.kept ? tr("in the mission") : tr("not written yet"));
  if (!object.robot.isEmpty()) rows << std::pair(tr("Robot"), object.robot);
  ShowRows(rows);
  ShowAge(object);
}

QString DetectionCard::Badge() const {
  return badge_text_->text();
}

void DetectionCard::ShowAge(const FoundObject& object) {
  const auto age = std::chrono::steady_clock::now() - object.found;
  age_->SetText(tr("%1 ago").arg(AgeText(std::chrono::duration_cast<std::chrono::seconds>(age))));
}

}  // namespace foresight
