#include "app/workstation/quit_question.h"

#include <QPushButton>
#include <QTimer>
#include <utility>

namespace foresight {
namespace {

constexpr int kScanEnds_ms = 3000;  ///< a head that stops ends its scan within a line

}  // namespace

QuitQuestion::QuitQuestion(HeadViewModel* head, QWidget* window)
    : QObject(window), head_(head), window_(window) {
  connect(head_, &HeadViewModel::statusChanged, this, [this] {
    if (Sweeps()) {
      SayWhatItDoes();
      return;
    }
    if (question_) question_->close();
    CloseOnce();
  });
}

bool QuitQuestion::Sweeps() const {
  return head_->MovesForUs();
}

bool QuitQuestion::MayClose() {
  if (allowed_ || !Sweeps()) return true;
  Ask();
  return false;
}

void QuitQuestion::Ask() {
  if (question_) {
    question_->raise();
    question_->activateWindow();
    return;
  }
  question_ = new QMessageBox(QMessageBox::Warning, tr("Quit"), tr("A scan is running."),
                              QMessageBox::NoButton, window_);
  question_->setObjectName(QStringLiteral("quitQuestion"));
  question_->setAttribute(Qt::WA_DeleteOnClose);
  SayWhatItDoes();
  QPushButton* stay = question_->addButton(tr("Stay"), QMessageBox::RejectRole);
  QPushButton* quit =
      question_->addButton(tr("End the scan and quit"), QMessageBox::DestructiveRole);
  question_->setDefaultButton(stay);
  question_->setEscapeButton(stay);
  connect(quit, &QPushButton::clicked, this, [this] {
    Allow();
    quitting_ = true;
    question_->hide();
    // The scan's end belongs into the mission; a head that does not answer holds nothing up.
    QTimer::singleShot(kScanEnds_ms, this, &QuitQuestion::CloseOnce);
    head_->StopForGood();
  });
  question_->setModal(false);
  question_->show();
}

void QuitQuestion::CloseOnce() {
  if (std::exchange(quitting_, false)) window_->close();
}

void QuitQuestion::SayWhatItDoes() {
  if (!question_) return;
  const QString text =
      head_->Answers().Current()
          ? tr("Quitting now stops the head and ends the scan.")
          : tr("The head cannot be reached: it goes on moving until it notices that this station "
               "is gone. If it must stand now, use the robot's emergency stop.");
  if (question_->informativeText() != text) question_->setInformativeText(text);
}

}  // namespace foresight
