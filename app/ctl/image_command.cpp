#include <filesystem>
#include <limits>
#include <memory>

#include "app/common/connect_head.h"
#include "app/ctl/command.h"
#include "app/ctl/head_scan.h"
#include "core/base/atomic_file.h"
#include "core/geometry/angles.h"
#include "hardware/link/client/remote_head.h"

namespace foresight {
namespace {

struct ImageArguments {
  LinkArguments link;
  std::string scan;  ///< its id, or how that begins
  int number = 0;
  int quality = 80;
  int largest_side = 0;
  std::vector<int> part;  ///< left, top, width, height
  std::string out;
  bool json = false;
};

HeadImageOrder OrderFrom(const ImageArguments& arguments, const std::string& scan_id) {
  const bool lossless = std::filesystem::path(arguments.out).extension() == ".png";
  HeadImageOrder order;
  order.scan_id = scan_id;
  order.position = arguments.number;
  order.jpeg_quality = lossless ? 0 : arguments.quality;
  order.largest_side_px = arguments.largest_side;
  if (const auto& part = arguments.part; !part.empty())
    order.part = HeadImageOrder::Part{part[0], part[1], part[2], part[3]};
  return order;
}

Result<ExitCode> Run(const ImageArguments& arguments, const RunContext& /*context*/) {
  FORESIGHT_TRY(const auto head, LookAtHead(arguments.link));
  FORESIGHT_TRY(const std::string scan,
                ChooseScanOfHead(*head, arguments.link.head, arguments.scan));
  FORESIGHT_TRY(const HeadImage image, head->FetchImage(OrderFrom(arguments, scan)));
  FORESIGHT_CHECK(WriteFileAtomically(arguments.out, image.bytes));
  const double angle_deg = DegreesFromRadians(image.motor_angle_rad);
  if (arguments.json)
    PrintJson({{"file", arguments.out},
               {"scan", scan},
               {"number", arguments.number},
               {"images", image.images},
               {"angle_deg", angle_deg},
               {"full_width", image.full_width},
               {"full_height", image.full_height},
               {"bytes", image.bytes.size()}});
  else
    PrintLine(fmt::format("{}: image {} of {} of scan {}, taken at {:.2f} deg, {} bytes",
                          arguments.out, arguments.number, image.images, scan, angle_deg,
                          image.bytes.size()));
  return ExitCode::kDone;
}

}  // namespace

void AddImageCommand(CLI::App& app, Invocation& invocation) {
  auto* command = app.add_subcommand("image", "Bring one image of a scan that a head keeps");
  const auto arguments = std::make_shared<ImageArguments>();
  AddLinkOptions(*command, arguments->link)->required();
  command->add_option("--head-scan", arguments->scan,
                      "The scan, by its id or how that begins; default: the newest");
  command->add_option("--number", arguments->number, "Which image of the scan, from 0")
      ->check(CLI::Range(0, std::numeric_limits<int>::max(), "0 or more"))
      ->capture_default_str();
  command->add_option("--quality", arguments->quality, "Of a JPEG")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--largest-side", arguments->largest_side,
                   "Shrink to this many pixels at most; default: as it is")
      ->check(CLI::Range(1, 20'000));
  command
      ->add_option("--part", arguments->part, "Of the full image: left,top,width,height in pixels")
      ->expected(4)
      ->delimiter(',');
  command
      ->add_option("-o,--out", arguments->out,
                   "File: .png is lossless, anything else a JPEG of --quality")
      ->required();
  command->add_flag("--json", arguments->json, "Print what came as JSON");
  command->callback([arguments, &invocation] {
    invocation = [arguments](const RunContext& context) { return Run(*arguments, context); };
  });
}

}  // namespace foresight
