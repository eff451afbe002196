#include "hardware/link/server/head_service.h"

#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>

#include "hardware/link/protocol/messages.h"
#include "tests/hardware/link/fake_head.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

using testing::HasSubstr;

class HeadServiceTest : public testing::Test {
 protected:
  HeadServiceTest()
      : shelf(ScanShelf::Open({folder / "scans", 0.9}).value()),
        desk(head, *shelf, {}),
        service(desk, [this](const grpc::ServerContext&) { return peer; }) {
    grpc::ServerBuilder builder;
    builder.RegisterService(&service);
    server = builder.BuildAndStart();
    stub = link::SensorHead::NewStub(server->InProcessChannel({}));
  }
  ~HeadServiceTest() override {
    service.Close();
    server->Shutdown();
  }

  static void Prepare(grpc::ClientContext& context, const std::string& protocol = "1") {
    context.AddMetadata(kProtocolKey, protocol);
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(10));
  }

  const TemporaryFolder folder;
  const std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>();
  const std::unique_ptr<ScanShelf> shelf;
  HeadDesk desk;
  Result<HeadDesk::Peer> peer = HeadDesk::Peer{"anna", true};
  HeadService service;
  std::unique_ptr<grpc::Server> server;
  std::unique_ptr<link::SensorHead::Stub> stub;
};

TEST_F(HeadServiceTest, IdentifiesItselfWithWhatDoesNotChange) {
  grpc::ClientContext context;
  link::IdentifyReply reply;
  ASSERT_TRUE(stub->Identify(&context, {}, &reply).ok());
  EXPECT_EQ(reply.protocol(), kLinkProtocol);
  EXPECT_EQ(reply.description(), "fake head");
  EXPECT_EQ(reply.your_name(), "anna");
  EXPECT_TRUE(reply.may_operate());
  EXPECT_EQ(reply.boot_id().size(), 36u);
}

TEST_F(HeadServiceTest, AStationOfAnotherVersionIsToldSo) {
  for (const char* protocol : {"0", "2", "x", "99999999999999999999"}) {
    grpc::ClientContext context;
    Prepare(context, protocol);
    link::RigReply reply;
    const grpc::Status status = stub->GetRig(&context, {}, &reply);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
    EXPECT_THAT(status.error_message(), HasSubstr("install the same Foresight on both"));
  }
}

TEST_F(HeadServiceTest, WhoProvedNothingIsRefused) {
  peer = Fail(ErrorCode::kState, "no certificate");
  grpc::ClientContext context;
  Prepare(context);
  link::Outcome outcome;
  EXPECT_EQ(stub->Stop(&context, {}, &outcome).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(head->stops, 0);
}

TEST_F(HeadServiceTest, StopReachesTheHead) {
  grpc::ClientContext context;
  Prepare(context);
  link::Outcome outcome;
  ASSERT_TRUE(stub->Stop(&context, {}, &outcome).ok());
  EXPECT_EQ(head->stops, 1);
}

TEST_F(HeadServiceTest, AChangeOfStateComesByItself) {
  grpc::ClientContext context;
  Prepare(context);
  auto watch = stub->Watch(&context);
  ASSERT_TRUE(watch->Write({}));
  link::Event event;
  ASSERT_TRUE(watch->Read(&event));
  EXPECT_EQ(event.status().state(), link::DISCONNECTED);
  head->SetMessage("the lidar is silent");
  while (watch->Read(&event) && event.status().message().empty()) {
  }
  EXPECT_EQ(event.status().message(), "the lidar is silent");
  watch->WritesDone();
  while (watch->Read(&event)) {
  }
}

/// On a thin path the devices' health comes seldom; devices that have just been connected would
/// show as missing until then.
TEST_F(HeadServiceTest, AHeadThatBecomesReadyTellsHowItsDevicesDo) {
  grpc::ClientContext context;
  Prepare(context);
  auto watch = stub->Watch(&context);
  link::SignOfLife sign;
  sign.set_status_rate_hz(0.5);
  ASSERT_TRUE(watch->Write(sign));
  link::Event event;
  ASSERT_TRUE(watch->Read(&event));
  EXPECT_NE(event.status().health_json(), "");
  head->SetState(HeadState::kHoming);
  while (watch->Read(&event) && event.status().state() != link::HOMING) continue;
  EXPECT_EQ(event.status().health_json(), "");
  head->SetState(HeadState::kReady);
  while (watch->Read(&event) && event.status().state() != link::READY) continue;
  EXPECT_NE(event.status().health_json(), "");
  context.TryCancel();
}

TEST_F(HeadServiceTest, SignsOfLifeAreAnsweredAndRenewTheLease) {
  link::ControlReply control;
  {
    grpc::ClientContext context;
    Prepare(context);
    ASSERT_TRUE(stub->TakeControl(&context, {}, &control).ok());
    ASSERT_TRUE(control.granted());
  }
  grpc::ClientContext context;
  Prepare(context);
  auto watch = stub->Watch(&context);
  link::SignOfLife sign;
  sign.set_number(17);
  sign.set_control_token(control.token());
  ASSERT_TRUE(watch->Write(sign));
  link::Event event;
  while (watch->Read(&event) && event.answers() != 17) {
  }
  EXPECT_EQ(event.answers(), 17u);
  EXPECT_TRUE(event.you_have_control());
  EXPECT_EQ(event.operator_name(), "anna");
  EXPECT_GE(head->signs, 1);
  context.TryCancel();
}

TEST_F(HeadServiceTest, AStationThatSaysNothingMoreHasItsLastSignAnswered) {
  for (std::uint32_t number = 1; number <= 100; ++number) {
    grpc::ClientContext context;
    Prepare(context);
    auto watch = stub->Watch(&context);
    link::SignOfLife sign;
    sign.set_number(number);
    watch->WriteLast(sign, {});
    std::uint32_t answers = 0;
    link::Event event;
    while (watch->Read(&event)) answers = event.answers();
    EXPECT_EQ(answers, number);
    EXPECT_TRUE(watch->Finish().ok()) << number;
  }
}

TEST_F(HeadServiceTest, ScansThatChangeAreNamedInTheEvents) {
  head->SetState(HeadState::kReady);
  grpc::ClientContext context;
  Prepare(context);
  auto watch = stub->Watch(&context);
  link::Event event;
  ASSERT_TRUE(watch->Read(&event));
  const auto sink = shelf->Begin("scan-1", {}).value();
  ASSERT_TRUE(head->StartScan(ScanPlan(), sink));
  head->Play(SampleScan(5));
  std::string state;
  while (state != "complete" && watch->Read(&event))
    for (const link::ScanOnHead& scan : event.scans()) state = scan.state();
  EXPECT_EQ(state, "complete");
  context.TryCancel();
}

TEST_F(HeadServiceTest, TooManyWatchersAreRefusedAndTheOperatorsCallsGoOn) {
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<decltype(stub->Watch(nullptr))> watches;
  for (int i = 0; i < HeadService::kMostWatches; ++i) {
    contexts.push_back(std::make_unique<grpc::ClientContext>());
    Prepare(*contexts.back());
    watches.push_back(stub->Watch(contexts.back().get()));
    link::Event event;
    ASSERT_TRUE(watches.back()->Read(&event));
  }
  grpc::ClientContext more;
  Prepare(more);
  auto refused = stub->Watch(&more);
  link::Event event;
  EXPECT_FALSE(refused->Read(&event));
  EXPECT_EQ(refused->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  grpc::ClientContext context;
  Prepare(context);
  link::Outcome outcome;
  EXPECT_TRUE(stub->Stop(&context, {}, &outcome).ok());
  for (auto& open : contexts) open->TryCancel();
}

}  // namespace
}  // namespace foresight
