#pragma once

#include <memory>
#include <thread>

#include "hardware/api/live_view.h"
#include "hardware/link/client/link_session.h"

namespace foresight {

/// A live view over the link: asks for it again when the link broke, until it is destroyed.
class LookClient {
 public:
  /// `session` outlives it.
  LookClient(LinkSession& session, const LiveViewOptions& options,
             std::shared_ptr<LiveViewSink> sink);

 private:
  void Work(const std::stop_token& stop);
  void Show(const link::LiveViewImage& message);

  LinkSession& session_;
  const link::LiveViewRequest request_;
  const std::shared_ptr<LiveViewSink> sink_;
  std::jthread thread_;  ///< last: starts when everything else is there
};

}  // namespace foresight
