#include "ui/render/vtk_marks.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

namespace foresight {
namespace {

void Append(vtkUnsignedCharArray* colors, Rgb8 color) {
  const unsigned char rgb[3] = {color.r, color.g, color.b};
  colors->InsertNextTypedTuple(rgb);
}

}  // namespace

vtkSmartPointer<vtkPolyData> VtkDotsOf(const std::vector<SampleMark>& marks, int image_height) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const SampleMark& mark : marks) {
    if (mark.kind != RejectReason::kKept) continue;
    points->InsertNextPoint(mark.pixel.x(), image_height - 1 - mark.pixel.y(), 0.0);
    Append(colors, mark.color);
  }
  // One cell for all points: a cell a point is ten times slower to draw.
  vtkNew<vtkCellArray> cell;
  cell->InsertNextCell(static_cast<int>(points->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) cell->InsertCellPoint(i);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(cell);
  data->GetPointData()->SetScalars(colors);
  return data;
}

vtkSmartPointer<vtkPolyData> VtkSymbolsOf(const std::vector<SampleMark>& marks, int image_height,
                                          double half_size) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const SampleMark& mark : marks) {
    for (const auto& stroke : StrokesOf(mark.kind)) {
      lines->InsertNextCell(static_cast<int>(stroke.size()));
      for (const Eigen::Vector2d& corner : stroke) {
        const Eigen::Vector2d at = mark.pixel + half_size * corner;
        lines->InsertCellPoint(points->InsertNextPoint(at.x(), image_height - 1 - at.y(), 0.0));
      }
      Append(colors, mark.color);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->SetScalars(colors);
  return data;
}

}  // namespace foresight
