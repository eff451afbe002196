#include "ui/panels/verdict_view.h"

#include <QLabel>
#include <QVBoxLayout>

#include "ui/panels/theme.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {
namespace {

QColor ColorOf(CalibrationCheck::Level level) {
  switch (level) {
    case CalibrationCheck::Level::kGood:
      return state_color::kGood;
    case CalibrationCheck::Level::kCaution:
      return state_color::kCaution;
    case CalibrationCheck::Level::kBad:
      break;
  }
  return state_color::kBad;
}

/// A mark besides the colour, for who cannot tell colours apart.
QString MarkOf(CalibrationCheck::Level level) {
  switch (level) {
    case CalibrationCheck::Level::kGood:
      return QStringLiteral("✓");
    case CalibrationCheck::Level::kCaution:
      return QStringLiteral("!");
    case CalibrationCheck::Level::kBad:
      break;
  }
  return QStringLiteral("✗");
}

}  // namespace

VerdictView::VerdictView(QWidget* parent)
    : QWidget(parent),
      summary_(WordsLabel("calibrationVerdict")),
      checks_(WordsLabel("calibrationChecks")) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(summary_);
  layout->addWidget(checks_);
}

void VerdictView::Show(const std::vector<CalibrationCheck>& checks) {
  setVisible(!checks.empty());
  if (checks.empty()) return;
  const CalibrationCheck summary = Summarize(checks);
  summary_->setText(summary.text);
  summary_->setStyleSheet(QStringLiteral("color: #16181c; background: %1; border-radius: 4px; "
                                         "padding: 4px 8px; font-weight: bold;")
                              .arg(ColorOf(summary.level).name()));
  QStringList lines;
  for (const CalibrationCheck& check : checks)
    lines << MarkOf(check.level) + QLatin1Char(' ') + check.text;
  checks_->setText(lines.join(QLatin1Char('\n')));
}

}  // namespace foresight
