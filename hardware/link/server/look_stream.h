#pragma once

#include <atomic>

#include "hardware/link/server/head_desk.h"
#include "sensor_head.grpc.pb.h"

namespace foresight {

/// The live view of one station: the newest image goes out when the path takes one, older ones are
/// left out. A head has one live view, that of the station that asked last.
class LookStream {
 public:
  using Stream = grpc::ServerWriter<link::LiveViewImage>;

  LookStream(HeadDesk& desk, grpc::ServerContext& context, Stream& stream)
      : desk_(desk), context_(context), stream_(stream) {}

  /// Until the station is gone, another one looks, or `closing`.
  grpc::Status Run(const link::LiveViewRequest& request, const std::atomic<bool>& closing);

 private:
  HeadDesk& desk_;
  grpc::ServerContext& context_;
  Stream& stream_;
};

}  // namespace foresight
