#pragma once

#include <QString>
#include <QVector>
#include <optional>

#include "hardware/api/link_health.h"
#include "hardware/api/sensor_head.h"
#include "ui/viewmodels/notice.h"

namespace foresight {

/// What the head's answers are worth: whether its last word is current, and whether it did what the
/// operator told it. At the far end of a link only the head itself can say that it stopped; a head
/// in this process does so at once.
class HeadAnswers {
 public:
  /// What the operator is to be told, and the topics whose earlier notices no longer hold.
  struct News {
    QVector<QString> over;
    QVector<Notice> notices;
  };

  /// The latest of what is known; `link` is empty for a head in this process. `now_s` is a steady
  /// clock's time.
  News Update(double now_s, const std::optional<LinkHealth>& link, HeadState state);

  void StopPressed();
  void StopReleased();
  void AbortPressed();

  /// Whether words of the head come.
  bool Current() const { return !link_ || link_->connected; }
  /// Since its last word: "12 s".
  QString Silence() const;
  bool StopLatched() const { return stop_pressed_s_.has_value(); }
  /// Whether the head has said that it stands since STOP was pressed.
  bool StopConfirmed() const { return stop_confirmed_; }
  /// The head's state in a few words: "Head: sweeping", "STOP sent, not confirmed".
  QString Text() const;

 private:
  void LookAtLink(News* news);
  void LookAtStop(News* news);
  void LookAtAbort(News* news);
  QString StopText() const;
  bool Stands() const;
  bool KnowsNotWhetherItStands() const;

  double now_s_ = 0.0;
  std::optional<LinkHealth> link_;
  HeadState state_ = HeadState::kDisconnected;
  bool was_current_ = true;
  std::optional<double> stop_pressed_s_;  ///< empty = not pressed, or released
  bool stop_confirmed_ = false;
  std::optional<StopAnswer> stop_told_;  ///< the answer that the operator was told of
  enum class Abort { kNone, kSent, kDoubted, kGivenUp, kRefused } abort_ = Abort::kNone;
  double abort_pressed_s_ = 0.0;
};

}  // namespace foresight
