#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "core/base/run_context.h"
#include "hardware/api/link_health.h"
#include "hardware/link/client/link_session.h"

namespace foresight {

/// Stops the head over a session that need not have begun: by an operator's certificate alone,
/// whoever has control. Sends until the head answers; how it is then. Fails with kState where the
/// head refuses, kDevice where no answer came in `patience`, kCancelled.
Result<HeadStatus> StopHead(LinkSession& session, std::chrono::milliseconds patience,
                            const RunContext& context);

/// The stop button's own way to the head: nothing is queued before it, and what was pressed is
/// sent until the head has answered or a minute is over (by then the head stops by itself, because
/// nobody is there). A stop that comes late stops; it starts nothing.
class StopSender {
 public:
  /// `session` outlives it. `on_answer` hears the head's answers, from the sender's thread.
  explicit StopSender(LinkSession& session,
                      std::function<void(const link::Outcome&)> on_answer = {});

  void Stop();
  /// To the last stop.
  StopAnswer Answer() const;

 private:
  void Work(const std::stop_token& stop);
  StopAnswer AnswerTo(const grpc::Status& called, const link::Outcome& outcome, double end_s);

  LinkSession& session_;
  const std::function<void(const link::Outcome&)> on_answer_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  int asked_ = 0;
  double pressed_s_ = 0.0;  ///< LinkSession::Now() of the last one
  int answered_ = 0;
  StopAnswer answer_ = StopAnswer::kNone;
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
