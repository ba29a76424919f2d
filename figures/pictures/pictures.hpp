#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drawing/page.hpp"

namespace antilock::figures {

/// Figures 1 and 2: the labelled domain of a table `kind,name,label,x,y` (drawing.cpp). An empty title: none.
Page domain_picture(const std::filesystem::path& outline, const std::string& title);

/// Figures 3 and 6: a mesh file (MSH) with body, layer and boundary groups told apart by colour, and a legend.
Page mesh_picture(const std::filesystem::path& mesh, const std::string& title);

/// Extent of u that colours and heights stand for.
struct Range {
  double low, high;
};

/// What the surface pictures have in common; equal settings give equal scales and cameras, so that pictures compare.
struct SurfaceStyle {
  Range range{-0.25, 0.25};
  double height_factor = 2;              ///< units of length drawn for a unit of u
  std::optional<int> grid = {};          ///< draw lines x, y = k / grid instead of the mesh's edges (for fine meshes)
  std::optional<Range> last_range = {};  ///< the last surface (a difference, say) on a scale and colour bar of its own
  std::string last_name = "$u$";         ///< what that scale measures
};

struct Surface {
  std::filesystem::path solution;  ///< VTU with point data u
  std::string title;
};

/// Figures 4, 5, 7, 8: one solution, or several side by side (three a row), as surfaces of the same scale.
Page surface_picture(const std::vector<Surface>& surfaces, const SurfaceStyle& style);

/// Deformed bodies (VTU with cell data pressure) side by side on one scale, coloured by it; dashed: where they were.
struct DeformedStyle {
  Range range{0, 1};               ///< of the colours; values outside take the end's
  std::string name = "pressure";   ///< of the colours
  std::filesystem::path obstacle;  ///< table x,y of a line to draw below; empty: none
};
Page deformed_picture(const std::vector<Surface>& bodies, const DeformedStyle& style);

/// A chart on logarithmic scales from a table: a panel for each value of the columns `panel_by`, in it a curve for each
/// value of `series_by`. Points whose y is not finite or not positive are drawn as failed, above the curves.
struct ChartStyle {
  std::string x, y, x_name, y_name;
  std::vector<std::string> panel_by, series_by;
  std::vector<std::string> filters;  ///< `column=value`: only these rows
  std::vector<double> slopes;        ///< triangles of these orders in every panel
  std::string title;
  std::string x_least = "", x_most = "";  ///< columns: the spread of x, drawn as a bar; empty: none
  std::string colour_by = "";             ///< column: a colour a value, markers tell the rest; empty: a colour a series
};
Page chart_picture(const std::filesystem::path& table, const ChartStyle& style);

/// Columns of a table as curves over `x`, on straight scales, panels side by side.
struct CurvesStyle {
  std::string x, x_name;
  std::vector<std::string>
      panels;  ///< the columns of each, with spaces between; `-` leaves a place of the legend empty
  std::vector<std::string> y_names;  ///< one a panel
  std::vector<std::string> names;    ///< of the curves, for the legend, in the order of the columns
  bool truth_first = false;          ///< draw the first curve broad and pale, behind the others
};
Page curves_picture(const std::filesystem::path& table, const CurvesStyle& style);

/// Filled contours of log10 z over (x, y), both on logarithmic scales, half a decade a colour (a tenth where z spans
/// less than two); panels as in a chart. Rows whose x, y or z is not positive and finite are left out and leave holes.
struct MapStyle {
  std::string x, y, z, x_name, y_name, z_name;
  std::vector<std::string> panel_by, filters;
  std::string title;
};
Page map_picture(const std::filesystem::path& table, const MapStyle& style);

/// A stacked bar for each row: the shares of the columns `parts`, with the total above. Bars are named by the columns
/// `bar_by`; where the axis has a name, by the bare entry of the first of them.
struct BarStyle {
  std::vector<std::string> parts, bar_by, filters;
  std::string x_name, unit, title;
};
Page bar_picture(const std::filesystem::path& table, const BarStyle& style);

}  // namespace antilock::figures
