#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "core/pictures/sample_marks.h"

namespace foresight {

/// The kept samples among the marks as coloured points. As everywhere in VTK pixel (u, v) lies at
/// (u, image_height - 1 - v).
vtkSmartPointer<vtkPolyData> VtkDotsOf(const std::vector<SampleMark>& marks, int image_height);

/// The rejected ones as coloured lines: each symbol reaches `half_size` pixels of the image.
vtkSmartPointer<vtkPolyData> VtkSymbolsOf(const std::vector<SampleMark>& marks, int image_height,
                                          double half_size);

}  // namespace foresight
