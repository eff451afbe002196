#include "hardware/link/chunks/text_item.h"

#include "hardware/link/chunks/item_bytes.h"

namespace foresight {

Result<std::string> EncodeText(std::string_view text) {
  if (text.size() > kMostTextBytes)
    return Fail(ErrorCode::kInvalidInput, "a text of {} bytes is longer than {}", text.size(),
                kMostTextBytes);
  return ItemWriter().Varint(text.size()).Packed(text).Take();
}

Result<std::string> DecodeText(std::string_view bytes, const char* what) {
  ItemReader reader(bytes);
  const std::size_t size = reader.Count(kMostTextBytes);
  std::string text;
  if (reader.ok()) text = reader.Packed(size);
  FORESIGHT_CHECK(reader.Finish(what));
  return text;
}

}  // namespace foresight
