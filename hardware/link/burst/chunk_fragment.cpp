#include "hardware/link/burst/chunk_fragment.h"

#include <algorithm>

#include "core/base/contract.h"
#include "core/base/sha256.h"
#include "hardware/link/chunks/item_bytes.h"

namespace foresight {
namespace {

std::uint32_t PiecesOf(std::uint32_t bytes, std::uint32_t stride) {
  return std::max<std::uint32_t>(1, (bytes + stride - 1) / stride);
}

}  // namespace

std::uint32_t ChunkFragment::Count() const {
  return PiecesOf(chunk_bytes, stride);
}

std::uint64_t BurstScanTag(const std::string& scan_id) {
  return std::stoull(Sha256Hex(scan_id).substr(0, 16), nullptr, 16);
}

std::uint32_t FragmentCount(const Chunk& chunk, std::uint32_t stride) {
  return PiecesOf(static_cast<std::uint32_t>(chunk.bytes.size()), stride);
}

void WriteFragment(std::uint64_t scan_tag, const Chunk& chunk, std::uint32_t stride,
                   std::uint32_t index, std::vector<std::uint8_t>& content) {
  FORESIGHT_EXPECTS(stride >= kLeastStride && index < FragmentCount(chunk, stride),
                    "a fragment is one of the chunk's");
  const std::string head = ItemWriter()
                               .U64(scan_tag)
                               .U8(static_cast<std::uint8_t>(chunk.id.kind))
                               .U32(static_cast<std::uint32_t>(chunk.id.item))
                               .U8(static_cast<std::uint8_t>(chunk.id.part & 0xff))
                               .U8(static_cast<std::uint8_t>(chunk.id.part >> 8))
                               .U8(static_cast<std::uint8_t>(chunk.parts & 0xff))
                               .U8(static_cast<std::uint8_t>(chunk.parts >> 8))
                               .U32(chunk.item_crc)
                               .U32(chunk.crc)
                               .U32(static_cast<std::uint32_t>(chunk.bytes.size()) | stride << 16)
                               .U32(index)
                               .Take();
  const std::string_view bytes =
      std::string_view(chunk.bytes).substr(std::size_t{index} * stride, stride);
  content.assign(head.begin(), head.end());
  content.insert(content.end(), bytes.begin(), bytes.end());
}

Result<ChunkFragment> ReadFragment(std::span<const std::uint8_t> content) {
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  ItemReader reader(text);
  ChunkFragment fragment;
  fragment.scan_tag = reader.U64();
  const int kind = reader.U8();
  fragment.id.item = reader.U32();
  const auto u16 = [&reader] {
    const std::int32_t low = reader.U8();
    return low | reader.U8() << 8;
  };
  fragment.id.part = u16();
  fragment.parts = u16();
  fragment.item_crc = reader.U32();
  fragment.crc = reader.U32();
  const std::uint32_t sizes = reader.U32();
  fragment.chunk_bytes = sizes & 0xffff;
  fragment.stride = sizes >> 16;
  fragment.index = reader.U32();
  if (!reader.ok() || !IsChunkKind(kind) || fragment.id.item >= kMaxItems || fragment.parts < 1 ||
      fragment.parts > kMaxParts || fragment.id.part >= fragment.parts ||
      fragment.chunk_bytes > kMaxPartBytes || fragment.stride < kLeastStride ||
      fragment.index >= fragment.Count())
    return Fail(ErrorCode::kBadData, "burst path: a fragment has a number out of its bounds");
  fragment.id.kind = static_cast<ChunkKind>(kind);
  fragment.bytes = content.subspan(content.size() - reader.left());
  const std::uint32_t begin = fragment.index * fragment.stride;
  if (fragment.bytes.size() != std::min(fragment.stride, fragment.chunk_bytes - begin))
    return Fail(ErrorCode::kBadData, "burst path: a fragment has {} bytes and not its share",
                fragment.bytes.size());
  return fragment;
}

}  // namespace foresight
