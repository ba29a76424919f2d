// Bodies of tetrahedra, cut open at y = const and seen from the side of the cut.
#include <vtkCamera.h>
#include <vtkGeometryFilter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkTableBasedClipDataSet.h>

#include <functional>

#include "drawing/axis.hpp"
#include "drawing/panel.hpp"
#include "drawing/view.hpp"
#include "pictures/pictures.hpp"
#include "pictures/shaded.hpp"
#include "pictures/solution_file.hpp"

namespace antilock::figures {
namespace {

using Vector = Eigen::Vector3d;
constexpr double turned = 28, raised = 18;  // degrees, of the view

/// The surface of the half of a body behind the plane y = at.
vtkSmartPointer<vtkPolyData> opened(const vtkSmartPointer<vtkUnstructuredGrid>& body, double at) {
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, at, 0);
  plane->SetNormal(0, 1, 0);
  vtkNew<vtkTableBasedClipDataSet> clip;
  clip->SetInputData(body);
  clip->SetClipFunction(plane);
  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputConnection(clip->GetOutputPort());
  surface->Update();
  vtkSmartPointer<vtkPolyData> half = surface->GetOutput();
  half->GetPointData()->SetActiveScalars("u");
  return half;
}

/// An edge in front of the body, with the places of its numbers and of its name from its points.
struct FrontEdge {
  Axis axis;
  const char* name;
  std::function<Vector(double)> place;
  Point to_number, to_name;  ///< pixels
  double anchor;             ///< of a number: 1 where it ends at its place
};

void label(Page& page, const View& view, const FrontEdge& edge) {
  for (const Tick& t : edge.axis.ticks()) {
    const Point from = view(edge.place(t.value));
    page.line({from, from + 0.4 * edge.to_number}, {2.5});
    page.text(from + edge.to_number, t.label, {number_size, {edge.anchor, Anchor::Height::middle}});
  }
  const Point middle = view(edge.place(0.5 * (edge.axis.low() + edge.axis.high())));
  page.text(middle + edge.to_name, edge.name, {name_size, {0.5, Anchor::Height::middle}});
}

}  // namespace

Page cut_picture(const std::vector<Surface>& bodies, const CutStyle& style) {
  if (style.range) check(*style.range);
  std::vector<vtkSmartPointer<vtkPolyData>> halves;
  Eigen::AlignedBox3d space;
  Range data{1e300, -1e300};
  for (const Surface& body : bodies) {
    halves.push_back(opened(read_body(body.solution), style.at));
    const double* b = halves.back()->GetBounds();
    space.extend(Vector(b[0], b[2], b[4])).extend(Vector(b[1], b[3], b[5]));
    data = joined(data, range_of(*halves.back()));
  }
  const Range range = style.range.value_or(drawn(data));
  check(range);

  constexpr double head = 90, foot = 150, left = 190, gap = 40;
  const double bar_room = colour_bar_room(range, 20, 250);
  const double cell = (Page::width - bar_room) / static_cast<double>(bodies.size());
  const double tall = 1.75 * (cell - left - gap);
  Page page(foot + tall + head);
  const Vector border = 0.01 * space.sizes();  // so that the lines on the border are inside
  const Eigen::AlignedBox3d fitted(space.min() - border, space.max() + border);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double from = static_cast<double>(i) * cell;
    const Box inside{from + left, foot, cell - left - gap, tall};
    const View view(space, fitted, inside, turned, raised);
    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetActiveCamera(view.camera());
    add_coloured(*renderer, halves[i], range);
    add_edges(*renderer, halves[i], view.towards_eye());
    page.scene(renderer, inside);
    const Vector &low = space.min(), &high = space.max();
    const std::vector<FrontEdge> edges{{Axis::linear(low.x(), high.x(), 2),
                                        "$x$",
                                        [&](double x) { return Vector(x, low.y(), low.z()); },
                                        {-14, -46},
                                        {-40, -106},
                                        0.5},
                                       {Axis::linear(low.y(), high.y(), 1),
                                        "$y$",
                                        [&](double y) { return Vector(high.x(), y, low.z()); },
                                        {74, -14},
                                        {70, -62},
                                        0.5},
                                       {Axis::linear(low.z(), high.z(), 4),
                                        "$z$",
                                        [&](double z) { return Vector(low.x(), low.y(), z); },
                                        {-36, 0},
                                        {-130, 0},
                                        1}};
    for (const FrontEdge& edge : edges) label(page, view, edge);
    page.text({from + left + 0.5 * (cell - left), page.height() - 70.0}, bodies[i].title,
              {name_size, {0.5}, 0, palette::ink, cell - 20});
  }
  draw_colour_bar(page, {Page::width - bar_room + 20, foot + 0.2 * tall, bar_width, 0.6 * tall},
                  range, "$u$", beyond(range, data));
  return page;
}

}  // namespace antilock::figures
