#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drawing/colour_bar.hpp"
#include "drawing/page.hpp"

namespace antilock::figures {

/// Draws Figures 1 and 2: the labelled domain of a table `kind,name,label,x,y` (domain.cpp). An
/// empty title: none.
Page domain_picture(const std::filesystem::path& outline, const std::string& title);

/// Draws Figures 3 and 6: a mesh file (MSH) with a colour for body, layer and each boundary group,
/// and a legend.
Page mesh_picture(const std::filesystem::path& mesh, const std::string& title);

/// The settings of a surface picture. Equal settings give equal scales and cameras, so that
/// pictures can be compared.
struct SurfaceStyle {
  std::optional<Range> range = {};  ///< the range of u; empty: that of the data
  /// Units of length that are drawn for one unit of u; empty: 2 with a `range`, and without one the
  /// range of the data is drawn 1 high.
  std::optional<double> height_factor = {};
  /// Draw lines x, y = k / grid instead of the edges of the mesh (for fine meshes).
  std::optional<int> grid = {};
  /// The range of the last surface, for example a difference, on a scale of its own; empty: none.
  std::optional<Range> last_range = {};
  std::string last_name = "$u$";  ///< the quantity on that scale
  /// Whether body, layer and Sigma are named where they meet at y = 0.
  bool regions = true;
};

struct Surface {
  std::filesystem::path solution;  ///< VTU with point data u
  std::string title;
};

/// Draws Figures 4, 5, 7 and 8: one solution, or several side by side, as surfaces on the same
/// scale. Up to four are drawn two per row, more than four three per row.
Page surface_picture(const std::vector<Surface>& surfaces, const SurfaceStyle& style);

/// The settings of a picture of bodies of tetrahedra that are cut open.
struct CutStyle {
  double at = 0.5;                  ///< the cut is the plane y = at; the half behind it is drawn
  std::optional<Range> range = {};  ///< the range of the colours; empty: that of the data
};
/// Draws bodies in space (VTU of tetrahedra with point data u) side by side, on one scale of
/// colours.
Page cut_picture(const std::vector<Surface>& bodies, const CutStyle& style);

/// The settings of a picture of solutions from above, three per row, in a window of the plane, on
/// one scale of colours.
struct PlanStyle {
  /// The range of the colours, and the window in x and y. Empty: the range of the data.
  std::optional<Range> range = {}, x = {}, y = {};
  std::string name = "$u$";  ///< the quantity on the scale of colours
  std::vector<std::string> row_titles;
};
Page plan_picture(const std::vector<Surface>& surfaces, const PlanStyle& style);

/// The settings of a picture of deformed bodies (VTU with cell data pressure) side by side on one
/// scale, coloured by the pressure. Dashed lines show the undeformed bodies.
struct DeformedStyle {
  /// The range of the colours; empty: that of the data. Values below and above it have a colour
  /// each.
  std::optional<Range> range = {};
  std::string name = "pressure";   ///< the quantity on the scale of colours
  std::filesystem::path obstacle;  ///< table x,y of a line that is drawn below; empty: none
};
Page deformed_picture(const std::vector<Surface>& bodies, const DeformedStyle& style);

/// The settings of a chart of a table on logarithmic scales. It has one panel per value of the
/// columns `panel_by`, and in it one curve per value of `series_by`, in the style of styles.cpp. A
/// column h has ticks at 1/2, 1/4, ... A run whose y is not finite or not positive has no solution.
/// A bar at the top of the panel shows its place.
struct ChartStyle {
  std::string x, y, x_name, y_name;
  std::vector<std::string> panel_by, series_by;
  std::vector<std::string> filters;  ///< `column=value`: only rows with this value
  std::vector<double> slopes;        ///< lines of these orders in every panel
  std::string title = {};
  bool linear_y = false;  ///< y on a linear scale
};
Page chart_picture(const std::filesystem::path& table, const ChartStyle& style);

/// The settings of a picture of columns of a table as curves over `x`, on linear scales, with
/// panels side by side.
struct CurvesStyle {
  std::string x, x_name;
  /// The columns of each panel, separated by spaces; `-`: this panel has no such curve.
  std::vector<std::string> panels;
  std::vector<std::string> y_names;  ///< one per panel
  /// The meanings of the curves, in the order of the columns: keys of styles.cpp.
  std::vector<std::string> meanings;
  /// The panels (1, 2, ...) with stems in place of lines, because their values are not connected.
  std::vector<int> stems;
  bool jumps = false;  ///< break a curve where it jumps
};
Page curves_picture(const std::filesystem::path& table, const CurvesStyle& style);

/// The settings of a picture of filled contours of log10 z over (x, y), both on logarithmic scales.
/// A colour is half a decade, or a tenth of one where z spans less than two decades. Panels and h
/// are as in a chart. Rows whose x, y or z is not positive and finite are left out and leave holes.
struct MapStyle {
  std::string x, y, z, x_name, y_name, z_name;
  std::vector<std::string> panel_by, filters;
  std::string title;
};
Page map_picture(const std::filesystem::path& table, const MapStyle& style);

/// The settings of a picture with a stacked bar for each row: the parts in the columns `parts`,
/// with the total above. The name of a bar consists of its entries in the columns `bar_by`. If the
/// axis has a name, it is the entry of the first of these columns alone.
struct BarStyle {
  std::vector<std::string> parts, bar_by, filters;
  std::string x_name, unit, title;
};
Page bar_picture(const std::filesystem::path& table, const BarStyle& style);

}  // namespace antilock::figures
