#pragma once

#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <vector>

#include "core/base/image.h"
#include "core/pictures/color_map.h"
#include "ui/render/point_set.h"

namespace foresight {

using Polylines = std::vector<std::vector<Eigen::Vector3d>>;

/// VTK's row 0 is the bottom: pixel (u, v) lies at (u, height - 1 - v) in the result.
vtkSmartPointer<vtkImageData> VtkImageOf(const ColorImage& image);

/// The first `limit` points as one poly-vertex cell (a cell a point is ten times slower to draw).
vtkSmartPointer<vtkPolyData> VtkPointsOf(const PointSet& set, std::size_t limit);

vtkSmartPointer<vtkPolyData> VtkLinesOf(const Polylines& lines);

vtkSmartPointer<vtkLookupTable> VtkTableOf(ColorMap map, const ValueRange& range);

}  // namespace foresight
