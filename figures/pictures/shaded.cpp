#include "pictures/shaded.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCutter.h>
#include <vtkDataArray.h>
#include <vtkExtractEdges.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <array>
#include <cmath>
#include <map>

namespace antilock::figures {
namespace {

using Vector = Eigen::Vector3d;
constexpr double enlargement = oversampling;  // VTK counts line widths in rendered pixels

/// The corners of the steps, each a triangle of points and values: an edge that two triangles share
/// with different values at its ends is a quadrilateral on end, or two triangles that meet where
/// the values cross.
class Steps {
 public:
  explicit Steps(vtkPolyData& surface)
      : surface_(surface), values_(*surface.GetPointData()->GetScalars()) {}

  void add() {
    std::map<std::array<long, 4>, std::array<vtkIdType, 2>> open;
    const vtkIdType cells = surface_.GetNumberOfCells();
    for (vtkIdType cell = 0; cell < cells; ++cell) {
      vtkIdType size = 0;
      const vtkIdType* corners = nullptr;
      surface_.GetCellPoints(cell, size, corners);
      for (int i = 0; i < 3; ++i) {
        std::array<vtkIdType, 2> edge{corners[i], corners[(i + 1) % 3]};
        if (place(edge[1]) < place(edge[0])) std::swap(edge[0], edge[1]);
        const auto p = place(edge[0]), q = place(edge[1]);
        const std::array<long, 4> key{p[0], p[1], q[0], q[1]};
        if (const auto other = open.find(key); other != open.end())
          close(edge, other->second);
        else
          open[key] = edge;
      }
    }
    for (const auto& wall : walls_) surface_.GetPolys()->InsertNextCell(3, wall.data());
    surface_.DeleteCells();  // VTK's index of them, which is behind now
  }

 private:
  using Place = std::array<long, 2>;
  Place place(vtkIdType point) const {
    const double* p = surface_.GetPoint(point);
    return {std::lround(1e9 * p[0]), std::lround(1e9 * p[1])};
  }
  double step(vtkIdType a, vtkIdType b) const {
    return values_.GetTuple1(a) - values_.GetTuple1(b);
  }

  void close(const std::array<vtkIdType, 2>& one, const std::array<vtkIdType, 2>& other) {
    const double first = step(one[0], other[0]), last = step(one[1], other[1]);
    if (first == 0 && last == 0) return;
    if (first * last >= 0) {
      walls_.push_back({one[0], one[1], other[1]});
      walls_.push_back({one[0], other[1], other[0]});
      return;
    }
    const vtkIdType crossing = between(one[0], one[1], first / (first - last));
    walls_.push_back({one[0], crossing, other[0]});
    walls_.push_back({one[1], crossing, other[1]});
  }

  vtkIdType between(vtkIdType a, vtkIdType b, double share) {
    const Vector p(surface_.GetPoint(a)), q(surface_.GetPoint(b)), at = p + share * (q - p);
    values_.InsertNextTuple1(values_.GetTuple1(a) +
                             share * (values_.GetTuple1(b) - values_.GetTuple1(a)));
    return surface_.GetPoints()->InsertNextPoint(at.data());
  }

  vtkPolyData& surface_;
  vtkDataArray& values_;
  std::vector<std::array<vtkIdType, 3>> walls_;
};

vtkSmartPointer<vtkLookupTable> viridis_table(const Range& range) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(256);
  for (int i = 0; i < 256; ++i) {
    const Colour c = viridis(i / 255.0);
    table->SetTableValue(i, c[0], c[1], c[2], 1);
  }
  table->SetRange(range.low, range.high);
  return table;
}

/// Dark lines in front of the surface on which they lie; pale ones, so that a fine mesh is no black
/// mass.
void add_lines(vtkRenderer& renderer, vtkAlgorithmOutput* lines, double width, double opacity,
               const Vector& towards_eye) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(lines);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  const Vector forward = 0.004 * towards_eye;
  actor->SetPosition(forward.x(), forward.y(), forward.z());
  actor->GetProperty()->SetColor(0, 0, 0);
  actor->GetProperty()->SetOpacity(opacity);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width * enlargement));
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

void add_grid(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface, int n,
              const Vector& towards_eye) {
  const double* bounds = surface->GetBounds();
  for (const int axis : {0, 1}) {
    vtkNew<vtkPlane> plane;
    plane->SetNormal(axis == 0, axis == 1, 0);
    vtkNew<vtkCutter> cutter;
    cutter->SetCutFunction(plane);
    cutter->SetInputData(surface);
    cutter->GenerateCutScalarsOff();
    int line = 0;
    for (int k = static_cast<int>(std::ceil(bounds[2 * axis] * n)); k <= bounds[2 * axis + 1] * n;
         ++k)
      cutter->SetValue(line++, static_cast<double>(k) / n);
    add_lines(renderer, cutter->GetOutputPort(), 1.1, 0.5, towards_eye);
  }
}

}  // namespace

vtkSmartPointer<vtkPolyData> lifted(const vtkSmartPointer<vtkPolyData>& flat, double factor) {
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->DeepCopy(flat);
  vtkDataArray* u = surface->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
    const double* p = flat->GetPoint(i);
    surface->GetPoints()->SetPoint(i, p[0], p[1], factor * u->GetTuple1(i));
  }
  return surface;
}

void add_coloured(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface,
                  const Range& range) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetLookupTable(viridis_table(range));
  mapper->SetScalarRange(range.low, range.high);
  mapper->InterpolateScalarsBeforeMappingOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToFlat();
  property->SetAmbient(0.55);
  property->SetDiffuse(0.5);
  property->SetSpecular(0);
  renderer.AddActor(actor);
}

void add_edges(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface,
               const Vector& towards_eye) {
  vtkNew<vtkExtractEdges> edges;
  edges->SetInputData(surface);
  add_lines(renderer, edges->GetOutputPort(), 0.8, 0.24, towards_eye);
}

void add_surface(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface,
                 const Range& range, const std::optional<int>& grid, const Vector& towards_eye) {
  auto closed = vtkSmartPointer<vtkPolyData>::New();
  closed->DeepCopy(surface);
  Steps(*closed).add();
  add_coloured(renderer, closed, range);
  if (grid) return add_grid(renderer, surface, *grid, towards_eye);
  add_edges(renderer, surface, towards_eye);
}

}  // namespace antilock::figures
