#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drawing/colour_bar.hpp"
#include "drawing/page.hpp"

namespace antilock::figures {

/// Figures 1 and 2: the labelled domain of a table `kind,name,label,x,y` (drawing.cpp). An empty
/// title: none.
Page domain_picture(const std::filesystem::path& outline, const std::string& title);

/// Figures 3 and 6: a mesh file (MSH) with body, layer and boundary groups told apart by colour,
/// and a legend.
Page mesh_picture(const std::filesystem::path& mesh, const std::string& title);

/// What the surface pictures have in common; equal settings give equal scales and cameras, so that
/// pictures compare.
struct SurfaceStyle {
  std::optional<Range> range = {};  ///< empty: that of the data
  std::optional<double> height_factor =
      {};                        ///< units of length drawn for one unit of u; empty: 2, of the data's range 1 in all
  std::optional<int> grid = {};  ///< draw lines x, y = k / grid instead of the mesh's edges (for fine meshes)
  std::optional<Range> last_range = {};  ///< the last surface (a difference, say) on a scale of its own
  std::string last_name = "$u$";         ///< what that scale measures
};

struct Surface {
  std::filesystem::path solution;  ///< VTU with point data u
  std::string title;
};

/// Figures 4, 5, 7, 8: one solution, or several side by side (up to four two per row, more three
/// per row), as surfaces of the same scale.
Page surface_picture(const std::vector<Surface>& surfaces, const SurfaceStyle& style);

/// Solutions seen from above, three per row, in a window of the plane, on one scale of colours.
struct PlanStyle {
  std::optional<Range> range = {}, x = {}, y = {};  ///< empty: of the data
  std::string name = "$u$";                         ///< of the colours
  std::vector<std::string> row_titles;
};
Page plan_picture(const std::vector<Surface>& surfaces, const PlanStyle& style);

/// Deformed bodies (VTU with cell data pressure) side by side on one scale, coloured by it; dashed:
/// where they were.
struct DeformedStyle {
  std::optional<Range> range = {};  ///< of the colours; values outside have two of their own. Empty: that of the data
  std::string name = "pressure";    ///< of the colours
  std::filesystem::path obstacle;   ///< table x,y of a line to draw below; empty: none
};
Page deformed_picture(const std::vector<Surface>& bodies, const DeformedStyle& style);

/// A chart on logarithmic scales from a table: one panel per value of the columns `panel_by`, in it
/// one curve per value of `series_by`, each drawn as styles.cpp says. A column h has ticks at 1/2,
/// 1/4, ... Runs whose y is not finite or not positive gave no answer: a bar at the top of the
/// panel says where.
struct ChartStyle {
  std::string x, y, x_name, y_name;
  std::vector<std::string> panel_by, series_by;
  std::vector<std::string> filters;  ///< `column=value`: only these rows
  std::vector<double> slopes;        ///< lines of these orders in every panel
  std::string title = {};
  bool linear_y = false;  ///< y on a straight scale
};
Page chart_picture(const std::filesystem::path& table, const ChartStyle& style);

/// Columns of a table as curves over `x`, on straight scales, panels side by side.
struct CurvesStyle {
  std::string x, x_name;
  std::vector<std::string> panels;    ///< the columns of each, with spaces between; `-`: this panel has no such curve
  std::vector<std::string> y_names;   ///< one per panel
  std::vector<std::string> meanings;  ///< of the curves, in the order of the columns: keys of styles.cpp
  std::vector<int> stems;             ///< the panels (1, 2, ...) whose values stand alone: stems in place of lines
  bool jumps = false;                 ///< break a curve where it jumps
};
Page curves_picture(const std::filesystem::path& table, const CurvesStyle& style);

/// Filled contours of log10 z over (x, y), both on logarithmic scales, half a decade per colour (a
/// tenth where z spans less than two); panels and h as in a chart. Rows whose x, y or z is not
/// positive and finite are left out and leave holes.
struct MapStyle {
  std::string x, y, z, x_name, y_name, z_name;
  std::vector<std::string> panel_by, filters;
  std::string title;
};
Page map_picture(const std::filesystem::path& table, const MapStyle& style);

/// A stacked bar for each row: the shares of the columns `parts`, with the total above. Bars are
/// named by the columns `bar_by`; where the axis has a name, by the bare entry of the first of
/// them.
struct BarStyle {
  std::vector<std::string> parts, bar_by, filters;
  std::string x_name, unit, title;
};
Page bar_picture(const std::filesystem::path& table, const BarStyle& style);

}  // namespace antilock::figures
