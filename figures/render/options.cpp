#include "render/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "antilock/core/error.hpp"
#include "drawing/styles.hpp"

namespace antilock::figures {
namespace {

/// Why a file cannot be named so, empty where it can: what is written is a PNG whatever it is
/// called.
std::string png_name(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending == ".png"
             ? ""
             : fmt::format("{}: a PNG file is written; accepted: a name that ends in .png",
                           printable(name));
}

CLI::App* add_picture(CLI::App& app, Request& request, const std::string& name,
                      const std::string& what, const std::string& input) {
  CLI::App* picture = app.add_subcommand(name, what);
  picture->add_option(input, request.inputs, "the file to read")->required();
  picture->add_option("--out", request.out, "the PNG file to write")->required()->check(png_name);
  picture
      ->add_option("--compression", request.compression,
                   "of the PNG file; less is faster and makes a larger file")
      ->check(CLI::Range(0, 9))
      ->capture_default_str();
  picture->add_flag("--half", request.half, "half as wide and high: a fifth of the file");
  picture->add_flag("--check-layout", request.check_layout,
                    "fail where a text is too small, leaves the page, or overlaps another one");
  return picture;
}

std::vector<Surface> titled(const Request& request) {
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < request.inputs.size(); ++i)
    surfaces.push_back({request.inputs[i], i < request.titles.size() ? request.titles[i] : ""});
  return surfaces;
}

/// For --help: what a curve may be called.
std::string keys() {
  return fmt::format(
      "Keys of curves, each with its colour, marker and name: {}.\nAny other word is drawn in a "
      "look of its own, and a "
      "line on standard error says so.",
      fmt::join(known_keys(), "; "));
}

void default_name(std::string& name, const std::string& column) {
  if (name.empty()) name = column;
}

}  // namespace

void add_pictures(CLI::App& app, Request& request) {
  auto* domain =
      add_picture(app, request, "domain", "a labelled domain (Figures 1, 2)", "OUTLINE.csv");
  domain->add_option("--title", request.title, "above the picture");
  domain->callback(
      [&] { request.draw = [&] { return domain_picture(request.inputs.at(0), request.title); }; });

  auto* mesh =
      add_picture(app, request, "mesh", "a mesh with its groups (Figures 3, 6)", "MESH.msh");
  mesh->add_option("--title", request.title, "above the picture");
  mesh->callback(
      [&] { request.draw = [&] { return mesh_picture(request.inputs.at(0), request.title); }; });

  auto* surface =
      add_picture(app, request, "surface",
                  "solutions as surfaces, side by side (Figures 4, 5, 7, 8)", "SOLUTION.vtu");
  surface->add_option("--title", request.titles, "one title per solution");
  surface
      ->add_option("--range", request.range,
                   "smallest and largest u of the scale (default: the data's; -0.25 0.25 in the "
                   "paper's figures)")
      ->expected(2);
  surface
      ->add_option("--last-range", request.own_range,
                   "draw the last surface on this scale of its own")
      ->expected(2);
  surface->add_option("--last-name", request.own_name, "what that scale measures")
      ->capture_default_str();
  surface->add_option("--height", request.height_factor, "length drawn for one unit of u")
      ->check(CLI::Range(0.01, 100.0));
  surface
      ->add_option("--grid", request.grid,
                   "draw lines x, y = k / GRID in place of the mesh's edges")
      ->check(CLI::Range(1, 256));
  surface->add_flag("--no-regions", request.no_regions,
                    "do not name body and layer, which meet at y = 0");
  surface->callback([&] {
    request.draw = [&] {
      if (request.height_factor &&
          std::isnan(*request.height_factor))  // NaN is in any range for CLI11
        throw Error("--height: nan; accepted: 0.01 to 100");
      SurfaceStyle style{.height_factor = request.height_factor};
      if (!request.range.empty()) style.range = Range{request.range[0], request.range[1]};
      if (request.grid > 0) style.grid = request.grid;
      if (!request.own_range.empty())
        style.last_range = {request.own_range[0], request.own_range[1]};
      style.last_name = request.own_name;
      style.regions = !request.no_regions;
      return surface_picture(titled(request), style);
    };
  });

  auto* cut = add_picture(app, request, "cut", "bodies of tetrahedra, cut open, side by side",
                          "SOLUTION.vtu");
  cut->add_option("--title", request.titles, "one title per solution");
  cut->add_option("--range", request.range,
                  "smallest and largest u of the colours (default: the data's)")
      ->expected(2);
  cut->add_option("--at", request.cut.at, "the y of the cut")->capture_default_str();
  cut->callback([&] {
    request.draw = [&] {
      if (!request.range.empty()) request.cut.range = Range{request.range[0], request.range[1]};
      return cut_picture(titled(request), request.cut);
    };
  });

  auto* plan =
      add_picture(app, request, "plan", "solutions seen from above, three per row", "SOLUTION.vtu");
  plan->add_option("--title", request.titles, "one title per solution");
  plan->add_option("--row-title", request.plan.row_titles, "one title per row");
  plan->add_option("--range", request.range,
                   "smallest and largest u of the colours (default: the data's)")
      ->expected(2);
  plan->add_option("--name", request.plan.name, "what the colours are")->capture_default_str();
  plan->add_option("--window", request.window,
                   "x from and to, y from and to (default: of the data)")
      ->expected(4);
  plan->callback([&] {
    request.draw = [&] {
      const auto& w = request.window;
      if (!request.range.empty()) request.plan.range = Range{request.range[0], request.range[1]};
      if (!w.empty()) request.plan.x = Range{w[0], w[1]}, request.plan.y = Range{w[2], w[3]};
      return plan_picture(titled(request), request.plan);
    };
  });

  auto* deformed =
      add_picture(app, request, "deformed", "deformed bodies, side by side", "SOLUTION.vtu");
  deformed->add_option("--title", request.titles, "one title per solution");
  deformed
      ->add_option("--range", request.range,
                   "smallest and largest value of the colours; default: the data's")
      ->expected(2);
  deformed->add_option("--name", request.deformed.name, "what the colours are")
      ->capture_default_str();
  deformed->add_option("--obstacle", request.deformed.obstacle, "table x,y of the line below them");
  deformed->callback([&] {
    request.draw = [&] {
      if (!request.range.empty())
        request.deformed.range = Range{request.range[0], request.range[1]};
      return deformed_picture(titled(request), request.deformed);
    };
  });

  auto* chart = add_picture(app, request, "chart",
                            "curves of a table on logarithmic scales (Figure 9)", "TABLE.csv");
  chart->add_option("--x", request.chart.x, "column of the x axis")->required();
  chart->add_option("--y", request.chart.y, "column of the y axis")->required();
  chart->add_option("--x-name", request.chart.x_name, "name of the axis (default: the column)");
  chart->add_option("--y-name", request.chart.y_name, "name of the axis (default: the column)");
  chart->add_option("--panel-by", request.chart.panel_by, "columns whose values make panels")
      ->delimiter(',');
  chart
      ->add_option("--series-by", request.chart.series_by,
                   "columns whose values make curves: keys, below")
      ->delimiter(',');
  chart->add_option("--only", request.chart.filters, "column=value: only these rows");
  chart->add_flag("--linear-y", request.chart.linear_y, "y on a straight scale");
  chart->add_option("--slope", request.chart.slopes, "lines of these slopes")->delimiter(',');
  chart->add_option("--title", request.chart.title, "above the picture");
  chart->footer(keys());
  chart->callback([&] {
    request.draw = [&] {
      default_name(request.chart.x_name, request.chart.x);
      default_name(request.chart.y_name, request.chart.y);
      return chart_picture(request.inputs.at(0), request.chart);
    };
  });

  auto* curves = add_picture(app, request, "curves",
                             "columns of a table as curves, straight scales", "TABLE.csv");
  curves->add_option("--x", request.curves.x, "column")->required();
  curves->add_option("--x-name", request.curves.x_name, "name of the axis (default: the column)");
  curves->add_option("--panel", request.curves.panels, "a panel: 'COLUMN COLUMN ...', - for none")
      ->required();
  curves->add_option("--y-name", request.curves.y_names,
                     "name of a panel's axis (default: its columns)");
  curves
      ->add_option("--curve", request.curves.meanings,
                   "what each curve is: a key, below, or 'KEY: more'; one per column")
      ->required();
  curves->add_option("--stems", request.curves.stems,
                     "panels (1, 2, ...) whose values stand alone");
  curves->add_flag("--jumps", request.curves.jumps, "break curves where they jump");
  curves->footer(keys());
  curves->callback([&] {
    request.draw = [&] {
      default_name(request.curves.x_name, request.curves.x);
      return curves_picture(request.inputs.at(0), request.curves);
    };
  });

  auto* map = add_picture(app, request, "map", "a quantity over two parameters, filled contours",
                          "TABLE.csv");
  map->add_option("--x", request.map.x, "column")->required();
  map->add_option("--y", request.map.y, "column")->required();
  map->add_option("--z", request.map.z, "column")->required();
  map->add_option("--x-name", request.map.x_name, "name of the axis (default: the column)");
  map->add_option("--y-name", request.map.y_name, "name of the axis (default: the column)");
  map->add_option("--z-name", request.map.z_name, "name of the quantity (default: the column)");
  map->add_option("--panel-by", request.map.panel_by, "columns whose values make panels")
      ->delimiter(',');
  map->add_option("--only", request.map.filters, "column=value: only these rows");
  map->add_option("--title", request.map.title, "above the picture");
  map->callback([&] {
    request.draw = [&] {
      default_name(request.map.x_name, request.map.x);
      default_name(request.map.y_name, request.map.y);
      default_name(request.map.z_name, request.map.z);
      return map_picture(request.inputs.at(0), request.map);
    };
  });

  auto* bars = add_picture(app, request, "bars", "stacked bars, one per row", "TABLE.csv");
  bars->add_option("--parts", request.bars.parts, "columns to stack")->delimiter(',')->required();
  bars->add_option("--bar-by", request.bars.bar_by, "columns that name a bar")
      ->delimiter(',')
      ->required();
  bars->add_option("--x-name", request.bars.x_name, "name of the axis");
  bars->add_option("--unit", request.bars.unit, "written behind the totals");
  bars->add_option("--only", request.bars.filters, "column=value: only these rows");
  bars->add_option("--title", request.bars.title, "above the picture");
  bars->callback(
      [&] { request.draw = [&] { return bar_picture(request.inputs.at(0), request.bars); }; });

  auto* convergence =
      add_picture(app, request, "convergence", "the convergence study (Figure 9)", "RESULTS.csv");
  convergence->add_option("--title", request.title, "above the picture");
  convergence->callback([&] {
    request.draw = [&] {
      return chart_picture(request.inputs.at(0), {"h",
                                                  "max",
                                                  "$h$",
                                                  "$L^∞(Ω)$ error",
                                                  {"element", "mesh"},
                                                  {"epsilon"},
                                                  {},
                                                  {1, 2},
                                                  request.title});
    };
  });
}

}  // namespace antilock::figures
