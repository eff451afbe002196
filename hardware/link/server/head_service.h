#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "hardware/link/server/fit_desk.h"
#include "hardware/link/server/head_desk.h"
#include "hardware/link/server/item_cache.h"
#include "sensor_head.grpc.pb.h"

namespace foresight {

/// Who calls, as the connection proved it; fails where it proved nothing.
using PeerReader = std::function<Result<HeadDesk::Peer>(const grpc::ServerContext&)>;

/// The protocol before a HeadDesk: turns calls into the desk's, and refuses what has no place
/// there. Streams end when the station is gone, or Close() is called.
class HeadService final : public link::SensorHead::Service {
 public:
  /// Streams of one kind at a time, of all stations together; one more is refused, so that they
  /// leave threads for the operator's calls.
  static constexpr int kMostWatches = 32;
  static constexpr int kMostTransfers = 16;
  static constexpr int kMostLooks = 8;
  static constexpr int kMostPoses = 4;  ///< that wait for the robot
  static constexpr int kMostFits = 4;   ///< that wait for the head
  static constexpr int kMostImages = 4;

  HeadService(HeadDesk& desk, PeerReader peer);
  void Close();

  grpc::Status Identify(grpc::ServerContext* context, const link::IdentifyRequest* request,
                        link::IdentifyReply* reply) override;
  grpc::Status Watch(grpc::ServerContext* context,
                     grpc::ServerReaderWriter<link::Event, link::SignOfLife>* stream) override;
  grpc::Status TakeControl(grpc::ServerContext* context, const link::ControlRequest* request,
                           link::ControlReply* reply) override;
  grpc::Status ReleaseControl(grpc::ServerContext* context, const link::ReleaseRequest* request,
                              link::ControlReply* reply) override;
  grpc::Status Execute(grpc::ServerContext* context, const link::Command* command,
                       link::Outcome* outcome) override;
  grpc::Status Stop(grpc::ServerContext* context, const link::StopRequest* request,
                    link::Outcome* outcome) override;
  grpc::Status GetStand(grpc::ServerContext* context, const link::StandRequest* request,
                        link::StandReply* reply) override;
  grpc::Status GetRig(grpc::ServerContext* context, const link::RigRequest* request,
                      link::RigReply* reply) override;
  grpc::Status Transfer(
      grpc::ServerContext* context,
      grpc::ServerReaderWriter<link::Chunk, link::TransferRequest>* stream) override;
  grpc::Status Look(grpc::ServerContext* context, const link::LiveViewRequest* request,
                    grpc::ServerWriter<link::LiveViewImage>* stream) override;
  grpc::Status FetchStops(grpc::ServerContext* context, const link::StopsRequest* request,
                          grpc::ServerWriter<link::StopEvent>* stream) override;
  grpc::Status PublishPose(grpc::ServerContext* context, const link::PoseRequest* request,
                           link::PoseReply* reply) override;
  grpc::Status OpenBurst(grpc::ServerContext* context, const link::BurstRequest* request,
                         link::BurstReply* reply) override;
  grpc::Status Fit(grpc::ServerContext* context, const link::FitRequest* request,
                   link::FitReply* reply) override;
  grpc::Status FetchImage(grpc::ServerContext* context, const link::ImageRequest* request,
                          link::ImageReply* reply) override;
  grpc::Status ListScans(grpc::ServerContext* context, const link::ListScansRequest* request,
                         link::ListScansReply* reply) override;

 private:
  Result<HeadDesk::Peer> Admit(const grpc::ServerContext& context, grpc::Status* refusal) const;

  HeadDesk& desk_;
  ItemCache cache_;
  FitDesk fits_;
  const PeerReader peer_;
  std::atomic<bool> closing_{false};
  std::atomic<int> watches_{0};
  std::atomic<int> transfers_{0};
  std::atomic<int> looks_{0};
  std::atomic<int> poses_{0};
  std::atomic<int> fitting_{0};
  std::atomic<int> images_{0};
};

}  // namespace foresight
