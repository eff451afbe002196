// Points in any order: each gets a place of its own, or none.
#include <cstdint>
#include <cstring>
#include <set>
#include <utility>
#include <vector>

#include "core/registration/recover_grid.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace foresight;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t at = 0; at + 12 <= size && points.size() < 2000; at += 12) {
    float xyz[3];
    std::memcpy(xyz, bytes + at, sizeof(xyz));
    points.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  const GridPlaces places = RecoverGrid(points, Eigen::Vector3d::Zero());
  Require(places.line.size() == points.size() && places.beam.size() == points.size(),
          "an answer for each point");
  std::set<std::pair<int, int>> taken;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (places.line[i] < 0) continue;
    Require(places.line[i] < places.lines && places.beam[i] >= 0 && places.beam[i] < places.beams,
            "a place on the grid");
    Require(taken.emplace(places.line[i], places.beam[i]).second, "no place twice");
  }
  return 0;
}
