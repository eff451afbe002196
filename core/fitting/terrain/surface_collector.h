#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fitting/ray_set.h"
#include "core/fitting/terrain/block_evidence.h"
#include "core/fitting/terrain/fit_terrain.h"
#include "core/fitting/terrain/surface_grid.h"
#include "core/fitting/terrain/surface_planes.h"
#include "core/fitting/terrain/terrain_detection.h"

namespace foresight {

/// A surface and what it was made from.
struct FoundSurface {
  TerrainSurface surface;
  RectangleEvidence evidence;  ///< of a block
  std::vector<int> points;     ///< of the grid
  int view = -1;               ///< of a block: index into the collector's views
  BlockRectangle rectangle;    ///< of a block, in that view
};

/// Blocks and other surfaces, plane by plane, then placed together. What it is given must outlive
/// it.
class SurfaceCollector {
 public:
  SurfaceCollector(const RaySet& rays, const SurfaceGrid& grid, const FitTerrainOptions& options);

  /// The blocks on one plane, and what is left of it.
  void Add(const SurfacePlanes& planes, int plane);

  /// Moves blocks that stand in rows to where their own edges and their neighbours have them, and
  /// gathers their evidence again there. Without rows, nothing changes.
  void PlaceTogether();

  /// Moves blocks to where an image has their edges, and gathers their evidence again there; not
  /// into another block, and not to where beams do not have them. What is known of their rows, and
  /// the points that are theirs, stay.
  void PlaceByImage();

  /// What speaks for the size of each block, beside the others on its plane, and for that of all.
  void MeasureSizes();

  std::vector<FoundSurface> found;

 private:
  void AddBlocks(const PlaneView& view, std::vector<PlaneView::Sample>& left);
  /// Moves a found block. What is known of its rows stays.
  void MoveTo(const BlockRectangle& rectangle, FoundSurface& block) const;
  bool MovedIntoAnother(const FoundSurface& block, const FoundSurface& moved) const;
  FoundSurface BlockAt(int view, const BlockRectangle& rectangle) const;

  const RaySet& rays_;
  const SurfaceGrid& grid_;
  const FitTerrainOptions& options_;
  Eigen::Vector2d size_m_;  ///< of a block, the longer side first
  std::vector<PlaneView> views_;
};

}  // namespace foresight
