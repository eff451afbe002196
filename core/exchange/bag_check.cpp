#include "core/exchange/bag_check.h"

#include <rosbag/chunked_file.h>
#include <rosbag/constants.h>
#include <rosbag/stream.h>

#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace foresight {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Fields = std::map<std::string, std::string>;

constexpr std::uint64_t kMostHeader_bytes = 1 << 20;
constexpr std::uint64_t kMostChunk_bytes = std::uint64_t{1} << 30;

[[noreturn]] void Refuse(std::uint64_t at, const std::string& what) {
  throw std::runtime_error("is damaged at byte " + std::to_string(at) + ": " + what);
}

template <class Integer>
Integer IntegerAt(const std::uint8_t* bytes) {
  Integer value;
  std::memcpy(&value, bytes, sizeof value);  // little-endian, as the file is
  return value;
}

/// "name=value", each behind its length.
Fields FieldsOf(const std::uint8_t* bytes, std::uint64_t size, std::uint64_t at) {
  Fields fields;
  std::uint64_t begin = 0;
  while (begin < size) {
    if (size - begin < 4) Refuse(at, "a header ends within a field");
    const std::uint64_t length = IntegerAt<std::uint32_t>(bytes + begin);
    begin += 4;
    if (length > size - begin) Refuse(at, "a field is longer than its header");
    const std::string field(reinterpret_cast<const char*>(bytes + begin), length);
    const std::size_t equals = field.find(static_cast<char>(rosbag::FIELD_DELIM));
    if (equals == std::string::npos) Refuse(at, "a field has no name");
    fields[field.substr(0, equals)] = field.substr(equals + 1);
    begin += length;
  }
  return fields;
}

template <class Integer>
Integer Number(const Fields& fields, const std::string& name, std::uint64_t at) {
  const auto field = fields.find(name);
  if (field == fields.end() || field->second.size() != sizeof(Integer))
    Refuse(at, "a record has no field '" + name + "'");
  return IntegerAt<Integer>(reinterpret_cast<const std::uint8_t*>(field->second.data()));
}

unsigned OperationOf(const Fields& fields, std::uint64_t at) {
  return Number<std::uint8_t>(fields, rosbag::OP_FIELD_NAME, at);
}

/// Where the records of a chunk begin.
using Offsets = std::set<std::uint64_t>;

Offsets RecordsOf(const Bytes& chunk, std::uint64_t at) {
  Offsets offsets;
  std::uint64_t begin = 0;
  const auto part = [&]() -> std::pair<const std::uint8_t*, std::uint64_t> {
    if (chunk.size() - begin < 4) Refuse(at, "a chunk ends within a record");
    const std::uint64_t length = IntegerAt<std::uint32_t>(chunk.data() + begin);
    begin += 4;
    if (length > chunk.size() - begin) Refuse(at, "a record is longer than its chunk");
    const std::uint8_t* bytes = chunk.data() + begin;
    begin += length;
    return {bytes, length};
  };
  while (begin < chunk.size()) {
    offsets.insert(begin);
    const auto header = part();
    const unsigned operation = OperationOf(FieldsOf(header.first, header.second, at), at);
    if (operation != rosbag::OP_MSG_DATA && operation != rosbag::OP_CONNECTION)
      Refuse(at, "a chunk holds a record that is neither a message nor a connection");
    part();
  }
  return offsets;
}

class BagCheck {
 public:
  explicit BagCheck(const std::string& path) : file_(path, std::ios::binary) {
    if (!file_) throw std::runtime_error("cannot be read");
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(file_.tellg());
    file_.seekg(0);
  }

  void Run() {
    ReadVersion();
    bool first = true;
    while (at_ < size_) {
      ReadRecord(first);
      first = false;
    }
    if (first) Refuse(at_, "it ends within its header");
    if (!records_.count(index_at_) && index_at_ != size_)
      Refuse(index_at_, "no record begins where its index should");
    for (const std::uint64_t chunk : named_chunks_)
      if (!chunks_.count(chunk)) Refuse(chunk, "no chunk begins where its index says");
  }

 private:
  void ReadVersion() {
    const std::string magic = "#ROSBAG V";
    std::string line(13, '\0');
    file_.read(&line[0], static_cast<std::streamsize>(line.size()));
    if (line.compare(0, magic.size(), magic) != 0)
      throw std::runtime_error("is no ROS bag of format 2.0");
    if (line != magic + rosbag::VERSION + "\n")
      throw std::runtime_error("is not of version 2.0: convert it with 'rosbag migrate'");
    at_ = line.size();
  }

  /// @returns the length that stands here; what it tells of lies within the file.
  std::uint64_t ReadLength(const char* what) {
    std::uint8_t bytes[4];
    if (size_ - at_ < 4 || !file_.read(reinterpret_cast<char*>(bytes), 4))
      Refuse(at_, std::string("it ends within the length of ") + what);
    at_ += 4;
    const std::uint64_t length = IntegerAt<std::uint32_t>(bytes);
    if (length > size_ - at_)
      Refuse(at_ - 4, std::string(what) + " of " + std::to_string(length) + " bytes, and only " +
                          std::to_string(size_ - at_) + " are left");
    return length;
  }

  Bytes ReadBytes(std::uint64_t length) {
    Bytes bytes(length);
    if (length > 0 &&
        !file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(length)))
      Refuse(at_, "it cannot be read");
    at_ += length;
    return bytes;
  }

  void ReadRecord(bool first) {
    const std::uint64_t begin = at_;
    records_.insert(begin);
    const std::uint64_t length = ReadLength("a header");
    if (length > kMostHeader_bytes) Refuse(begin, "a header of more than 1 MB");
    const Bytes header = ReadBytes(length);
    const Fields fields = FieldsOf(header.data(), header.size(), begin);
    const unsigned operation = OperationOf(fields, begin);
    if (first != (operation == rosbag::OP_FILE_HEADER))
      Refuse(begin, "the bag's header stands at its beginning, and there only");
    const std::uint64_t data = ReadLength("data");
    switch (operation) {
      case rosbag::OP_FILE_HEADER:
        index_at_ = Number<std::uint64_t>(fields, rosbag::INDEX_POS_FIELD_NAME, begin);
        if (index_at_ == 0)
          throw std::runtime_error(
              "has no index, for its recording was cut off: mend it with 'rosbag reindex'");
        if (index_at_ > size_) Refuse(begin, "its index lies behind its end");
        break;
      case rosbag::OP_CHUNK:
        ReadChunk(fields, begin, data);
        return;
      case rosbag::OP_INDEX_DATA:
        CheckIndex(fields, begin, ReadBytes(data));
        return;
      case rosbag::OP_CHUNK_INFO:
        named_chunks_.insert(Number<std::uint64_t>(fields, rosbag::CHUNK_POS_FIELD_NAME, begin));
        break;
      case rosbag::OP_CONNECTION: {
        const Bytes connection = ReadBytes(data);
        FieldsOf(connection.data(), connection.size(), begin);
        return;
      }
      default:
        Refuse(begin, "a record of kind " + std::to_string(operation) + " is not known");
    }
    at_ += data;
    file_.seekg(static_cast<std::streamoff>(at_));
  }

  void ReadChunk(const Fields& fields, std::uint64_t begin, std::uint64_t length) {
    const std::uint64_t size = Number<std::uint32_t>(fields, rosbag::SIZE_FIELD_NAME, begin);
    if (size > kMostChunk_bytes || length > kMostChunk_bytes)
      Refuse(begin, "a chunk of more than 1 GB");
    const auto compression = fields.find(rosbag::COMPRESSION_FIELD_NAME);
    const std::string method = compression == fields.end() ? "" : compression->second;
    Bytes packed = ReadBytes(length);
    chunks_.insert(begin);
    if (method == rosbag::COMPRESSION_NONE) {
      if (size != length) Refuse(begin, "a chunk's size is not that of its data");
      offsets_ = RecordsOf(packed, begin);
      return;
    }
    rosbag::ChunkedFile none;
    const std::unique_ptr<rosbag::Stream> stream = StreamOf(method, none, begin);
    Bytes chunk(size);
    if (size > 0 && length > 0)
      stream->decompress(chunk.data(), static_cast<unsigned>(size), packed.data(),
                         static_cast<unsigned>(length));
    offsets_ = RecordsOf(chunk, begin);
  }

  static std::unique_ptr<rosbag::Stream> StreamOf(const std::string& method,
                                                  rosbag::ChunkedFile& file, std::uint64_t at) {
    if (method == rosbag::COMPRESSION_BZ2) return std::make_unique<rosbag::BZ2Stream>(&file);
    if (method == rosbag::COMPRESSION_LZ4) return std::make_unique<rosbag::LZ4Stream>(&file);
    Refuse(at, "a chunk's compression is not known");
  }

  /// An index names records of the chunk before it: a time and an offset each.
  void CheckIndex(const Fields& fields, std::uint64_t begin, const Bytes& data) const {
    constexpr std::size_t kEntry_bytes = 12;
    const std::uint64_t count = Number<std::uint32_t>(fields, rosbag::COUNT_FIELD_NAME, begin);
    if (count * kEntry_bytes != data.size()) Refuse(begin, "an index of another length");
    for (std::size_t i = 0; i < count; ++i)
      if (!offsets_.count(IntegerAt<std::uint32_t>(data.data() + i * kEntry_bytes + 8)))
        Refuse(begin, "an index names a message where none begins");
  }

  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t at_ = 0;
  std::uint64_t index_at_ = 0;
  Offsets records_, chunks_, named_chunks_;
  Offsets offsets_;  ///< of the last chunk
};

}  // namespace

std::string CheckBag(const std::string& path) {
  try {
    BagCheck(path).Run();
    return {};
  } catch (const std::exception& failure) {
    return failure.what();
  }
}

}  // namespace foresight
