#include "hardware/link/wire/station_channels.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

namespace foresight {

std::vector<ChannelMaker> StationChannels(
    const std::string& address, const std::shared_ptr<grpc::ChannelCredentials>& credentials,
    LinkPath path, const std::string& certificate_host) {
  std::vector<ChannelMaker> makers;
  for (const int attempt_ms : AttemptsOn(path)) {
    grpc::ChannelArguments arguments;
    SetStationArguments(arguments, path, attempt_ms);
    if (!certificate_host.empty()) arguments.SetSslTargetNameOverride(certificate_host);
    makers.push_back([address, credentials, arguments] {
      return grpc::CreateCustomChannel(address, credentials, arguments);
    });
  }
  return makers;
}

}  // namespace foresight
