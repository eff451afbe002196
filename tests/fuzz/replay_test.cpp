// Every fuzz target in the ordinary build: the files of its corpus, and a few hundred small changes
// of each, as the seed makes them. clang's fuzzers go on from there (packaging/test-nightly).
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/random.h"

// The targets' LLVMFuzzerTestOneInput under names of their own (CMakeLists.txt).
#define FORESIGHT_FUZZ_TARGET(name, corpus) \
  extern "C" int FuzzOneInput_##name(const std::uint8_t*, std::size_t);
#include "fuzz_targets.inc"
#undef FORESIGHT_FUZZ_TARGET

namespace foresight {
namespace {

struct Target {
  const char* name;
  int (*try_input)(const std::uint8_t*, std::size_t);
  const char* corpus;  ///< a folder; "" = none
};

const Target kTargets[] = {
#define FORESIGHT_FUZZ_TARGET(name, corpus) {#name, FuzzOneInput_##name, corpus},
#include "fuzz_targets.inc"
#undef FORESIGHT_FUZZ_TARGET
};

void Try(const Target& target, const std::string& bytes) {
  target.try_input(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string Changed(std::string bytes, Random& random) {
  for (int i = 1 + random.Index(4); i > 0; --i) {
    const auto at = [&] {
      return static_cast<std::size_t>(random.Uniform() * static_cast<double>(bytes.size()));
    };
    switch (bytes.empty() ? 3 : random.Index(4)) {
      case 0:
        bytes[at()] = static_cast<char>(random.Index(256));
        break;
      case 1:
        bytes.resize(at());
        break;
      case 2:
        bytes.erase(at(), 1 + static_cast<std::size_t>(random.Index(8)));
        break;
      default:
        bytes.insert(at(), 1, static_cast<char>(random.Index(256)));
    }
  }
  return bytes;
}

std::vector<std::string> CorpusOf(const Target& target) {
  std::vector<std::string> files = {std::string(), std::string(64, '\0'), std::string(64, '\xff')};
  if (*target.corpus == '\0') return files;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(target.corpus))
    if (entry.is_regular_file()) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());  // a folder has no order
  for (const auto& path : paths) {
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    files.push_back(bytes.str());
  }
  return files;
}

class FuzzReplay : public testing::TestWithParam<Target> {};

TEST_P(FuzzReplay, KeepsItsPromisesOnTheCorpusAndOnSmallChangesOfIt) {
  constexpr int kChanges = 100;
  constexpr std::size_t kLargest = 4096;  // of changed inputs, as for the fuzzers
  Random random(1);
  const std::vector<std::string> corpus = CorpusOf(GetParam());
  EXPECT_TRUE(*GetParam().corpus == '\0' || corpus.size() > 3) << "the corpus is empty";
  for (const std::string& file : corpus) {
    Try(GetParam(), file);
    for (int i = 0; i < kChanges && file.size() <= kLargest; ++i)
      Try(GetParam(), Changed(file, random));
  }
}

INSTANTIATE_TEST_SUITE_P(All, FuzzReplay, testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace foresight
