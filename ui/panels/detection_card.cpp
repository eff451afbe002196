#include "ui/panels/detection_card.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/detection/candidates.h"
#include "core/detection/facts.h"
#include "ui/panels/theme.h"
#include "ui/viewmodels/age_text.h"

namespace foresight {
namespace {

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

}  // namespace

DetectionCard::DetectionCard(QWidget* parent)
    : QFrame(parent),
      stale_(Wrapped()),
      reason_(Wrapped()),
      advice_(Wrapped("faint")),
      answer_(Wrapped("answer")),
      facts_(new QFormLayout) {
  setObjectName(QStringLiteral("card"));
  stale_->setText(tr("From an earlier scan: not drawn"));
  answer_->setAccessibleName(tr("Answer"));
  facts_->setVerticalSpacing(6);
  facts_->setHorizontalSpacing(12);
  facts_->setContentsMargins(0, 0, 0, 0);
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
  previous->setToolTip(tr("The answer before (Shift+Tab in a pane)"));
  previous->setAccessibleName(tr("Previous answer"));
  auto* next = new QToolButton;
  next->setArrowType(Qt::RightArrow);
  next->setToolTip(tr("The next answer (Tab in a pane)"));
  next->setAccessibleName(tr("Next answer"));
  steps->addWidget(previous);
  steps->addWidget(next);
  layout->addWidget(answer_, 1);
  layout->addWidget(steps_, 0, Qt::AlignTop);
  connect(previous, &QToolButton::clicked, this, &DetectionCard::previousAsked);
  connect(next, &QToolButton::clicked, this, &DetectionCard::nextAsked);
  return row;
}

void DetectionCard::AddRow(const QString& name, const QString& value) {
  auto* title = new QLabel(name);
  title->setObjectName(QStringLiteral("faint"));
  auto* text = Wrapped();
  text->setText(value);
  facts_->addRow(title, text);
}

void DetectionCard::ShowVerdict(const Verdict& verdict, VerdictLevel candidate_level) {
  const Look look = LookOf(candidate_level);
  badge_->setStyleSheet(QStringLiteral("QFrame { background: %1; border-radius: 4px; } "
                                       "QLabel { color: #16181c; font-weight: bold; }")
                            .arg(look.color.name()));
  badge_icon_->setPixmap(Icon(look.icon).pixmap(20, 20));
  badge_text_->setText(
      tr("%1, %2").arg(QString::fromUtf8(ToString(candidate_level)),
                       QString::fromStdString(ProbabilityText(verdict.probability))));
  reason_->setText(QString::fromStdString(verdict.reason));
}

void DetectionCard::Show(const FoundObject& object, int candidate, bool is_current) {
  const Detection& found = object.detection;
  const auto* terrain = std::get_if<TerrainDetection>(&found);
  const bool has_surface = terrain != nullptr && !terrain->surfaces.empty();
  const auto surface = static_cast<std::size_t>(candidate);
  ShowVerdict(has_surface ? terrain->surfaces[surface].verdict : VerdictOf(found),
              CandidateLevel(found, candidate));
  stale_->setVisible(!is_current);
  advice_->setText(QString::fromStdString(AdviceOn(found)));
  steps_->setVisible(CandidateCount(found) > 1);

  while (facts_->rowCount() > 0) facts_->removeRow(0);
  bool first = true;
  for (const Fact& fact : FactsOf(found, candidate, object.rig.robot_from_base)) {
    if (std::exchange(first, false))
      answer_->setText(QString::fromStdString(fact.value));
    else
      AddRow(QString::fromStdString(fact.name), QString::fromStdString(fact.value));
  }
  AddRow(tr("Fitted to"), QString::fromStdString(SourceTitle(OriginOf(found).source)));
  AddRow(tr("Scan"), object.scan_time.toString(QStringLiteral("yyyy-MM-dd HH:mm:ss")));
  AddRow(tr("Found"), {});
  age_ = qobject_cast<QLabel*>(
      facts_->itemAt(facts_->rowCount() - 1, QFormLayout::FieldRole)->widget());
  ShowAge(object);
}

void DetectionCard::ShowAge(const FoundObject& object) {
  const auto age = std::chrono::steady_clock::now() - object.found;
  age_->setText(tr("%1 ago").arg(AgeText(std::chrono::duration_cast<std::chrono::seconds>(age))));
}

}  // namespace foresight
