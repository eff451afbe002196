#include "core/io/yaml_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace foresight {
namespace {

std::string YamlErrorOf(const std::string& yaml) {
  const Status status = ParseYaml(yaml, "test.yaml", [](YamlMap& map) { map.Number("a"); });
  return status ? "none" : status.error().message;
}

TEST(YamlReader, TextThatIsNoUtf8IsRefusedWithItsLine) {
  EXPECT_EQ(YamlErrorOf("b: 1\na: \"caf\xe9\"\n"), "test.yaml:2: byte 0xe9 is no UTF-8");
}

TEST(YamlReader, ListsInListsEndSomewhere) {
  EXPECT_THAT(YamlErrorOf("a: " + std::string(100'000, '[')), testing::StartsWith("test.yaml:"));
}

TEST(YamlReader, AliasesOfAliasesTakeNoMemory) {
  std::string yaml = "x0: &x0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 30; ++i)
    yaml +=
        fmt::format("x{0}: &x{0} [*x{1}, *x{1}, *x{1}, *x{1}, *x{1}, *x{1}, *x{1}]\n", i, i - 1);
  EXPECT_THAT(YamlErrorOf(yaml + "a: *x29\n"), testing::HasSubstr("'a' is not a finite number"));
}

}  // namespace
}  // namespace foresight
