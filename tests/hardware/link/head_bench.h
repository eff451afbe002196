#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "hardware/link/client/remote_head.h"
#include "hardware/link/server/head_server.h"
#include "hardware/link/wire/channel_arguments.h"
#include "tests/hardware/link/fake_head.h"
#include "tests/support/temporary_folder.h"

namespace foresight {

/// Asks again and again until it is so, for so long at most.
inline bool Eventually(const std::function<bool()>& so, double longest_s = 10.0) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(longest_s);
  while (!so()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// A head that listens on loopback, and stations that connect to it. Both can be taken away and
/// made again, as when their programs die; what they keep on the disk stays.
class HeadBench {
 public:
  explicit HeadBench(std::shared_ptr<SensorHead> sensor_head) : sensor_head_(sensor_head) {
    StartHead();
  }

  void StartHead() {
    shelf_ = ScanShelf::Open({folder / "head", 0.9}).value();
    desk_ = std::make_unique<HeadDesk>(
        sensor_head_, *shelf_,
        HeadDesk::Options{2.0, true, nullptr, BurstDesk::kUsualBytesPerS, stand});
    const std::string address = "127.0.0.1:" + std::to_string(port_);
    server_ = HeadServer::Start(
                  *desk_, address, grpc::InsecureServerCredentials(),
                  [this](const grpc::ServerContext&) -> Result<HeadDesk::Peer> { return peer; })
                  .value();
    port_ = server_->port();
  }
  void StopHead() {
    server_.reset();
    desk_.reset();
    shelf_.reset();
  }

  ChannelMaker Channel() const {
    return [address = "127.0.0.1:" + std::to_string(port_)] {
      grpc::ChannelArguments arguments;
      SetStationArguments(arguments, LinkPath::kBursts, 250);
      return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
    };
  }
  Result<std::shared_ptr<RemoteHead>> Connect(std::shared_ptr<ScanArchive> archive = nullptr,
                                              bool looks_on = false) {
    RemoteHead::Options options;
    options.address = "127.0.0.1:" + std::to_string(port_);
    options.spool = folder / "spool";
    options.archive = std::move(archive);
    options.command_good_s = 3.0;
    options.looks_on = looks_on;
    return RemoteHead::Connect({Channel()}, options, std::chrono::milliseconds(3000));
  }

  ScanShelf& shelf() { return *shelf_; }
  HeadDesk& desk() { return *desk_; }
  int port() const { return port_; }

  const TemporaryFolder folder;
  HeadDesk::Peer peer{"anna", true};
  MovingStand* stand = nullptr;  ///< of the head that is started next

 private:
  const std::shared_ptr<SensorHead> sensor_head_;
  int port_ = 0;
  std::unique_ptr<ScanShelf> shelf_;
  std::unique_ptr<HeadDesk> desk_;
  std::unique_ptr<HeadServer> server_;
};

}  // namespace foresight
