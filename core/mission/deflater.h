#pragma once

#include <zlib.h>

#include <optional>
#include <string>

namespace foresight {

/// zlib's state for packing, a quarter of a megabyte: to make it anew takes longer than to pack a
/// line, so a thread keeps one.
class Deflater {
 public:
  explicit Deflater(int level) : good_(deflateInit(&stream_, level) == Z_OK) {}
  ~Deflater() {
    if (good_) deflateEnd(&stream_);
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// What compress2 would give of the bytes, which stay as they are; nothing where zlib fails.
  std::optional<std::string> Pack(std::string& bytes) {
    if (!good_ || deflateReset(&stream_) != Z_OK) return std::nullopt;
    std::string packed(deflateBound(&stream_, bytes.size()), '\0');
    stream_.next_in = reinterpret_cast<Bytef*>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    stream_.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream_.avail_out = static_cast<uInt>(packed.size());
    if (deflate(&stream_, Z_FINISH) != Z_STREAM_END) return std::nullopt;
    packed.resize(stream_.total_out);
    return packed;
  }

 private:
  z_stream stream_{};
  bool good_ = false;
};

}  // namespace foresight
