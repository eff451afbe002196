#include "app/workstation/unsaved_question.h"

#include <QFileInfo>
#include <QPushButton>
#include <utility>

namespace foresight {
namespace {

constexpr int kLastTry_ms = 3000;

}  // namespace

UnsavedQuestion::UnsavedQuestion(RecordingViewModel* recording, std::function<void()> choose_file,
                                 QWidget* window)
    : QObject(window),
      recording_(recording),
      choose_file_(std::move(choose_file)),
      window_(window) {
  last_try_.setSingleShot(true);
  last_try_.setInterval(kLastTry_ms);
  connect(&last_try_, &QTimer::timeout, this, &UnsavedQuestion::Ask);
  // When the task that wrote has ended, too.
  connect(recording_, &RecordingViewModel::changed, this, &UnsavedQuestion::GoOn,
          Qt::QueuedConnection);
  connect(recording_, &RecordingViewModel::allWritten, this, &UnsavedQuestion::GoOn,
          Qt::QueuedConnection);
}

bool UnsavedQuestion::Asks() const {
  return question_ && question_->isVisible();
}

bool UnsavedQuestion::MayClose() {
  if (allowed_ || recording_->AllIsSafe()) return true;
  if (Asks()) {
    Ask();
    return false;
  }
  if (last_try_.isActive()) return false;
  recording_->tryAgain();
  if (recording_->Stuck() || recording_->FileHasMoved()) {
    Ask();
  } else {
    last_try_.start();
  }
  return false;
}

void UnsavedQuestion::GoOn() {
  if (Asks()) {
    if (recording_->AllIsSafe())
      question_->close();
    else
      question_->setText(WhatIsNotSafe());
  }
  if (!last_try_.isActive()) return;
  if (recording_->AllIsSafe()) {
    last_try_.stop();
    window_->close();
  } else if (recording_->Stuck()) {
    last_try_.stop();
    Ask();
  }
}

void UnsavedQuestion::CloseNow() {
  allowed_ = true;
  question_->hide();
  window_->close();
  // Another question may have kept it open.
  allowed_ = false;
}

QString UnsavedQuestion::WhatIsNotSafe() const {
  if (recording_->FileHasMoved())
    return tr("The mission file %1 was moved or deleted.")
        .arg(QFileInfo(recording_->Path()).fileName());
  return tr("In memory only: %1 (scans, objects, decisions, notes).").arg(recording_->Waiting());
}

void UnsavedQuestion::Ask() {
  if (!Asks()) {
    question_ =
        new QMessageBox(QMessageBox::Warning, tr("Quit"), {}, QMessageBox::NoButton, window_);
    question_->setObjectName(QStringLiteral("unsavedQuestion"));
    question_->setAttribute(Qt::WA_DeleteOnClose);
    question_->setInformativeText(tr("What no mission file holds is lost when the window closes."));
    QPushButton* stay = question_->addButton(tr("Stay"), QMessageBox::RejectRole);
    QPushButton* other =
        question_->addButton(tr("Record into another file"), QMessageBox::ActionRole);
    QPushButton* lose = question_->addButton(tr("Quit and lose it"), QMessageBox::DestructiveRole);
    question_->setDefaultButton(stay);
    question_->setEscapeButton(stay);
    connect(question_, &QMessageBox::finished, this, [this, lose] {
      // However it was closed, and by itself when all is safe.
      if (question_->clickedButton() != lose) Q_EMIT stayed();
    });
    connect(other, &QPushButton::clicked, this, [this] { choose_file_(); });
    connect(lose, &QPushButton::clicked, this, &UnsavedQuestion::CloseNow);
    question_->setModal(false);
  }
  question_->setText(WhatIsNotSafe());
  question_->show();
  question_->raise();
  question_->activateWindow();
}

}  // namespace foresight
