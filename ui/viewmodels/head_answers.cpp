#include "ui/viewmodels/head_answers.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "ui/viewmodels/age_text.h"

namespace foresight {
namespace {

struct AnswerTexts {
  Q_DECLARE_TR_FUNCTIONS(HeadAnswers)
};

constexpr double kAnswerDue_s = 2.0;      ///< a head whose link is well answers long before
constexpr double kAbortGivenUp_s = 10.0;  ///< a command is void after 8 s

QString ShortTime(double seconds) {
  if (seconds < 120.0)
    return AnswerTexts::tr("%1 s").arg(std::max(0.0, std::floor(seconds)), 0, 'f', 0);
  return AgeText(std::chrono::seconds(static_cast<int>(seconds)));
}

Notice StopNotice(StopAnswer answer) {
  switch (answer) {
    case StopAnswer::kNone:
    case StopAnswer::kWaiting:
      break;
    case StopAnswer::kObeyed:
      return {Notice::Level::kWarning, AnswerTexts::tr("The head's motor was told to stop."),
              AnswerTexts::tr(
                  "This stops the scanner only, not the robot. Release the stop, then press "
                  "Home to go on."),
              kStopTopic};
    case StopAnswer::kRefused:
      return {
          Notice::Level::kError,
          AnswerTexts::tr("The head refused STOP: this certificate is an observer's."),
          AnswerTexts::tr("Take the head as moving. Ask the operator, or use the robot's emergency "
                          "stop."),
          kStopTopic};
    case StopAnswer::kUnknown:
      return {Notice::Level::kError,
              AnswerTexts::tr("STOP is not confirmed: the head did not answer in time."),
              AnswerTexts::tr(
                  "Take the head as moving. STOP is sent no longer: press STOP HEAD again."),
              kStopTopic};
  }
  return {
      Notice::Level::kError, AnswerTexts::tr("STOP was sent and is not confirmed."),
      AnswerTexts::tr("Take the head as moving until it answers. STOP is sent again and again; the "
                      "robot's emergency stop is separate."),
      kStopTopic};
}

}  // namespace

HeadAnswers::News HeadAnswers::Update(double now_s, const std::optional<LinkHealth>& link,
                                      HeadState state) {
  now_s_ = now_s;
  link_ = link;
  state_ = state;
  News news;
  LookAtLink(&news);
  LookAtStop(&news);
  LookAtAbort(&news);
  return news;
}

void HeadAnswers::StopPressed() {
  if (!StopLatched()) stop_pressed_s_ = now_s_;
  stop_confirmed_ = false;
  stop_told_.reset();
}

void HeadAnswers::StopReleased() {
  stop_pressed_s_.reset();
  stop_confirmed_ = false;
  stop_told_.reset();
}

void HeadAnswers::AbortPressed() {
  abort_ = Abort::kSent;
  abort_pressed_s_ = now_s_;
}

QString HeadAnswers::Silence() const {
  return ShortTime(link_ ? link_->age_s : 0.0);
}

/// A head in fault told its motor to stop, and does not know that it did; one that is not connected
/// knows nothing of its motor.
bool HeadAnswers::Stands() const {
  return state_ == HeadState::kReady;
}

bool HeadAnswers::KnowsNotWhetherItStands() const {
  return state_ == HeadState::kFault || state_ == HeadState::kDisconnected;
}

void HeadAnswers::LookAtLink(News* news) {
  if (was_current_ == Current()) return;
  was_current_ = Current();
  if (Current()) {
    news->over << kLinkTopic;
    return;
  }
  const QString check = AnswerTexts::tr("Check the network, and that foresight-head runs at %1.")
                            .arg(QString::fromStdString(link_->address));
  news->notices << Notice{
      Notice::Level::kWarning, AnswerTexts::tr("The link is lost: no word from the head."),
      (Stands() || state_ == HeadState::kDisconnected
           ? AnswerTexts::tr("What is shown of the head is old.")
           : AnswerTexts::tr("The head may still move. What it measures comes when the link is "
                             "back.")) +
          QLatin1Char(' ') + check,
      kLinkTopic};
}

void HeadAnswers::LookAtStop(News* news) {
  if (!StopLatched()) return;
  const StopAnswer answer = link_ ? link_->stop : StopAnswer::kObeyed;
  const bool obeyed = answer == StopAnswer::kObeyed;
  stop_confirmed_ = obeyed && Stands() && (Current() || stop_confirmed_);
  if (stop_told_ == answer) return;
  stop_told_ = answer;
  news->over << kStopTopic;
  news->notices << StopNotice(answer);
}

void HeadAnswers::LookAtAbort(News* news) {
  if (abort_ == Abort::kNone) return;
  if (Current() && KnowsNotWhetherItStands()) {
    abort_ = Abort::kNone;
    news->over << kAbortTopic;
    news->notices << Notice{Notice::Level::kWarning,
                            state_ == HeadState::kFault
                                ? AnswerTexts::tr("The scan was ended, and the head is in fault.")
                                : AnswerTexts::tr("The scan was ended, and the head is not "
                                                  "connected."),
                            AnswerTexts::tr("See that it stands, then press Home."), kAbortTopic};
    return;
  }
  if (!link_ || (Current() && Stands())) {
    abort_ = Abort::kNone;
    news->over << kAbortTopic;
    return;
  }
  if (abort_ == Abort::kRefused) return;
  if (link_->end_scan == StopAnswer::kRefused) {
    abort_ = Abort::kRefused;
    news->over << kAbortTopic;
    news->notices << Notice{
        Notice::Level::kError,
        AnswerTexts::tr("The head refused Abort: %1")
            .arg(QString::fromStdString(link_->end_scan_refusal)),
        AnswerTexts::tr("The head sweeps on. STOP HEAD stops it without control, too."),
        kAbortTopic};
    return;
  }
  const double waited_s = now_s_ - abort_pressed_s_;
  if (waited_s > kAbortGivenUp_s && abort_ != Abort::kGivenUp) {
    abort_ = Abort::kGivenUp;
    news->over << kAbortTopic;
    news->notices << Notice{
        Notice::Level::kWarning,
        AnswerTexts::tr("Abort is not confirmed: the head did not answer in time."),
        AnswerTexts::tr(
            "What has come is kept. Abort is sent no longer: press Abort again when the "
            "link is back."),
        kAbortTopic};
  } else if (abort_ == Abort::kSent && (!Current() || waited_s > kAnswerDue_s)) {
    abort_ = Abort::kDoubted;
    news->over << kAbortTopic;
    news->notices << Notice{
        Notice::Level::kWarning, AnswerTexts::tr("Abort was sent and is not confirmed."),
        AnswerTexts::tr("The head may sweep on. What has come is kept. STOP HEAD is sent until the "
                        "head answers."),
        kAbortTopic};
  }
}

QString HeadAnswers::StopText() const {
  if (stop_confirmed_)
    return Current() ? AnswerTexts::tr("Head: STOPPED")
                     : AnswerTexts::tr("Head: STOPPED, no word for %1").arg(Silence());
  switch (link_ ? link_->stop : StopAnswer::kObeyed) {
    case StopAnswer::kRefused:
      return AnswerTexts::tr("STOP refused");
    case StopAnswer::kObeyed:
      if (Current() && KnowsNotWhetherItStands())
        return state_ == HeadState::kFault
                   ? AnswerTexts::tr("STOP answered, the head is in fault: see that it stands")
                   : AnswerTexts::tr(
                         "STOP answered, the head is not connected: see that it stands");
      return Current() ? AnswerTexts::tr("STOP answered, head still %1")
                             .arg(QString::fromUtf8(ToString(state_)))
                       : AnswerTexts::tr("STOP answered, no word for %1").arg(Silence());
    case StopAnswer::kNone:
    case StopAnswer::kWaiting:
    case StopAnswer::kUnknown:
      break;
  }
  const double waited_s = now_s_ - *stop_pressed_s_;
  return waited_s < 1.0 ? AnswerTexts::tr("STOP sent, not confirmed")
                        : AnswerTexts::tr("STOP sent, not confirmed: no answer for %1")
                              .arg(ShortTime(waited_s));
}

QString HeadAnswers::Text() const {
  if (StopLatched()) return StopText();
  const QString state = QString::fromUtf8(ToString(state_));
  return Current() ? AnswerTexts::tr("Head: %1").arg(state)
                   : AnswerTexts::tr("Head: no word for %1 (was %2)").arg(Silence(), state);
}

}  // namespace foresight
