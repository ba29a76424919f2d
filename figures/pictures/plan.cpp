// Solutions seen from above: for functions of many steps and peaks, which hide each other as
// surfaces.
#include <fmt/format.h>
#include <vtkCamera.h>

#include <algorithm>

#include "antilock/core/error.hpp"
#include "drawing/panel.hpp"
#include "drawing/view.hpp"
#include "pictures/pictures.hpp"
#include "pictures/shaded.hpp"
#include "pictures/solution_file.hpp"

namespace antilock::figures {

Page plan_picture(const std::vector<Surface>& surfaces, const PlanStyle& style) {
  Range data{1e300, -1e300}, all_x = data, all_y = data;
  std::vector<vtkSmartPointer<vtkPolyData>> solutions;
  for (const Surface& surface : surfaces) {
    solutions.push_back(read_solution(surface.solution));
    const double* box = solutions.back()->GetBounds();
    data = joined(data, range_of(*solutions.back()));
    all_x = joined(all_x, {box[0], box[1]}), all_y = joined(all_y, {box[2], box[3]});
  }
  const Range in_x = style.x.value_or(all_x), in_y = style.y.value_or(all_y),
              range = style.range.value_or(drawn(data));
  for (const Range& each : {range, in_x, in_y}) check(each);
  const std::size_t count = surfaces.size(), columns = std::min<std::size_t>(count, 3),
                    rows = (count + columns - 1) / columns;
  const Axis x = Axis::linear(in_x.low, in_x.high, columns == 1 ? 5 : 2),
             y = Axis::linear(in_y.low, in_y.high, 3);
  const double bar_room = colour_bar_room(range, 40, 230), gap = 90,
               row_head = style.row_titles.empty() ? 0 : 90, foot = foot_margin;
  const double left = left_margin(Page(1), y);
  const double across = static_cast<double>(columns),
               width = (Page::width - left - bar_room - (across - 1) * gap) / across,
               height = width * (in_y.high - in_y.low) / (in_x.high - in_x.low);
  if (!(height < 4000))
    throw Error(fmt::format("a window of {} by {} is too tall", in_x.high - in_x.low,
                            in_y.high - in_y.low));
  const double row_height = height + head_margin + row_head;
  Page page(static_cast<double>(rows) * row_height + foot);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / columns, column = i % columns;
    const Box box{left + static_cast<double>(column) * (width + gap),
                  foot + static_cast<double>(rows - 1 - row) * row_height, width, height};
    const auto flat = lifted(solutions[i], 0);
    const Eigen::AlignedBox3d window(Eigen::Vector3d(in_x.low, in_y.low, 0),
                                     Eigen::Vector3d(in_x.high, in_y.high, 0));
    const View view(window, window, box, 0, 90);
    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetActiveCamera(view.camera());
    add_surface(*renderer, flat, range, {}, view.towards_eye());
    page.scene(renderer, box);
    const Panel panel{box, x, y};
    if (in_y.low < 0 && in_y.high > 0 && parts_at_zero(*flat))
      page.line({panel(in_x.low, 0), panel(in_x.high, 0)}, {6, palette::white});
    draw_frame(page, panel,
               {surfaces[i].title, row + 1 == rows ? "$x$" : "", column == 0 ? "$y$" : ""});
    if (column == 0 && row < style.row_titles.size())
      page.text({left + 0.5 * (across * width + (across - 1) * gap), box.top() + head_margin + 24},
                style.row_titles[row], {name_size, {0.5}});
  }
  const double all = page.height() - foot - row_head - head_margin;
  draw_colour_bar(page, {Page::width - bar_room + 40, foot + 0.2 * all, bar_width, 0.6 * all},
                  range, style.name, beyond(range, data));
  return page;
}

}  // namespace antilock::figures
