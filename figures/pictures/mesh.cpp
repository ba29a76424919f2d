// The meshes of Figures 3 and 6.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/mesh/read_msh.hpp"
#include "drawing/panel.hpp"
#include "pictures/pictures.hpp"

namespace antilock::figures {
namespace {

/// The smallest angle of all triangles, in degrees.
double smallest_angle(const TriangleMesh& mesh) {
  double smallest = std::numbers::pi;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto corner = mesh.vertices.row(mesh.triangles(t, i));
      const Eigen::RowVector2d a = mesh.vertices.row(mesh.triangles(t, (i + 1) % 3)) - corner;
      const Eigen::RowVector2d b = mesh.vertices.row(mesh.triangles(t, (i + 2) % 3)) - corner;
      smallest =
          std::min(smallest, std::acos(std::clamp(a.dot(b) / (a.norm() * b.norm()), -1.0, 1.0)));
    }
  return smallest * 180 / std::numbers::pi;
}

struct Group {
  EdgeTag tag;
  Colour colour;
  std::string name;
};

const std::vector<Group>& boundary_groups() {
  static const std::vector<Group> groups{{EdgeTag::clamped, palette::ink, "clamped, $Γ_D$"},
                                         {EdgeTag::sigma, palette::green, "interface, $Σ$"},
                                         {EdgeTag::contact, palette::vermillion, "contact, $Γ_C$"}};
  return groups;
}

/// Legend: fills of the regions, strokes of the boundary groups, then what the mesh counts.
void draw_legend(Page& page, Point at, const TriangleMesh& mesh) {
  constexpr double size = 50, step = 92, swatch = 90;
  const auto entry = [&](const std::string& name) {
    page.text({at.x + swatch + 30, at.y}, name, {size, {0, Anchor::Height::middle}});
    at.y -= step;
  };
  const bool layered =
      std::find(mesh.region.begin(), mesh.region.end(), Region::layer) != mesh.region.end();
  const auto region = [&](const Colour& colour, const std::string& name) {
    const Box box{at.x, at.y - 24, swatch, 48};
    page.fill(box, colour);
    page.rectangle(box, {2});
    entry(name);
  };
  region(palette::body, "body, $Ω^+$");
  if (layered) region(palette::layer, "layer, $Ω^−$");
  for (const Group& group : boundary_groups()) {
    if (group.tag == EdgeTag::sigma && !layered) continue;
    page.line({at, {at.x + swatch, at.y}}, {11, group.colour});
    entry(group.name);
  }
  at.y -= 0.5 * step;
  for (const std::string& fact :
       {fmt::format("{} triangles", mesh.triangle_count()),
        fmt::format("{} vertices", mesh.vertex_count()), fmt::format("{} edges", mesh.edge_count()),
        fmt::format("longest edge $h =$ {:.4f}", mesh.diameter()),
        fmt::format("smallest angle {:.1f}°", smallest_angle(mesh))}) {
    page.text(at, fact, {size, {0, Anchor::Height::middle}});
    at.y -= 0.8 * step;
  }
}

}  // namespace

Page mesh_picture(const std::filesystem::path& file, const std::string& title) {
  const TriangleMesh mesh = read_msh(file.string());
  const Eigen::RowVector2d low = mesh.vertices.colwise().minCoeff(),
                           span = mesh.vertices.colwise().maxCoeff() - low;
  const double head = title.empty() ? 40 : 130, left = 180, foot = 150, right = 840,
               scale = (Page::width - left - right) / span.x();
  Page page(std::max(scale * span.y(), 1000.0) + foot + head);
  const auto pixel = [&](const Eigen::RowVector2d& p) {
    return Point{left + scale * (p.x() - low.x()), foot + scale * (p.y() - low.y())};
  };
  const auto vertex = [&](int v) { return pixel(mesh.vertices.row(v)); };

  for (int t = 0; t < mesh.triangle_count(); ++t)
    page.fill(
        {vertex(mesh.triangles(t, 0)), vertex(mesh.triangles(t, 1)), vertex(mesh.triangles(t, 2))},
        mesh.region[t] == Region::body ? palette::body : palette::layer);
  const double thin = std::clamp(0.06 * scale * mesh.diameter(), 0.7, 2.2);
  for (int e = 0; e < mesh.edge_count(); ++e)
    page.line({vertex(mesh.edges(e, 0)), vertex(mesh.edges(e, 1))}, {thin, {0.25, 0.25, 0.3}});
  for (const Group& group : boundary_groups())
    for (int e = 0; e < mesh.edge_count(); ++e)
      if (mesh.edge_tag[e] == group.tag) {
        const Point a = vertex(mesh.edges(e, 0)), b = vertex(mesh.edges(e, 1));
        const Point extra = (4 / length(b - a)) * (b - a);  // so that thick strokes meet at corners
        page.line({a - extra, b + extra}, {9, group.colour});
      }

  constexpr double size = number_size;
  const double bottom = low.y(), top = low.y() + span.y();
  for (const double x : {low.x(), low.x() + 0.5 * span.x(), low.x() + span.x()})
    page.text(pixel({x, bottom}) + Point{0, -28}, fmt::format("{:g}", x),
              {size, {0.5, Anchor::Height::top}});
  page.text(pixel({low.x() + 0.5 * span.x(), bottom}) + Point{0, -88}, "$x$",
            {1.1 * size, {0.5, Anchor::Height::top}});
  for (double y = std::ceil(2 * bottom) / 2; y <= top + 1e-9; y += 0.5)
    page.text(pixel({low.x(), y}) + Point{-22, 0},
              fmt::format("{}{:g}", y < 0 ? "−" : "", std::abs(y)),
              {size, {1, Anchor::Height::middle}});
  page.text(pixel({low.x(), 0.5 * (bottom + top)}) + Point{-112, 0.25 * scale}, "$y$",
            {1.1 * size, {0.5, Anchor::Height::middle}});
  draw_legend(page, {Page::width - right + 110, foot + scale * span.y() - 60}, mesh);
  if (!title.empty()) page.text({0.5 * Page::width, page.height() - 90.0}, title, {58, {0.5}});
  return page;
}

}  // namespace antilock::figures
