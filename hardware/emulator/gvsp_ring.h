#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/image.h"
#include "hardware/emulator/gvsp_codec.h"

namespace foresight {

/// An image's pixels as a camera of that format sends them: one channel of each pixel for
/// BayerRG8 (red at (0, 0)), the luma for Mono8.
std::vector<std::uint8_t> EncodePixels(const ColorImage& image, gvsp::PixelFormat format);

/// An image as the packets it leaves in.
struct GvspFrame {
  std::uint16_t block = 1;
  gvsp::Leader leader;
  std::vector<std::uint8_t> pixels;
  std::size_t payload_bytes = 1;  ///< of a packet

  /// Leader, payload and trailer.
  std::uint32_t PacketCount() const;
  /// Any of them, as often as it is wanted.
  std::vector<std::uint8_t> Packet(std::uint32_t number) const;
};

/// The camera's memory of the last images, for packets that got lost. Safe from any thread.
class GvspRing {
 public:
  static constexpr std::size_t kKept = 4;

  void Add(std::shared_ptr<const GvspFrame> frame);
  /// nullptr when it is not there, or not any more.
  std::shared_ptr<const GvspFrame> Find(std::uint16_t block) const;
  void Clear();

 private:
  mutable std::mutex mutex_;
  std::array<std::shared_ptr<const GvspFrame>, kKept> frames_;
  std::size_t next_ = 0;
};

}  // namespace foresight
