#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hardware/link/wire/channel_arguments.h"

namespace grpc {
class Channel;
class ChannelCredentials;
}  // namespace grpc

namespace foresight {

/// Makes a channel that has not begun to connect.
using ChannelMaker = std::function<std::shared_ptr<grpc::Channel>()>;

/// A station's channels to the head at HOST:PORT, for a ChannelRace: one for each length of an
/// attempt that suits the path. `certificate_host`: what must stand in the head's certificate;
/// empty = the host.
std::vector<ChannelMaker> StationChannels(
    const std::string& address, const std::shared_ptr<grpc::ChannelCredentials>& credentials,
    LinkPath path, const std::string& certificate_host = "");

}  // namespace foresight
