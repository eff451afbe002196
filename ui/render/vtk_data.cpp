#include "ui/render/vtk_data.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>

namespace foresight {

vtkSmartPointer<vtkImageData> VtkImageOf(const ColorImage& image) {
  auto data = vtkSmartPointer<vtkImageData>::New();
  data->SetDimensions(std::max(1, image.width()), std::max(1, image.height()), 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row_bytes = static_cast<std::size_t>(image.width()) * sizeof(Rgb8);
  for (int y = 0; y < image.height(); ++y)
    std::memcpy(data->GetScalarPointer(0, image.height() - 1 - y, 0), image.row(y), row_bytes);
  return data;
}

vtkSmartPointer<vtkPolyData> VtkPointsOf(const PointSet& set, std::size_t limit) {
  const auto count = static_cast<vtkIdType>(std::min(limit, set.points.size()));
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  if (count > 0)
    std::memcpy(coordinates->GetPointer(0), set.points.data(),
                static_cast<std::size_t>(count) * sizeof(Eigen::Vector3f));
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(static_cast<int>(count));
  for (vtkIdType i = 0; i < count; ++i) vertices->InsertCellPoint(i);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(vertices);
  if (!set.colors.empty()) {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(3);
    colors->SetNumberOfTuples(count);
    std::memcpy(colors->GetPointer(0), set.colors.data(), static_cast<std::size_t>(count) * 3);
    data->GetPointData()->SetScalars(colors);
  } else {
    vtkNew<vtkFloatArray> values;
    values->SetNumberOfTuples(count);
    std::copy_n(set.values.begin(), count, values->GetPointer(0));
    data->GetPointData()->SetScalars(values);
  }
  return data;
}

vtkSmartPointer<vtkPolyData> VtkLinesOf(const Polylines& lines) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const auto& point : line)
      cells->InsertCellPoint(points->InsertNextPoint(point.x(), point.y(), point.z()));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  return data;
}

vtkSmartPointer<vtkLookupTable> VtkTableOf(ColorMap map, const ValueRange& range) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(256);
  table->SetRange(range.low, range.high);
  for (int i = 0; i < 256; ++i) {
    const Rgb8 color = ColorOf(map, i / 255.0);
    table->SetTableValue(i, color.r / 255.0, color.g / 255.0, color.b / 255.0);
  }
  return table;
}

}  // namespace foresight
