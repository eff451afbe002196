// What the arguments of channel and server are there for.
#include <gmock/gmock.h>

#include "tests/hardware/link/wire/link_end.h"

namespace foresight {
namespace {

/// Says who it is with a description of a set length.
class VerboseHead : public link::SensorHead::Service {
 public:
  explicit VerboseHead(std::size_t reply_bytes) : text_(reply_bytes, 'x') {
    grpc::ServerBuilder builder;
    SetHeadArguments(builder);
    builder.AddListeningPort("127.0.0.1:0", PlaintextHeadCredentials("127.0.0.1").value(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~VerboseHead() override { server_->Shutdown(std::chrono::system_clock::now()); }

  grpc::Status Identify(grpc::ServerContext*, const link::IdentifyRequest*,
                        link::IdentifyReply* reply) override {
    reply->set_description(text_);
    return grpc::Status::OK;
  }

  grpc::Status Identify(std::size_t request_bytes, std::size_t& reply_bytes) const {
    grpc::ChannelArguments arguments;
    SetStationArguments(arguments, LinkPath::kThin, 20'000);
    const auto stub = link::SensorHead::NewStub(
        grpc::CreateCustomChannel(fmt::format("127.0.0.1:{}", port_),
                                  PlaintextStationCredentials("127.0.0.1").value(), arguments));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    link::IdentifyRequest request;
    request.set_program(std::string(request_bytes, 'x'));
    link::IdentifyReply reply;
    const grpc::Status status = stub->Identify(&context, request, &reply);
    reply_bytes = reply.description().size();
    return status;
  }

 private:
  std::string text_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

constexpr std::size_t kTooMuch = kLargestMessageBytes + 1;
constexpr std::size_t kMuch = kLargestMessageBytes - 64;  // and the message's frame

TEST(LinkArguments, AMessageOfSixteenMebibytesArrives) {
  const VerboseHead head(kMuch);
  std::size_t reply_bytes = 0;
  const grpc::Status status = head.Identify(kMuch, reply_bytes);
  EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(reply_bytes, kMuch);
}

TEST(LinkArguments, ALargerOneIsRefusedByEitherSide) {
  std::size_t reply_bytes = 0;
  EXPECT_EQ(VerboseHead(10).Identify(kTooMuch, reply_bytes).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(VerboseHead(kTooMuch).Identify(10, reply_bytes).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST(LinkArguments, ASecondServerOnThePortIsAnError) {
  const TinyHead head(PlaintextHeadCredentials("127.0.0.1").value());
  grpc::ServerBuilder builder;
  SetHeadArguments(builder);
  int port = 0;
  builder.AddListeningPort(head.Address(), PlaintextHeadCredentials("127.0.0.1").value(), &port);
  EXPECT_EQ(builder.BuildAndStart(), nullptr);
}

}  // namespace
}  // namespace foresight
