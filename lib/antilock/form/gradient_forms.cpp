// The forms of (23), integrals of products of gradients; its load; the norm.
#include "antilock/form/gradient_forms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/factored_form.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/cell_map.hpp"
#include "antilock/space/space.hpp"

namespace antilock {
namespace {

/// The derivatives of the basis at the points of a rule, which are the same on every cell.
template <CellKind kind>
std::vector<Eigen::Matrix<double, Eigen::Dynamic, reference_cell(kind).coordinates>> derivatives_at(
    const Element& element, const Quadrature& rule) {
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, reference_cell(kind).coordinates>> derivatives;
  for (const auto point : rule.points.rowwise()) derivatives.push_back(element.derivative(point));
  return derivatives;
}

/// act(q, factor, gradients of xi) at the points of a rule on cell t. On a simplex the map is
/// evaluated once.
template <CellKind kind, class Act>
void at_rule_points(const Mesh& mesh, int t, const Quadrature& rule, Act&& act) {
  const CellMap<kind> map(mesh, t);
  auto here = map.at(rule.points.row(0).transpose());
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    if constexpr (!reference_cell(kind).simplex) here = map.at(rule.points.row(q).transpose());
    act(q, here.factor, here.gradient);
  }
}

/// weight * (stiffness.x sum over the axes along the layer + stiffness.y across it) of d_k phi_i
/// d_k phi_j.
template <class Local, class Gradient>
void add_squares(Local& matrix, double weight, const Stiffness& stiffness,
                 const Gradient& gradient) {
  if constexpr (Gradient::ColsAtCompileTime == 3)
    matrix += weight * stiffness.x * gradient.col(0) * gradient.col(0).transpose() +
              weight * stiffness.x * gradient.col(1) * gradient.col(1).transpose() +
              weight * stiffness.y * gradient.col(2) * gradient.col(2).transpose();
  else
    matrix += weight * stiffness.x * gradient.col(0) * gradient.col(0).transpose() +
              weight * stiffness.y * gradient.col(1) * gradient.col(1).transpose();
}

template <CellKind kind>
Eigen::SparseMatrix<double> gradient_form_on(const Space& space,
                                             const std::vector<Stiffness>& of_triangle) {
  [[maybe_unused]] constexpr int n = reference_cell(kind).vertices,
                                 d = reference_cell(kind).dimension;
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature& rule = gradient_quadrature(element);
  const auto derivatives = derivatives_at<kind>(element, rule);
  if constexpr (reference_cell(kind).simplex)
    if (element.degree() == 1) {  // one point, matrices of a fixed size
      const Eigen::Matrix<double, n, n> derivative = derivatives[0];
      return assemble_cells(space, [&](int t) {
        const auto here = CellMap<kind>(mesh, t).at(CellMap<kind>::Coordinates::Zero());
        const Eigen::Matrix<double, n, d> gradient = derivative * here.gradient;
        Eigen::Matrix<double, n, n> matrix = Eigen::Matrix<double, n, n>::Zero();
        add_squares(matrix, here.factor, of_triangle[t], gradient);
        return matrix;
      });
    }
  return assemble_cells(space, [&](int t) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(element.dofs(), element.dofs());
    at_rule_points<kind>(
        mesh, t, rule, [&](Eigen::Index q, double factor, const auto& coordinates) {
          const Eigen::Matrix<double, Eigen::Dynamic, d> gradient = derivatives[q] * coordinates;
          add_squares(matrix, rule.weights(q) * factor, of_triangle[t], gradient);
        });
    return matrix;
  });
}

template <CellKind kind>
WeightedFactoredForm gradient_rows_on(const Space& space,
                                      const std::vector<Stiffness>& of_triangle) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = gradient_quadrature(space.element());
  const auto derivatives = derivatives_at<kind>(space.element(), rule);
  FactoredFormBuilder rows;
  std::vector<double> moduli;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    at_rule_points<kind>(
        mesh, t, rule, [&](Eigen::Index q, double factor, const auto& coordinates) {
          for (int axis = 0; axis < mesh.dimension(); ++axis) {
            const double modulus = axis < mesh.vertical() ? of_triangle[t].x : of_triangle[t].y;
            if (!(modulus > 0)) continue;
            rows.add(t, rule.weights(q) * factor);
            moduli.push_back(modulus);
            const Eigen::VectorXd derivative = derivatives[q] * coordinates.col(axis);
            for (Eigen::Index i = 0; i < derivative.size(); ++i)
              rows.put(space.cell_dofs()(t, i), derivative(i));
          }
        });
  return {rows.form(space.size()),
          Eigen::Map<const Eigen::VectorXd>(moduli.data(), Eigen::Index(moduli.size()))};
}

template <CellKind kind>
FactoredForm layer_strain_on(const Space& space,
                             const std::function<Eigen::Vector2d(int)>& direction) {
  using Coordinates = typename CellMap<kind>::Coordinates;
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature& rule = strain_quadrature(element);
  const auto points = rule.weights.size();
  const auto derivatives = derivatives_at<kind>(element, rule);
  Eigen::VectorXd across(element.dofs());
  FactoredForm strain;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer) strain.cell.insert(strain.cell.end(), points, t);
  const auto rows = static_cast<Eigen::Index>(strain.cell.size());
  strain.m.resize(rows);
  strain.b.resize(rows, space.size());
  strain.b.reserve(Eigen::VectorXi::Constant(rows, element.dofs()));
  for (Eigen::Index r = 0; r < rows; ++r) {
    const int t = strain.cell[r];
    const Eigen::Index q = r % points;
    const auto here = CellMap<kind>(mesh, t).at(rule.points.row(q).transpose());
    strain.m(r) = rule.weights(q) * here.factor;
    Coordinates slope = here.gradient.col(mesh.vertical());
    if constexpr (CellMap<kind>::d == 2)
      if (direction) slope = here.gradient * direction(t);
    across.noalias() = derivatives[q] * slope;
    for (Eigen::Index i = 0; i < across.size(); ++i)
      strain.b.insert(r, space.cell_dofs()(t, i)) = across(i);
  }
  strain.b.makeCompressed();
  return strain;
}

template <CellKind kind>
Eigen::VectorXd load_vector_on(const Space& space, const Field& f, Region region) {
  constexpr int n = reference_cell(kind).vertices, d = reference_cell(kind).dimension;
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = load_rule(space.element());
  const Eigen::Index count = rule.weights.size();
  Eigen::Matrix<double, n, Eigen::Dynamic> shape(n, count);  // N_i at the points
  Eigen::MatrixXd weighted(space.element().dofs(),
                           count);  // the basis at the points, times their weights
  for (Eigen::Index q = 0; q < count; ++q) {
    shape.col(q) = vertex_functions<kind>(rule.points.row(q).transpose());
    weighted.col(q) = rule.weights(q) * space.element().basis(rule.points.row(q));
  }
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size()), values(count), local(weighted.rows());
  Eigen::Matrix<double, d, Eigen::Dynamic, Eigen::RowMajor> x(d, count);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    const CellMap<kind> map(mesh, t);
    x = map.corners().lazyProduct(shape);
    for (Eigen::Index q = 0; q < count; ++q) {
      if constexpr (d == 3)
        values(q) = f(x(0, q), x(1, q), x(2, q));
      else
        values(q) = f(x(0, q), x(1, q));
      if (!std::isfinite(values(q))) {
        const Eigen::VectorXd at = x.col(q);
        throw Error(fmt::format("load: f({:.6g}) is not finite",
                                fmt::join(at.data(), at.data() + d, ", ")));
      }
      if constexpr (!reference_cell(kind).simplex)
        values(q) *= map.at(rule.points.row(q).transpose()).factor;
    }
    const double measure = reference_cell(kind).simplex ? mesh.measure(t) : 1;
    local.noalias() = measure * weighted.lazyProduct(values);
    for (Eigen::Index i = 0; i < local.size(); ++i) load(space.cell_dofs()(t, i)) += local(i);
  }
  return load;
}

}  // namespace

double stiffness_on(const Field& of_body, const TriangleMesh& mesh, int triangle) {
  if (!of_body) return 1;
  const Eigen::Vector3d x = centroid(mesh, triangle);
  const double factor = of_body(x(0), x(1), x(2));
  if (!(factor > 0 && std::isfinite(factor)))
    throw Error(fmt::format("stiffness({:.6g}) = {}; accepted: a positive number",
                            fmt::join(x.data(), x.data() + mesh.dimension(), ", "), factor));
  return factor;
}

const Quadrature& strain_quadrature(const Element& element) {
  return cell_rule(element.kind(), element.strain_degree());
}

const Quadrature& gradient_quadrature(const Element& element) {
  return cell_rule(element.kind(), element.gradient_degree());
}

Eigen::SparseMatrix<double> gradient_form(const Space& space, const Stiffness& body,
                                          const Stiffness& layer) {
  std::vector<Stiffness> of_triangle;
  for (const Region region : space.mesh().region)
    of_triangle.push_back(region == Region::layer ? layer : body);
  return gradient_form(space, of_triangle);
}

Eigen::SparseMatrix<double> gradient_form(const Space& space,
                                          const std::vector<Stiffness>& of_triangle) {
  return with_kind(space.mesh().kind,
                   [&]<CellKind kind>() { return gradient_form_on<kind>(space, of_triangle); });
}

WeightedFactoredForm gradient_rows(const Space& space, const std::vector<Stiffness>& of_triangle) {
  return with_kind(space.mesh().kind,
                   [&]<CellKind kind>() { return gradient_rows_on<kind>(space, of_triangle); });
}

FactoredForm layer_strain(const Space& space,
                          const std::function<Eigen::Vector2d(int)>& direction) {
  return with_kind(space.mesh().kind,
                   [&]<CellKind kind>() { return layer_strain_on<kind>(space, direction); });
}

FactoredForm hourglass_form(const Space& space, const Stiffness& body, const Stiffness& layer) {
  constexpr CellKind kind = CellKind::quadrilateral;
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  if (mesh.kind != kind || !element.conforming())
    throw Error("hourglass form: the element " + element.name() + " on a mesh of " +
                mesh.reference().plural + "; accepted: Q1 on quadrilaterals");
  const Quadrature& rule = gradient_quadrature(q1());
  const Eigen::Vector4d h(1, -1, 1, -1);
  const ReferencePoint centre = Eigen::Vector2d(0.5, 0.5);
  const Eigen::Matrix<double, 4, 2> slopes = element.derivative(centre);
  FactoredFormBuilder rows;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Stiffness& stiffness = mesh.region[t] == Region::layer ? layer : body;
    double energy = 0;  // of S T, whose derivatives by s and t are 2 T and 2 S
    at_rule_points<kind>(mesh, t, rule, [&](Eigen::Index q, double factor, const auto& gradient) {
      const Eigen::RowVector2d of_st(4 * rule.points(q, 1) - 2, 4 * rule.points(q, 0) - 2);
      const Eigen::RowVector2d slope = of_st * gradient;
      energy += rule.weights(q) * factor *
                (stiffness.x * slope(0) * slope(0) + stiffness.y * slope(1) * slope(1));
    });
    rows.add(t, energy);
    const CellMap<kind> map(mesh, t);
    const Eigen::Matrix<double, 4, 2> gradient = slopes * map.at(centre).gradient;
    const Eigen::Vector4d part = 0.25 * (h - gradient * (map.corners() * h));
    for (int i = 0; i < 4; ++i) rows.put(space.cell_dofs()(t, i), part(i));
  }
  return rows.form(space.size());
}

const Quadrature& load_rule(const Element& element) {
  return cell_rule(element.kind(), std::max(5, 2 * element.degree()));
}

Eigen::VectorXd mean_load_vector(const Space& space, const Field& f, Region region,
                                 const Quadrature& rule) {
  const Element& element = space.element();
  if (element.nodal() || element.dofs_per_cell() != 1)
    throw Error("load on the means: element " + element.name() +
                " has no mean per triangle; accepted: BDM1-hybrid (hybrid_bdm1)");
  const TriangleMesh& mesh = space.mesh();
  const int mean = element.dofs() - 1;  // the unknown of the triangle is the last one
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double value = f(x(0), x(1));
      if (!std::isfinite(value))
        throw Error(fmt::format("load: f({:.6g}, {:.6g}) is not finite", x(0), x(1)));
      load(space.cell_dofs()(t, mean)) += mesh.area(t) * rule.weights(q) * value;
    }
  }
  return load;
}

Eigen::VectorXd load_vector(const Space& space, const Field& f, Region region) {
  return with_kind(space.mesh().kind,
                   [&]<CellKind kind>() { return load_vector_on<kind>(space, f, region); });
}

}  // namespace antilock
