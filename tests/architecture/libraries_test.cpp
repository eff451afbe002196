// What the shared libraries need: the drivers work without what plays devices, core without scenes
// and populations. docs/architecture.md.
#include <elf.h>
#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace foresight {
namespace {

/// A table of an ELF file's section; empty where there is none of that type.
template <class Entry>
std::vector<Entry> Table(const std::string& bytes, const Elf64_Shdr& section) {
  std::vector<Entry> entries(section.sh_size / sizeof(Entry));
  std::memcpy(entries.data(), bytes.data() + section.sh_offset, entries.size() * sizeof(Entry));
  return entries;
}

/// Our libraries that a shared library names as needed: "foresight_core", ...
std::set<std::string> OursNeededBy(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  const std::string bytes = text.str();
  Elf64_Ehdr header{};
  std::memcpy(&header, bytes.data(), sizeof(header));
  std::vector<Elf64_Shdr> sections(header.e_shnum);
  std::memcpy(sections.data(), bytes.data() + header.e_shoff, sections.size() * sizeof(Elf64_Shdr));
  std::set<std::string> needed;
  for (const Elf64_Shdr& section : sections) {
    if (section.sh_type != SHT_DYNAMIC) continue;
    const char* names = bytes.data() + sections[section.sh_link].sh_offset;
    for (const auto& entry : Table<Elf64_Dyn>(bytes, section)) {
      if (entry.d_tag != DT_NEEDED) continue;
      const std::string name = names + entry.d_un.d_val;
      if (name.rfind("libforesight_", 0) == 0) needed.insert(name.substr(3, name.find(".so") - 3));
    }
  }
  return needed;
}

TEST(Libraries, CoreNeedsNoneOfOurOthers) {
  EXPECT_EQ(OursNeededBy(FORESIGHT_CORE_FILE), std::set<std::string>());
}

TEST(Libraries, TheDriversNeedOnlyCore) {
  EXPECT_EQ(OursNeededBy(FORESIGHT_HARDWARE_FILE), std::set<std::string>({"foresight_core"}));
}

TEST(Libraries, TheLinkNeedsTheHeadsInterfaceAndNoEmulators) {
  EXPECT_EQ(OursNeededBy(FORESIGHT_LINK_FILE),
            std::set<std::string>({"foresight_core", "foresight_hardware"}));
}

TEST(Libraries, ExportsNeedOnlyCore) {
  EXPECT_EQ(OursNeededBy(FORESIGHT_EXCHANGE_FILE), std::set<std::string>({"foresight_core"}));
}

TEST(Libraries, MapsNeedNothingBesideCore) {
  std::set<std::string> needed = OursNeededBy(FORESIGHT_MAPPING_FILE);
  needed.erase("foresight_core");  // of which it may use headers only
  EXPECT_EQ(needed, std::set<std::string>());
}

TEST(Libraries, TheHeadLoadsNeitherExportsNorMaps) {
  const std::set<std::string> needed = OursNeededBy(FORESIGHT_HEAD_FILE);
  EXPECT_FALSE(needed.contains("foresight_exchange"));
  EXPECT_FALSE(needed.contains("foresight_mapping"));
}

TEST(Libraries, WhatPlaysDevicesNeedsTheSimulationAndNotThePopulations) {
  const std::set<std::string> needed = OursNeededBy(FORESIGHT_EMULATOR_FILE);
  EXPECT_TRUE(needed.contains("foresight_simulation"));
  EXPECT_FALSE(needed.contains("foresight_evaluation"));
}

}  // namespace
}  // namespace foresight
