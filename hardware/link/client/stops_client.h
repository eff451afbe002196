#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "hardware/api/stop_capture.h"
#include "hardware/link/client/link_session.h"

namespace foresight {

/// Fetches the captures of one run of stops, through whatever happens to the link. The sink hears
/// the end once, whatever happens.
class StopsClient {
 public:
  /// `session` outlives it.
  StopsClient(LinkSession& session, std::string stops_id, std::shared_ptr<StopSink> sink);
  /// The sink hears an end as interrupted where it heard none.
  ~StopsClient();

  /// The head took the command: the captures come.
  void Started();
  /// The head did not, or nobody knows whether it did.
  void Refuse(const std::string& reason);

 private:
  void Work(const std::stop_token& stop);
  void End(ScanState state, const std::string& reason);

  LinkSession& session_;
  const std::string stops_id_;
  const std::shared_ptr<StopSink> sink_;
  std::atomic<bool> ended_{false};
  std::jthread thread_;
};

}  // namespace foresight
