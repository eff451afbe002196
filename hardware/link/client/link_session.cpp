#include "hardware/link/client/link_session.h"

#include <grpcpp/channel.h>

#include "core/base/version.h"

namespace foresight {

LinkSession::LinkSession(std::vector<ChannelMaker> channels, std::string address,
                         bool wants_control)
    : address_(std::move(address)), race_(std::move(channels)), wants_control_(wants_control) {}

std::shared_ptr<link::SensorHead::Stub> LinkSession::CurrentStub() {
  auto channel = race_.Current();
  const std::lock_guard lock(mutex_);
  if (channel != channel_) stub_ = link::SensorHead::NewStub(channel);
  channel_ = std::move(channel);
  return stub_;
}

std::shared_ptr<link::SensorHead::Stub> LinkSession::stub(const grpc::ClientContext& context) {
  race_.Wait(context.deadline());
  return CurrentStub();
}

std::shared_ptr<link::SensorHead::Stub> LinkSession::WaitForStub(const std::stop_token& stop) {
  return race_.Wait(stop) ? CurrentStub() : nullptr;
}

double LinkSession::Now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::unique_ptr<grpc::ClientContext> LinkSession::Context(std::chrono::milliseconds timeout) {
  auto context = std::make_unique<grpc::ClientContext>();
  context->AddMetadata(kProtocolKey, std::to_string(kLinkProtocol));
  if (timeout.count() > 0) {
    context->set_deadline(std::chrono::system_clock::now() + timeout);
    // Who waits in a call moves the connection on; a call that fails at once leaves a handshake to
    // gRPC's own look at it every five seconds, and a window of a second is over by then.
    context->set_wait_for_ready(true);
  }
  return context;
}

Error LinkSession::ToError(const grpc::Status& status, const char* what) const {
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return {
          ErrorCode::kDevice,
          fmt::format("{}: no connection to the head ({}): is foresight-head running there, and "
                      "are the keys of one CA? {}",
                      address_, what, status.error_message())};
    case grpc::StatusCode::FAILED_PRECONDITION:
      return {ErrorCode::kState, fmt::format("{}: {}", address_, status.error_message())};
    default:
      return {ErrorCode::kDevice,
              fmt::format("{}: {} failed: {}", address_, what, status.error_message())};
  }
}

Status LinkSession::Begin(std::chrono::milliseconds timeout) {
  link::IdentifyRequest request;
  request.set_protocol(kLinkProtocol);
  request.set_program(std::string("foresight ") + ProgramVersion());
  link::IdentifyReply reply;
  const auto context = Context(timeout);
  if (const grpc::Status called = stub(*context)->Identify(context.get(), request, &reply);
      !called.ok())
    return tl::unexpected(ToError(called, "its identity"));
  if (reply.protocol() != kLinkProtocol)
    return Fail(ErrorCode::kState,
                "{}: the head speaks version {} of the protocol ({}) and this program version {}: "
                "install the same Foresight on both",
                address_, reply.protocol(), reply.program(), kLinkProtocol);
  {
    const std::lock_guard lock(mutex_);
    if (reply.boot_id() != identity_.boot_id()) {
      clock_.Forget();
      control_changed_desk_s_ = 0.0;
    }
    clock_.Add(reply.desk_time_s(), Now());
    identity_ = reply;
  }
  if (!reply.may_operate() || !WantsControl()) return {};
  return TakeControl(timeout);
}

Status LinkSession::TakeControl(std::chrono::milliseconds timeout) {
  link::ControlReply reply;
  const auto context = Context(timeout);
  if (const grpc::Status called =
          stub(*context)->TakeControl(context.get(), link::ControlRequest(), &reply);
      !called.ok())
    return tl::unexpected(ToError(called, "taking control"));
  const std::lock_guard lock(mutex_);
  token_ = reply.granted() ? reply.token() : "";
  holder_ = reply.holder();
  // Control that was refused does not come by itself later, when nobody expects it.
  wants_control_ = reply.granted();
  if (clock_.Known()) control_changed_desk_s_ = clock_.At(Now());
  return {};
}

Status LinkSession::GiveControl(const std::string& successor, std::chrono::milliseconds timeout) {
  const std::string token = Token();
  link::ControlReply reply;
  const auto context = Context(timeout);
  grpc::Status called;
  if (successor.empty()) {
    link::ReleaseRequest request;
    request.set_token(token);
    called = stub(*context)->ReleaseControl(context.get(), request, &reply);
  } else {
    link::ControlRequest request;
    request.set_token(token);
    request.set_hand_over_to(successor);
    called = stub(*context)->TakeControl(context.get(), request, &reply);
  }
  if (!called.ok()) return tl::unexpected(ToError(called, "giving control away"));
  if (!successor.empty() && !reply.granted())
    return Fail(ErrorCode::kState, "{}: control was not handed over: {}", address_, reply.reason());
  const std::lock_guard lock(mutex_);
  wants_control_ = false;
  if (successor.empty()) token_.clear();
  holder_ = reply.holder();
  if (clock_.Known()) control_changed_desk_s_ = clock_.At(Now());
  return {};
}

bool LinkSession::WantsControl() const {
  const std::lock_guard lock(mutex_);
  return wants_control_;
}

/// A word from before the last change here says nothing of it.
void LinkSession::HeardControl(const std::string& holder, double desk_time_s) {
  const std::lock_guard lock(mutex_);
  if (desk_time_s < control_changed_desk_s_) return;
  holder_ = holder;
  if (holder != identity_.your_name()) token_.clear();
}

link::IdentifyReply LinkSession::HeadIdentity() const {
  const std::lock_guard lock(mutex_);
  return identity_;
}

std::string LinkSession::Token() const {
  const std::lock_guard lock(mutex_);
  return token_;
}

std::string LinkSession::Holder() const {
  const std::lock_guard lock(mutex_);
  return holder_;
}

void LinkSession::Heard(double desk_time_s) {
  const std::lock_guard lock(mutex_);
  clock_.Add(desk_time_s, Now());
}

double LinkSession::DeskTime() const {
  const std::lock_guard lock(mutex_);
  return clock_.Known() ? clock_.At(Now()) : 0.0;
}

}  // namespace foresight
