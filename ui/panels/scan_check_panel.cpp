#include "ui/panels/scan_check_panel.h"

#include <QDateTime>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/check_lamp.h"
#include "ui/widgets/dock_parts.h"

namespace foresight {

ScanCheckPanel::ScanCheckPanel(ScanCheckModel* check, QWidget* parent)
    : QWidget(parent),
      check_(check),
      sentence_(WordsLabel("checkAdvice")),
      when_(WordsLabel("faint")),
      points_(new QVBoxLayout),
      together_title_(SectionTitle({})),
      together_(new QVBoxLayout),
      cannot_see_title_(SectionTitle(tr("What this scan cannot tell"))),
      cannot_see_(WordsLabel("checkCannotSee")),
      again_(NarrowButton("checkAgain", tr("Check the scan"),
                          tr("Check depth, calibration and accepted objects of the scan on the "
                             "screen by the scan itself"))),
      cancel_(NarrowButton("cancelCheck", tr("Cancel"), tr("Stop the check that runs"))) {
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(6);
  buttons->addWidget(again_);
  buttons->addWidget(cancel_);
  auto* content = new QWidget;
  auto* layout = new QVBoxLayout(content);
  layout->setContentsMargins(12, 8, 12, 8);
  layout->setSpacing(8);
  layout->addWidget(sentence_);
  layout->addWidget(when_);
  layout->addLayout(buttons);
  points_->setSpacing(6);
  layout->addLayout(points_);
  layout->addWidget(together_title_);
  layout->addLayout(together_);
  layout->addWidget(cannot_see_title_);
  layout->addWidget(cannot_see_);
  layout->addStretch(1);
  FillWithScroll(this, content);
  connect(again_, &QPushButton::clicked, check_, &ScanCheckModel::check);
  connect(cancel_, &QPushButton::clicked, check_, &ScanCheckModel::cancel);
  connect(check_, &ScanCheckModel::changed, this, &ScanCheckPanel::Show);
  Show();
}

QWidget* ScanCheckPanel::PointRow(CheckLight light, const std::string& sentence) const {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  auto* sign = new QLabel;
  sign->setPixmap(CheckPixmap(light));
  layout->addWidget(sign, 0, Qt::AlignTop);
  auto* words = WordsLabel("checkPoint");
  words->setText(QString::fromStdString(sentence));
  layout->addWidget(words, 1);
  return row;
}

QWidget* ScanCheckPanel::PointRows(const std::vector<CheckPoint>& points, const char* name) const {
  auto* list = new QWidget;
  list->setObjectName(QString::fromLatin1(name));
  auto* rows = new QVBoxLayout(list);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(6);
  for (const CheckPoint& point : points) rows->addWidget(PointRow(point.light, point.sentence));
  return list;
}

void ScanCheckPanel::Show() {
  const KeptCheck* check = check_->Check();
  sentence_->setText(check_->Sentence());
  when_->setVisible(check != nullptr);
  if (check != nullptr)
    when_->setText(
        tr("Checked %1 by %2")
            .arg(QLocale().toString(QDateTime::fromMSecsSinceEpoch(check->utc_ns / 1'000'000),
                                    QLocale::ShortFormat),
                 QString::fromStdString(check->author)));
  delete list_;
  delete together_list_;
  const GatheredCheck* together = check_->Together();
  using Points = std::vector<CheckPoint>;
  list_ = PointRows(check != nullptr ? check->points : Points(), "checkPoints");
  together_list_ =
      PointRows(together != nullptr ? together->check.points : Points(), "checkTogether");
  points_->addWidget(list_);
  together_->addWidget(together_list_);
  together_title_->setVisible(together != nullptr);
  if (together != nullptr)
    together_title_->setText(tr("%1 scans of the mission together").arg(together->scans));
  QStringList cannot_see;
  if (check != nullptr)
    for (const std::string& sentence : check->cannot_see)
      cannot_see << QString::fromStdString(sentence);
  cannot_see_title_->setVisible(!cannot_see.isEmpty());
  cannot_see_->setVisible(!cannot_see.isEmpty());
  cannot_see_->setText(cannot_see.join(QStringLiteral("\n\n")));
  const bool checking = check_->Now() == ScanCheckModel::State::kChecking;
  again_->setEnabled(!checking && check_->Now() != ScanCheckModel::State::kNoScan);
  cancel_->setVisible(checking);
}

}  // namespace foresight
