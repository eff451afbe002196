// What stations ask of a head, behind the certificate: the first byte says which call, the rest is
// its message. A command is made to be in time and of who has control, or the desk would refuse it
// before it looks at what is in it.
#include <cmath>
#include <cstdint>
#include <string>

#include "hardware/link/server/fit_desk.h"
#include "hardware/link/server/head_desk.h"
#include "hardware/link/server/image_desk.h"
#include "tests/fuzz/require.h"
#include "tests/hardware/link/fake_head.h"
#include "tests/support/temporary_folder.h"

namespace foresight {
namespace {

/// One for all inputs.
struct Desk {
  Desk() {
    FakeHead giver;
    Require(giver.Home().has_value(), "a fake head can be homed");
    Scan scan = SampleScan(1);
    Require(giver.StartScan({}, shelf->Begin("a-scan", {}).value()).has_value(), "and scans");
    giver.Play(scan);
    token = desk.TakeControl({}, anna).token();
  }

  const TemporaryFolder folder;
  const HeadDesk::Peer anna{"anna", true};
  const HeadDesk::Peer eve{"eve", false};
  const std::shared_ptr<FakeHead> head = std::make_shared<FakeHead>();
  const std::unique_ptr<ScanShelf> shelf = ScanShelf::Open({folder / "scans", 0.9}).value();
  HeadDesk desk{head, *shelf, {1e9, true, nullptr, 0.0}};
  FitDesk fits{*shelf};
  std::string token;
  int commands = 0;
};

Desk& TheDesk() {
  static Desk desk;
  return desk;
}

void TryCommand(link::Command command) {
  Desk& desk = TheDesk();
  const link::Outcome as_observer = desk.desk.Execute(command, desk.eve);
  Require(as_observer.error() != link::NONE, "an observer commands nothing");
  const int homings = desk.head->homings;
  const int scans = desk.head->scans;
  command.set_command_id("fuzz-" + std::to_string(++desk.commands));
  command.set_control_token(desk.token);
  command.set_boot_id(desk.desk.boot_id());
  command.set_void_after_s(1e9);
  const link::Outcome first = desk.desk.Execute(command, desk.anna);
  const link::Outcome again = desk.desk.Execute(command, desk.anna);
  Require(again.repeated() && again.error() == first.error(), "a repeat gets the first outcome");
  Require(desk.head->homings <= homings + 1 && desk.head->scans <= scans + 1,
          "a command is carried out once at most");
  if (desk.head->scans == scans) return;
  desk.shelf->Withdraw(command.start_scan().scan_id());  // or scans would fill the disk
  desk.head->Forget();
}

void TryFit(link::FitRequest request) {
  Desk& desk = TheDesk();
  request.set_scan_id("no-such-scan");  // what is asked is read before; a fit takes seconds
  const auto gone = [] { return true; };
  Require(!desk.fits.Fit(request, "anna", gone), "a fit needs a scan");
}

void TryImage(link::ImageRequest request) {
  if (request.position() % 2 == 0) request.set_scan_id("a-scan");
  const auto image = MakeImage(*TheDesk().shelf, request);
  if (image) Require(!image->image().empty(), "an image has bytes");
}

void TryControl(const link::ControlRequest& request) {
  Desk& desk = TheDesk();
  Require(!desk.desk.TakeControl(request, desk.eve).granted(), "an observer has no control");
  Require(desk.desk.HasControl(desk.token), "nobody takes control away by guessing");
}

template <class Message>
void With(const std::uint8_t* bytes, std::size_t size, void (*attempt)(Message)) {
  Message message;
  if (message.ParseFromArray(bytes, static_cast<int>(size))) attempt(std::move(message));
}

}  // namespace
}  // namespace foresight

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  if (size == 0) return 0;
  switch (bytes[0] % 4) {
    case 0:
      With<link::Command>(bytes + 1, size - 1, TryCommand);
      break;
    case 1:
      With<link::FitRequest>(bytes + 1, size - 1, TryFit);
      break;
    case 2:
      With<link::ImageRequest>(bytes + 1, size - 1, TryImage);
      break;
    default:
      With<link::ControlRequest>(bytes + 1, size - 1,
                                 [](link::ControlRequest request) { TryControl(request); });
  }
  return 0;
}
