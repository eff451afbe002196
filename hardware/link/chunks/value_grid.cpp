#include "hardware/link/chunks/value_grid.h"

#include <algorithm>
#include <bit>

#include "hardware/link/chunks/grid_predictor.h"

namespace foresight {
namespace {

std::uint16_t Zigzag16(int difference) {
  const auto bits = static_cast<std::uint16_t>(difference);
  return static_cast<std::uint16_t>(bits << 1 ^ -(bits >> 15));
}

int Unzigzag16(std::uint32_t value) {
  return static_cast<int>(value >> 1 ^ (~(value & 1) + 1));
}

std::vector<std::uint16_t> Differences(const ValueSpans& rows, int smooth) {
  const GridPredictor predictor(smooth);
  std::size_t count = 0;
  for (const auto& row : rows) count += row.size();
  std::vector<std::uint16_t> differences(count);
  auto* next = differences.data();
  std::span<const std::uint16_t> above;
  for (const auto& row : rows) {
    for (std::size_t at = 0; at < row.size(); ++at)
      *next++ = Zigzag16(row[at] - predictor.Predict(above, row.data(), at));
    above = row;
  }
  return differences;
}

/// How many low bits of the differences are noise that no code makes shorter.
unsigned NoiseBits(const std::vector<std::uint16_t>& differences) {
  std::uint64_t sum = 0;
  // Edges do not count: what they need is in the high bytes.
  for (const std::uint16_t value : differences) sum += std::min<std::uint16_t>(value, 4095);
  const std::uint64_t mean = sum / std::max<std::size_t>(1, differences.size());
  return static_cast<unsigned>(std::max(0, static_cast<int>(std::bit_width(mean)) - 5));
}

/// The noise bits one behind the other, then the low and the high bytes of what is above them.
void AppendDifferences(ItemWriter& writer, const std::vector<std::uint16_t>& differences) {
  const unsigned noise_bits = NoiseBits(differences);
  const std::size_t count = differences.size();
  std::string noise, low(count, '\0'), high(count, '\0');
  noise.reserve((count * noise_bits + 7) / 8);
  std::uint32_t waiting = 0;
  unsigned waiting_bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t value = differences[i];
    waiting |= (value & ((1U << noise_bits) - 1)) << waiting_bits;
    waiting_bits += noise_bits;
    for (; waiting_bits >= 8; waiting_bits -= 8, waiting >>= 8)
      noise.push_back(static_cast<char>(waiting & 0xff));
    low[i] = static_cast<char>(value >> noise_bits & 0xff);
    high[i] = static_cast<char>(value >> noise_bits >> 8);
  }
  if (waiting_bits > 0) noise.push_back(static_cast<char>(waiting));
  writer.U8(static_cast<std::uint8_t>(noise_bits)).Raw(noise).Packed(low).Packed(high);
}

std::vector<std::uint16_t> ReadDifferences(ItemReader& reader, std::size_t count) {
  const unsigned noise_bits = reader.U8();
  if (noise_bits > 12) reader.SetFailed();
  const std::string_view noise = reader.Raw((count * noise_bits + 7) / 8);
  const std::string low = reader.Packed(count), high = reader.Packed(count);
  if (!reader.ok()) return {};
  std::vector<std::uint16_t> differences(count);
  std::uint32_t waiting = 0;
  unsigned waiting_bits = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (; waiting_bits < noise_bits; waiting_bits += 8)
      waiting |= std::uint32_t{static_cast<unsigned char>(noise[next++])} << waiting_bits;
    const std::uint32_t above = static_cast<unsigned char>(low[i]) |
                                std::uint32_t{static_cast<unsigned char>(high[i])} << 8;
    differences[i] =
        static_cast<std::uint16_t>(above << noise_bits | (waiting & ((1U << noise_bits) - 1)));
    waiting >>= noise_bits;
    waiting_bits -= noise_bits;
  }
  return differences;
}

}  // namespace

void AppendValueGrid(ItemWriter& writer, const ValueSpans& rows, int smooth) {
  AppendDifferences(writer, Differences(rows, smooth));
}

ValueRows ReadValueGrid(ItemReader& reader, const std::vector<std::size_t>& sizes, int smooth) {
  std::size_t count = 0;
  for (const std::size_t size : sizes) count += size;
  const std::vector<std::uint16_t> differences = ReadDifferences(reader, count);
  if (!reader.ok()) return {};
  const GridPredictor predictor(smooth);
  ValueRows rows;
  std::span<const std::uint16_t> above;
  const std::uint16_t* next = differences.data();
  for (const std::size_t size : sizes) {
    std::vector<std::uint16_t> row(size);
    for (std::size_t at = 0; at < size; ++at)
      row[at] = static_cast<std::uint16_t>(predictor.Predict(above, row.data(), at) +
                                           Unzigzag16(*next++));
    rows.push_back(std::move(row));
    above = rows.back();  // moving the outer vector does not move the values
  }
  return rows;
}

}  // namespace foresight
