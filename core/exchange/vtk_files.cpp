#include "core/exchange/vtk_files.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkGLTFWriter.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkObject.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "core/base/atomic_file.h"
#include "core/base/publish_file.h"
#include "core/exchange/gltf_colors.h"

namespace foresight {
namespace {

/// Runs `write(part)` on a neighbour, which becomes the file when it is whole.
template <class Write>
Status WriteThroughPart(const std::filesystem::path& path, const Write& write) {
  FORESIGHT_TRY(const std::filesystem::path target, ResolveOutput(path));
  const std::filesystem::path part = target.string() + ".part" + target.extension().string();
  std::error_code error;
  std::filesystem::remove(part, error);
  if (!write(part) || !std::filesystem::exists(part, error)) {
    std::filesystem::remove(part, error);
    return Fail(ErrorCode::kIo, "{}: could not be written (is the disk full, is the folder there?)",
                target.string());
  }
  return PublishFile(part, target);
}

template <class Array, class Value>
vtkSmartPointer<Array> ArrayOf(const char* name, std::span<const CloudPoint> points,
                               const Value& value) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    array->SetValue(static_cast<vtkIdType>(i), value(points[i]));
  return array;
}

vtkSmartPointer<vtkUnsignedCharArray> ColorsOf(std::span<const CloudPoint> points) {
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName("rgb");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rgb8 c = points[i].color;
    colors->SetTypedComponent(static_cast<vtkIdType>(i), 0, c.r);
    colors->SetTypedComponent(static_cast<vtkIdType>(i), 1, c.g);
    colors->SetTypedComponent(static_cast<vtkIdType>(i), 2, c.b);
  }
  return colors;
}

vtkSmartPointer<vtkPolyData> PolyDataOf(std::span<const CloudPoint> points) {
  vtkNew<vtkPoints> places;
  places->SetDataTypeToFloat();
  places->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    places->SetPoint(static_cast<vtkIdType>(i), points[i].x, points[i].y, points[i].z);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(places);
  return data;
}

vtkSmartPointer<vtkPolyData> SurfaceOf(std::span<const CloudPoint> points,
                                       std::span<const std::array<std::int32_t, 3>> triangles) {
  vtkSmartPointer<vtkPolyData> data = PolyDataOf(points);
  vtkNew<vtkCellArray> cells;
  for (const std::array<std::int32_t, 3>& triangle : triangles)
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  data->SetPolys(cells);
  data->GetPointData()->SetScalars(ColorsOf(points));
  return data;
}

/// What went wrong is told by our own error and not by VTK's lines on stderr.
class NoWarnings {
 public:
  NoWarnings() { vtkObject::GlobalWarningDisplayOff(); }
  ~NoWarnings() { vtkObject::SetGlobalWarningDisplay(before_); }
  NoWarnings(const NoWarnings&) = delete;
  NoWarnings& operator=(const NoWarnings&) = delete;

 private:
  vtkTypeBool before_ = vtkObject::GetGlobalWarningDisplay();
};

template <class Writer>
bool Write(Writer& writer, const std::filesystem::path& part) {
  const NoWarnings quiet;
  writer.SetFileName(part.c_str());
  return writer.Write() == 1 && writer.GetErrorCode() == vtkErrorCode::NoError;
}

bool WritePolyData(vtkPolyData* data, const std::filesystem::path& part) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetEncodeAppendedData(false);
  return Write(*writer, part);
}

/// VTK's writer does not see that a disk is full: its last line is the last triangle's, or the file
/// is not whole.
bool WriteObj(vtkPolyData* data, const std::filesystem::path& part) {
  vtkNew<vtkOBJWriter> writer;
  writer->SetInputData(data);
  if (!Write(*writer, part)) return false;
  std::ifstream file(part);
  vtkIdType faces = 0;
  std::string line;
  while (std::getline(file, line) && !file.eof()) faces += line.starts_with("f ") ? 1 : 0;
  return faces == data->GetNumberOfPolys();
}

bool WriteGltf(vtkPolyData* data, std::span<const CloudPoint> points,
               const std::filesystem::path& part) {
  // The writer wants a scene of buildings, each of meshes.
  vtkNew<vtkMultiBlockDataSet> building, scene;
  building->SetBlock(0, data);
  scene->SetBlock(0, building);
  vtkNew<vtkGLTFWriter> writer;
  writer->SetInputData(scene);
  writer->InlineDataOn();
  writer->SaveTexturesOff();
  if (!Write(*writer, part)) return false;
  std::ifstream written(part);
  nlohmann::json gltf = nlohmann::json::parse(written, nullptr, false);
  written.close();
  if (gltf.is_discarded() || !AddGltfColors(points, gltf)) return false;  // as with an OBJ file
  std::ofstream file(part, std::ios::trunc);
  file << gltf.dump() << '\n' << std::flush;
  return file.good();
}

}  // namespace

Status WriteVtp(const std::filesystem::path& path, std::span<const CloudPoint> points) {
  const vtkSmartPointer<vtkPolyData> data = PolyDataOf(points);
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(points.size()); ++i)
    vertices->InsertNextCell({i});
  data->SetVerts(vertices);
  vtkPointData* fields = data->GetPointData();
  fields->SetScalars(ColorsOf(points));
  fields->AddArray(
      ArrayOf<vtkFloatArray>("intensity", points, [](auto& p) { return p.intensity; }));
  fields->AddArray(ArrayOf<vtkIntArray>("line", points, [](auto& p) { return p.line; }));
  fields->AddArray(ArrayOf<vtkIntArray>("beam", points, [](auto& p) { return p.beam; }));
  fields->AddArray(ArrayOf<vtkDoubleArray>("time", points, [](auto& p) { return p.time_s; }));
  fields->AddArray(
      ArrayOf<vtkFloatArray>("confidence", points, [](auto& p) { return p.confidence; }));
  return WriteThroughPart(path, [&](const auto& part) { return WritePolyData(data.Get(), part); });
}

Status WriteVti(const std::filesystem::path& path, const DepthResult& depth,
                const ColorImage& image) {
  const int width = depth.dense.depth_m.width(), height = depth.dense.depth_m.height();
  if (!image.SameSize(depth.dense.depth_m))
    return Fail(ErrorCode::kInvalidInput, "an image of {} x {} pixels, a depth map of {} x {}",
                image.width(), image.height(), width, height);
  vtkNew<vtkImageData> data;
  data->SetDimensions(width, height, 1);
  const vtkIdType count = static_cast<vtkIdType>(width) * height;
  vtkNew<vtkFloatArray> depths, confidences;
  vtkNew<vtkUnsignedCharArray> mask, colors;
  depths->SetName("depth_m");
  confidences->SetName("confidence");
  mask->SetName("mask");
  colors->SetName("rgb");
  colors->SetNumberOfComponents(3);
  for (auto* array : {static_cast<vtkDataArray*>(depths), static_cast<vtkDataArray*>(confidences),
                      static_cast<vtkDataArray*>(mask), static_cast<vtkDataArray*>(colors)})
    array->SetNumberOfTuples(count);
  vtkIdType at = 0;
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x, ++at) {
      depths->SetValue(at, depth.dense.depth_m(x, y));
      confidences->SetValue(at, depth.dense.confidence(x, y));
      mask->SetValue(at, depth.mask(x, y));
      const Rgb8 c = image(x, y);
      colors->SetTypedComponent(at, 0, c.r);
      colors->SetTypedComponent(at, 1, c.g);
      colors->SetTypedComponent(at, 2, c.b);
    }
  data->GetPointData()->SetScalars(depths);
  data->GetPointData()->AddArray(confidences);
  data->GetPointData()->AddArray(mask);
  data->GetPointData()->AddArray(colors);
  return WriteThroughPart(path, [&](const auto& part) {
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputData(data);
    writer->SetEncodeAppendedData(false);
    return Write(*writer, part);
  });
}

Status WriteSurface(const std::filesystem::path& path, std::span<const CloudPoint> points,
                    std::span<const std::array<std::int32_t, 3>> triangles) {
  const std::string ending = path.extension().string();
  if (ending != ".ply" && ending != ".obj" && ending != ".gltf" && ending != ".vtp")
    return Fail(ErrorCode::kInvalidInput, "{}: a surface is written as .ply, .obj, .gltf or .vtp",
                path.string());
  const vtkSmartPointer<vtkPolyData> data = SurfaceOf(points, triangles);
  return WriteThroughPart(path, [&](const std::filesystem::path& part) -> bool {
    if (ending == ".ply") {
      vtkNew<vtkPLYWriter> writer;
      writer->SetInputData(data);
      writer->SetArrayName("rgb");
      return Write(*writer, part);
    }
    if (ending == ".obj") return WriteObj(data.Get(), part);
    if (ending == ".gltf") return WriteGltf(data.Get(), points, part);
    return WritePolyData(data.Get(), part);
  });
}

}  // namespace foresight
