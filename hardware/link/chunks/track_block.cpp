#include "hardware/link/chunks/track_block.h"

#include <bit>
#include <cmath>

#include "core/base/contract.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

constexpr std::uint8_t kTrackForm = 1;

/// Second differences of the bits, byte plane by byte plane: of values that grow evenly most planes
/// are the same byte again and again.
std::string PlanesOf(const std::vector<double>& values) {
  const std::size_t count = values.size();
  std::string planes(8 * count, '\0');
  std::uint64_t before = 0, step = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(values[i]);
    const std::uint64_t next_step = bits - before;
    const std::uint64_t code = Zigzag(static_cast<std::int64_t>(next_step - step));
    for (std::size_t byte = 0; byte < 8; ++byte)
      planes[byte * count + i] = static_cast<char>(code >> (8 * byte) & 0xff);
    step = next_step;
    before = bits;
  }
  return planes;
}

std::vector<double> ValuesOf(std::string_view planes) {
  const std::size_t count = planes.size() / 8;
  std::vector<double> values(count);
  std::uint64_t bits = 0, step = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t code = 0;
    for (std::size_t byte = 0; byte < 8; ++byte)
      code |= std::uint64_t{static_cast<unsigned char>(planes[byte * count + i])} << (8 * byte);
    step += static_cast<std::uint64_t>(Unzigzag(code));
    bits += step;
    values[i] = std::bit_cast<double>(bits);
  }
  return values;
}

}  // namespace

std::string EncodeTrackBlock(std::span<const MotorSample> samples) {
  FORESIGHT_EXPECTS(samples.size() <= kSamplesPerBlock, "a block has no more samples");
  std::vector<double> times_s, angles_rad;
  for (const MotorSample& sample : samples) {
    times_s.push_back(sample.time_s);
    angles_rad.push_back(sample.angle_rad);
  }
  return ItemWriter()
      .U8(kTrackForm)
      .U8(static_cast<std::uint8_t>(samples.size()))
      .Packed(PlanesOf(times_s))
      .Packed(PlanesOf(angles_rad))
      .Take();
}

Result<std::vector<MotorSample>> DecodeTrackBlock(std::string_view bytes) {
  ItemReader reader(bytes);
  if (reader.U8() != kTrackForm) return Fail(ErrorCode::kBadData, "track: form is not known");
  const std::size_t count = reader.U8();
  if (count > kSamplesPerBlock)
    return Fail(ErrorCode::kBadData, "track: {} samples are more than {}", count, kSamplesPerBlock);
  const std::string times = reader.Packed(8 * count), angles = reader.Packed(8 * count);
  FORESIGHT_CHECK(reader.Finish("track"));
  const std::vector<double> times_s = ValuesOf(times), angles_rad = ValuesOf(angles);
  std::vector<MotorSample> samples;
  for (std::size_t i = 0; i < count; ++i) samples.push_back({times_s[i], angles_rad[i]});
  // Checks that all are finite, and that time increases.
  FORESIGHT_CHECK(MotorTrack::FromSamples(samples));
  return samples;
}

}  // namespace foresight
