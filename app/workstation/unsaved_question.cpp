#include "app/workstation/unsaved_question.h"

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
  connect(recording_, &RecordingViewModel::allWritten, this, [this] {
    if (question_) question_->close();
  });
}

bool UnsavedQuestion::MayClose() {
  if (allowed_ || !recording_->Stuck()) return true;
  if (trying_) return false;
  trying_ = true;
  recording_->tryAgain();
  recording_->WriteAll(kLastTry_ms);
  trying_ = false;
  if (!recording_->Stuck()) return true;
  Ask();
  return false;
}

void UnsavedQuestion::Ask() {
  if (!question_) {
    question_ =
        new QMessageBox(QMessageBox::Warning, tr("Quit"), {}, QMessageBox::NoButton, window_);
    question_->setObjectName(QStringLiteral("unsavedQuestion"));
    question_->setAttribute(Qt::WA_DeleteOnClose);
    question_->setInformativeText(
        tr("No mission file has taken them. They are lost when the window closes."));
    QPushButton* stay = question_->addButton(tr("Stay"), QMessageBox::RejectRole);
    QPushButton* other =
        question_->addButton(tr("Record into another file"), QMessageBox::ActionRole);
    QPushButton* lose =
        question_->addButton(tr("Quit and lose them"), QMessageBox::DestructiveRole);
    question_->setDefaultButton(stay);
    question_->setEscapeButton(stay);
    connect(other, &QPushButton::clicked, this, [this] { choose_file_(); });
    connect(lose, &QPushButton::clicked, this, [this] {
      allowed_ = true;
      question_->hide();
      window_->close();
    });
    question_->setModal(false);
  }
  question_->setText(
      tr("In memory only: %1 (scans, objects, decisions).").arg(recording_->Waiting()));
  question_->show();
  question_->raise();
  question_->activateWindow();
}

}  // namespace foresight
