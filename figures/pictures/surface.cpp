// Solutions as surfaces over the domain, as in Figures 4, 5, 7 and 8.
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCutter.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>

#include "drawing/colour_bar.hpp"
#include "pictures/pictures.hpp"
#include "pictures/room.hpp"
#include "pictures/solution_file.hpp"

namespace antilock::figures {
namespace {

using Vector = Eigen::Vector3d;

constexpr double azimuth = 38, elevation = 32;      // of every surface, so that they compare
constexpr double enlargement = Page::oversampling;  // VTK counts line widths in rendered pixels

/// The surface lifted to (x, y, height of u).
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

/// Lines x = k/n and y = k/n on the surface, for meshes whose own edges would be a black mass.
void add_grid(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface, int n, const Vector& towards_eye) {
  const double* bounds = surface->GetBounds();
  for (const int axis : {0, 1}) {
    vtkNew<vtkPlane> plane;
    plane->SetNormal(axis == 0, axis == 1, 0);
    vtkNew<vtkCutter> cutter;
    cutter->SetCutFunction(plane);
    cutter->SetInputData(surface);
    cutter->GenerateCutScalarsOff();
    int line = 0;
    for (int k = static_cast<int>(std::ceil(bounds[2 * axis] * n)); k <= bounds[2 * axis + 1] * n; ++k)
      cutter->SetValue(line++, static_cast<double>(k) / n);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(cutter->GetOutputPort());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    const Vector forward = 0.004 * towards_eye;  // in front of the surface they lie on
    actor->SetPosition(forward.x(), forward.y(), forward.z());
    actor->GetProperty()->SetColor(0.1, 0.1, 0.1);
    actor->GetProperty()->SetLineWidth(static_cast<float>(1.1 * enlargement));
    actor->GetProperty()->LightingOff();
    renderer.AddActor(actor);
  }
}

void add_surface(vtkRenderer& renderer, const vtkSmartPointer<vtkPolyData>& surface, const Range& range,
                 const std::optional<int>& grid, const Vector& towards_eye) {
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
  if (!grid) {
    property->EdgeVisibilityOn();
    property->SetEdgeColor(0.1, 0.1, 0.1);
    const double width = std::clamp(35 / std::sqrt(surface->GetNumberOfCells()), 0.4, 1.1);  // fine meshes, fine lines
    property->SetLineWidth(static_cast<float>(width * enlargement));
  }
  renderer.AddActor(actor);
  if (grid) add_grid(renderer, surface, *grid, towards_eye);
}

}  // namespace

Page surface_picture(const std::vector<Surface>& surfaces, const SurfaceStyle& style) {
  check(style.range);
  if (style.last_range) check(*style.last_range);
  std::vector<vtkSmartPointer<vtkPolyData>> solutions;
  vtkBoundingBox domain;  // of all of them, so that they share a scale
  for (const Surface& surface : surfaces) {
    solutions.push_back(read_solution(surface.solution));
    domain.AddBounds(solutions.back()->GetBounds());
  }

  constexpr double cell_width = 1500, cell_height = 1250, bar_room = 300, own_bar_room = 420,
                   size = 46;  // an own scale may need powers of ten
  const std::size_t count = surfaces.size(), columns = std::min<std::size_t>(count, 3);
  const std::size_t rows = (count + columns - 1) / columns;
  const bool titled = std::any_of(surfaces.begin(), surfaces.end(), [](const Surface& s) { return !s.title.empty(); });
  const double row_height = cell_height + (titled ? 120 : 20);
  const bool shared_bar = count > 1 || !style.last_range;
  const double width =
      static_cast<double>(columns) * cell_width + shared_bar * bar_room + style.last_range.has_value() * own_bar_room;
  Page page(static_cast<int>(width), static_cast<int>(static_cast<double>(rows) * row_height));

  for (std::size_t i = 0; i < count; ++i) {
    const bool own = style.last_range && i + 1 == count, last_in_row = i % columns + 1 == columns;
    const Range range = own ? *style.last_range : style.range;
    const double left = static_cast<double>(i % columns) * cell_width + (own && shared_bar && rows == 1) * bar_room;
    const Box cell{left, static_cast<double>(rows - 1 - i / columns) * row_height, cell_width, cell_height};
    const Box inside{cell.x + 190, cell.y + 150, cell.width - 230, cell.height - 170};
    const Room room = make_room(domain, range, style.height_factor * (style.range.high - style.range.low));
    const View view(room.space, inside, azimuth, elevation);

    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetActiveCamera(view.camera());
    add_walls(*renderer, room);
    add_surface(*renderer, lifted(solutions[i], room.factor), range, style.grid, view.towards_eye());
    page.scene(renderer, inside);
    label_room(page, view, room, own ? style.last_name : "$u$", size);
    page.text({cell.centre().x, cell.top() + 24}, surfaces[i].title, {60, {0.5}});

    const bool before_own = style.last_range && rows == 1 && i + 2 == count;
    if (own || before_own || (last_in_row && i < columns))
      draw_colour_bar(page, {cell.right() + 30, cell.y + 300, 60, cell.height - 500}, range,
                      own ? style.last_name : "$u$", size);
  }
  return page;
}

}  // namespace antilock::figures
