// Solutions as surfaces over the domain, as in Figures 4, 5, 7 and 8.
#include <vtkCamera.h>

#include <algorithm>

#include "pictures/axes_box.hpp"
#include "pictures/pictures.hpp"
#include "pictures/shaded.hpp"
#include "pictures/solution_file.hpp"

namespace antilock::figures {
namespace {

constexpr double azimuth = 38, elevation = 32;  // of every surface, so that they compare
/// Where the surfaces stand and how much is written around each.
struct Arrangement {
  std::size_t columns, rows;
  double cell_width, cell_height, head;
  bool bar_aside;  ///< a strip at the right; otherwise in the empty last cell, or nowhere
  bool bar_in_cell;

  Arrangement(std::size_t count, bool titled, bool own_scale, double bar_room)
      : columns(count == 1   ? 1
                : count <= 4 ? 2
                             : 3),
        rows((count + columns - 1) / columns),
        bar_aside(count % columns == 0 && !(own_scale && count <= 2)),
        bar_in_cell(count % columns != 0) {
    cell_width = (Page::width - (bar_aside ? bar_room : 0)) / static_cast<double>(columns);
    cell_height = columns == 1 ? 0.78 * cell_width : 0.88 * cell_width;
    head = titled ? 90 : 20;
  }
  double height() const { return static_cast<double>(rows) * (cell_height + head); }
  Box cell(std::size_t i) const {
    const std::size_t above_foot = rows - 1 - i / columns;
    return {static_cast<double>(i % columns) * cell_width,
            static_cast<double>(above_foot) * (cell_height + head), cell_width, cell_height};
  }
};

vtkBoundingBox domain_of(vtkPolyData& solution) {
  vtkBoundingBox box;
  box.AddBounds(solution.GetBounds());
  return box;
}

}  // namespace

Page surface_picture(const std::vector<Surface>& surfaces, const SurfaceStyle& style) {
  if (style.range) check(*style.range);
  if (style.last_range) check(*style.last_range);
  std::vector<vtkSmartPointer<vtkPolyData>> solutions;
  vtkBoundingBox all;  // so that they share a scale
  const std::size_t count = surfaces.size();
  Range data{1e300, -1e300};
  for (const Surface& surface : surfaces) {
    solutions.push_back(read_solution(surface.solution));
    all.AddBox(domain_of(*solutions.back()));
    const bool own = style.last_range && solutions.size() == count;
    if (!own) data = joined(data, range_of(*solutions.back()));
  }
  const Range shared = style.range.value_or(drawn(data));
  check(shared);
  const Beyond marks = beyond(shared, data);
  const bool titled = std::any_of(surfaces.begin(), surfaces.end(),
                                  [](const Surface& s) { return !s.title.empty(); });
  const Arrangement at(count, titled, style.last_range.has_value(),
                       colour_bar_room(shared, 20, 250));
  const AxesDetail detail = at.columns == 1   ? AxesDetail::full
                            : at.columns == 2 ? AxesDetail::few
                                              : AxesDetail::least;
  Page page(at.height());

  const double span = shared.high - shared.low, factor = style.range ? 2 : 1 / span;
  const double drawn_height = style.height_factor.value_or(factor) * span;
  for (std::size_t i = 0; i < count; ++i) {
    const bool own = style.last_range && i + 1 == count;
    const Range range = own ? *style.last_range : shared;
    const Box cell = at.cell(i);
    AxesBox axes = make_axes_box(domain_of(*solutions[i]), range, drawn_height, detail);
    axes.parts = style.regions && parts_at_zero(*solutions[i]);
    const double left = widest_number(page, axes.u) + 65, below = 130;
    const Box inside{cell.x + left, cell.y + below, cell.width - left - 85,
                     cell.height - below - 10};
    Eigen::AlignedBox3d fitted = make_axes_box(all, range, drawn_height, detail).space;
    const Eigen::Vector3d edge =
        0.01 * fitted.sizes();  // so that the lines on its border are inside
    fitted = {fitted.min() - edge, fitted.max() + edge};
    const View view(axes.space, fitted, inside, azimuth, elevation);

    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetActiveCamera(view.camera());
    add_walls(*renderer, axes);
    add_surface(*renderer, lifted(solutions[i], axes.factor), range, style.grid,
                view.towards_eye());
    page.scene(renderer, inside);
    label_axes(page, view, axes, own ? style.last_name : "$u$");
    page.text({cell.centre().x, cell.top() + 20}, surfaces[i].title,
              {name_size, {0.5}, 0, palette::ink, cell.width - 20});
  }
  if (at.bar_aside) {
    const Box first = at.cell(at.columns - 1);
    draw_colour_bar(
        page, {first.right() + 20, first.y + 0.2 * first.height, bar_width, 0.6 * first.height},
        shared, "$u$", marks);
  }
  if (at.bar_in_cell) {
    const Box empty = at.cell(count);
    draw_colour_bar(
        page, {empty.centre().x - 60, empty.y + 0.2 * empty.height, bar_width, 0.6 * empty.height},
        shared, "$u$", marks);
  }
  return page;
}

}  // namespace antilock::figures
