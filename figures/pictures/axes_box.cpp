// The axes of a surface picture: a box in space, and its numbers on the page.
#include "pictures/axes_box.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <functional>

namespace antilock::figures {
namespace {

using Vector = Eigen::Vector3d;

void add_lines(vtkRenderer& renderer, const std::vector<std::pair<Vector, Vector>>& lines,
               double width, const Colour& colour) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& [from, to] : lines) {
    const vtkIdType ends[2] = {points->InsertNextPoint(from.data()),
                               points->InsertNextPoint(to.data())};
    cells->InsertNextCell(2, ends);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(oversampling * width));
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

/// Numbers along one edge of the box; `outward` points away from it.
void label_edge(Page& page, const View& view, const Axis& axis,
                const std::function<Vector(double)>& place, const Vector& outward) {
  const Point full = view(place(axis.low()) + outward) - view(place(axis.low())),
              away = (1 / length(full)) * full;
  for (const Tick& t : axis.ticks()) {
    const Point at = view(place(t.value));
    page.line({at, at + 14.0 * away}, {2.5});
    page.text(at + (0.75 * number_size + 6) * away, t.label,
              {number_size, {0.5 - 0.5 * away.x, Anchor::Height::middle}});
  }
}

/// The name of an edge, beside its middle.
void name_edge(Page& page, Point from, Point to, Point beside, const std::string& name) {
  page.text(0.5 * (from + to) + beside, name, {name_size, {0.5, Anchor::Height::middle}});
}

}  // namespace

AxesBox make_axes_box(const vtkBoundingBox& domain, const Range& range, double height,
                      AxesDetail detail) {
  double b[6];
  domain.GetBounds(b);
  const double factor = height / (range.high - range.low);
  const Eigen::AlignedBox3d space(Vector(b[0], b[2], factor * range.low),
                                  Vector(b[1], b[3], factor * range.high));
  const bool full = detail == AxesDetail::full;
  const int along =
      std::max(1, static_cast<int>(std::lround((full ? 2 : 1) * (b[3] - b[2]))));  // 1/2 or 1 apart
  return {space,
          Axis::linear(b[0], b[1], full ? 2 : 1),
          Axis::linear(b[2], b[3], along),
          Axis::linear(range.low, range.high, full ? 5 : 2),
          factor,
          detail};
}

void add_walls(vtkRenderer& renderer, const AxesBox& axes) {
  const Vector &low = axes.space.min(),
               &high = axes.space.max();  // the eye looks from high x and low y
  std::vector<std::pair<Vector, Vector>> grid;
  for (const Tick& t : axes.x.ticks()) {
    grid.push_back({{t.value, low.y(), low.z()}, {t.value, high.y(), low.z()}});
    grid.push_back({{t.value, high.y(), low.z()}, {t.value, high.y(), high.z()}});
  }
  for (const Tick& t : axes.y.ticks()) {
    grid.push_back({{low.x(), t.value, low.z()}, {high.x(), t.value, low.z()}});
    grid.push_back({{low.x(), t.value, low.z()}, {low.x(), t.value, high.z()}});
  }
  for (const Tick& t : axes.u.ticks()) {
    const double z = axes.factor * t.value;
    grid.push_back({{low.x(), high.y(), z}, {high.x(), high.y(), z}});
    grid.push_back({{low.x(), low.y(), z}, {low.x(), high.y(), z}});
  }
  add_lines(renderer, grid, 1.5, {0.8, 0.8, 0.8});
  const auto corner = [&](bool x, bool y, bool z) {
    return Vector(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  add_lines(renderer,
            {{corner(0, 0, 0), corner(1, 0, 0)},
             {corner(1, 0, 0), corner(1, 1, 0)},
             {corner(0, 0, 0), corner(0, 1, 0)},
             {corner(0, 1, 0), corner(1, 1, 0)},
             {corner(0, 0, 0), corner(0, 0, 1)},
             {corner(0, 1, 0), corner(0, 1, 1)},
             {corner(1, 1, 0), corner(1, 1, 1)},
             {corner(0, 0, 1), corner(0, 1, 1)},
             {corner(0, 1, 1), corner(1, 1, 1)}},
            2, palette::ink);
  if (low.y() < 0 && axes.parts)
    add_lines(renderer, {{{low.x(), 0, low.z()}, {high.x(), 0, low.z()}}}, 4,
              palette::green);  // Sigma, on the floor
}

void label_axes(Page& page, const View& view, const AxesBox& axes, const std::string& height) {
  const Vector &low = axes.space.min(), &high = axes.space.max();
  label_edge(page, view, axes.x, [&](double v) { return Vector(v, low.y(), low.z()); }, {0, -1, 0});
  label_edge(page, view, axes.y, [&](double v) { return Vector(high.x(), v, low.z()); }, {1, 0, 0});
  label_edge(page, view, axes.u,
             [&](double v) { return Vector(low.x(), low.y(), axes.factor * v); }, {-1, 0, 0});
  const Point left = view(low), front = view({high.x(), low.y(), low.z()}),
              right = view({high.x(), high.y(), low.z()});
  const bool full = axes.detail == AxesDetail::full;  // with numbers also in the middle of an edge
  name_edge(page, left, front, full ? Point{-75, -110} : Point{-55, -75}, "$x$");
  name_edge(page, front, right, full ? Point{110, -90} : Point{75, -75}, "$y$");
  const Point top = view({low.x(), low.y(), high.z()});
  name_edge(page, top, top, {-45, 76}, height);  // above its numbers

  if (axes.detail == AxesDetail::least || !axes.parts) return;
  const double inset = high.x() - 0.1 * (high.x() - low.x());
  const Anchor centre{0.5, Anchor::Height::middle};
  const Colour pale_ink{0.4, 0.4, 0.4};
  const double share = full ? 0.25 : 0.45;
  page.text(view({inset, share * high.y(), low.z()}), "$Ω^+$", {name_size, centre, 0, pale_ink});
  if (!(low.y() < 0)) return;
  page.text(view({inset, share * low.y(), low.z()}), "$Ω^−$", {name_size, centre, 0, pale_ink});
  page.text(view({inset, 0, low.z()}) + Point{0, 0.7 * name_size}, "$Σ$",
            {name_size, centre, 0, palette::green});
}

}  // namespace antilock::figures
