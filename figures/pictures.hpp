#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "page.hpp"

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
  double height_factor = 2;      ///< units of length drawn for a unit of u
  std::optional<int> grid = {};  ///< draw lines x, y = k / grid instead of the mesh's edges (for fine meshes)
};

struct Surface {
  std::filesystem::path solution;  ///< VTU with point data u
  std::string title;
  std::optional<Range> own_range = {};  ///< drawn on its own scale with its own colour bar (a difference, say)
};

/// Figures 4, 5, 7, 8: one solution, or several side by side, as surfaces of the same scale.
Page surface_picture(const std::vector<Surface>& surfaces, const SurfaceStyle& style);

/// A chart on logarithmic scales from a table: a panel for each value of the columns `panel_by`, in it a curve for each
/// value of `series_by`. Points whose y is not finite or not positive are drawn as failed, at the top edge.
struct ChartStyle {
  std::string x, y, x_name, y_name;
  std::vector<std::string> panel_by, series_by;
  std::vector<std::string> filters;  ///< `column=value`: only these rows
  std::vector<double> slopes;        ///< triangles of these orders in every panel
  std::string title;
};
Page chart_picture(const std::filesystem::path& table, const ChartStyle& style);

}  // namespace antilock::figures
