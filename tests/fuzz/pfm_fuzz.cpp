// Portable float maps.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "core/io/pfm.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  const int file = memfd_create("fuzz.pfm", 0);
  Require(file >= 0 && write(file, bytes, size) == static_cast<ssize_t>(size), "a file in memory");
  const auto image = ReadPfm("/proc/self/fd/" + std::to_string(file));
  close(file);
  if (image)
    Require(4 * image->size() <= size, "every pixel comes from the file");
  else
    Require(image.error().code == ErrorCode::kBadData, "damaged bytes are bad data");
  return 0;
}
