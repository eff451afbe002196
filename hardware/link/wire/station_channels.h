#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hardware/link/wire/channel_arguments.h"

namespace grpc {
class Channel;
class ChannelCredentials;
}  // namespace grpc

namespace foresight {

/// A station's channels to the head at HOST:PORT, for a ChannelRace: one for each length of an
/// attempt that suits the path. `certificate_host`: what must stand in the head's certificate;
/// empty = the host.
std::vector<std::shared_ptr<grpc::Channel>> StationChannels(
    const std::string& address, const std::shared_ptr<grpc::ChannelCredentials>& credentials,
    LinkPath path, const std::string& certificate_host = "");

}  // namespace foresight
