#include "hardware/link/chunks/header_item.h"

#include "core/base/sha256.h"
#include "core/mission/plan_json.h"
#include "core/sensor/rig_id.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

constexpr std::uint8_t kHeaderForm = 1;

}  // namespace

std::string EncodeHeader(const Scan& scan) {
  return ItemWriter()
      .U8(kHeaderForm)
      .Text(scan.uuid)
      .U64(static_cast<std::uint64_t>(scan.start_utc_ns))
      .Text(scan.source)
      .U8(scan.simulated ? 1 : 0)
      .Text(PlanToJson(scan.plan))
      .Text(RigId(scan.rig))
      .Text(Sha256Hex(SensorRigToYaml(scan.rig)))
      .Take();
}

Result<ScanHeader> DecodeHeader(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kHeaderForm) return Fail(ErrorCode::kBadData, "header: form is not known");
  ScanHeader header;
  header.uuid = reader.Text();
  header.start_utc_ns = static_cast<std::int64_t>(reader.U64());
  header.source = reader.Text();
  header.simulated = reader.U8() != 0;
  const std::string plan(reader.Text());
  header.rig_id = reader.Text();
  header.rig_digest = reader.Text();
  FORESIGHT_CHECK(reader.Finish("header"));
  FORESIGHT_TRY(header.plan, PlanFromJson(plan, "header"));
  FORESIGHT_CHECK(CheckRigId(header.rig_id));
  return header;
}

}  // namespace foresight
