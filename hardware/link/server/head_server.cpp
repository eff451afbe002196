#include "hardware/link/server/head_server.h"

#include <grpcpp/resource_quota.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include "hardware/link/wire/channel_arguments.h"

namespace foresight {
namespace {

/// Streams take a thread each; these are left for calls.
constexpr int kMostThreads = HeadService::kMostWatches + HeadService::kMostTransfers + 32;

}  // namespace

Result<std::unique_ptr<HeadServer>> HeadServer::Start(
    HeadDesk& desk, const std::string& address,
    const std::shared_ptr<grpc::ServerCredentials>& credentials, PeerReader peer) {
  auto server = std::unique_ptr<HeadServer>(new HeadServer(desk, std::move(peer)));
  grpc::ServerBuilder builder;
  SetHeadArguments(builder);
  grpc::ResourceQuota quota("head");
  quota.SetMaxThreads(kMostThreads);
  builder.SetResourceQuota(quota);
  builder.AddListeningPort(address, credentials, &server->port_);
  builder.RegisterService(&server->service_);
  server->server_ = builder.BuildAndStart();
  if (!server->server_ || server->port_ == 0)
    return Fail(ErrorCode::kIo,
                "{}: cannot listen there: is another foresight-head running, and is it an address "
                "of this computer?",
                address);
  return server;
}

HeadServer::HeadServer(HeadDesk& desk, PeerReader peer) : service_(desk, std::move(peer)) {}

HeadServer::~HeadServer() {
  service_.Close();
  if (server_) server_->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(2));
}

}  // namespace foresight
