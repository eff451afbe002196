#include "hardware/link/chunks/end_item.h"

#include "hardware/link/chunks/chunk.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

constexpr std::uint8_t kEndForm = 1;
constexpr std::uint64_t kMostLines = std::uint64_t{kMaxItems} * kLinesPerBlock;
constexpr std::uint64_t kMostSamples = std::uint64_t{kMaxItems} * kSamplesPerBlock;

}  // namespace

std::string EncodeEnd(const ScanEnd& end) {
  return ItemWriter()
      .U8(kEndForm)
      .Text(ToString(end.state))
      .Text(end.reason)
      .Varint(static_cast<std::uint64_t>(end.lines))
      .Varint(static_cast<std::uint64_t>(end.samples))
      .Varint(static_cast<std::uint64_t>(end.frames))
      .U8(end.has_health ? 1 : 0)
      .Text(end.digest)
      .Take();
}

Result<ScanEnd> DecodeEnd(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kEndForm) return Fail(ErrorCode::kBadData, "end: form is not known");
  ScanEnd end;
  const std::string state(reader.Text());
  end.reason = reader.Text();
  end.lines = static_cast<std::int64_t>(reader.Count(kMostLines));
  end.samples = static_cast<std::int64_t>(reader.Count(kMostSamples));
  end.frames = static_cast<std::int64_t>(reader.Count(kMaxItems));
  end.has_health = reader.U8() != 0;
  end.digest = reader.Text();
  FORESIGHT_CHECK(reader.Finish("end"));
  FORESIGHT_TRY(end.state, ScanStateFromString(state));
  if (end.state == ScanState::kRunning)
    return Fail(ErrorCode::kBadData, "end: the scan is said to run");
  return end;
}

}  // namespace foresight
