#include "antilock/form/elasticity_forms.hpp"

#include <algorithm>

#include "antilock/form/detail/strains.hpp"
#include "antilock/form/edge_forms.hpp"

namespace antilock {
namespace {

/// The step of the component across edge e at its first end (on the boundary: from the prescribed
/// midpoint value), as coefficients of the unknowns. A CR function is affine along the edge and
/// meets at the midpoint: at the other end it is the opposite.
std::vector<std::pair<int, double>> jump(const Space& space, int first, int e) {
  const TriangleMesh& mesh = space.mesh();
  std::vector<std::pair<int, double>> coefficients;
  for (int side = 0; side < 2; ++side) {
    const int t = mesh.edge_triangles(e, side);
    if (t < 0) continue;
    Eigen::Vector3d end = Eigen::Vector3d::Zero(), middle = end;
    for (int i = 0; i < 3; ++i) {
      if (mesh.triangles(t, i) == mesh.edges(e, 0)) end(i) = 1;
      if (mesh.triangle_edges(t, i) != e) middle(i) = 0.5;
    }
    const Eigen::VectorXd basis = space.element().basis(end) - space.element().basis(middle);
    for (int i = 0; i < 3; ++i)
      coefficients.emplace_back(first + space.cell_dofs()(t, i), side == 0 ? basis(i) : -basis(i));
  }
  return coefficients;
}

}  // namespace

void require_plane(const Mesh& mesh, const char* who) {
  if (mesh.dimension() != 2)
    throw Error(std::string(who) + ": a mesh of " + mesh.reference().plural +
                "; accepted: triangles or quadrilaterals");
}

const Quadrature& strain_quadrature(const VectorSpace& space) {
  return cell_rule(space.x.mesh().kind,
                   std::max(space.x.element().strain_degree(), space.y.element().strain_degree()));
}

const Quadrature& gradient_quadrature(const VectorSpace& space) {
  return cell_rule(space.x.mesh().kind, std::max(space.x.element().gradient_degree(),
                                                 space.y.element().gradient_degree()));
}

Eigen::Matrix4d Lame::matrix() const {
  const GradientCoefficients div(1, 0, 0, 1), shear(0, 1, 1, 0);
  return 2 * mu * Eigen::Vector4d(1, 0, 0, 1).asDiagonal().toDenseMatrix() +
         mu * shear.transpose() * shear + lambda * div.transpose() * div;
}

Eigen::SparseMatrix<double> strain_form(const VectorSpace& space, const Eigen::Matrix4d& body,
                                        const Eigen::Matrix4d& layer) {
  const TriangleMesh& mesh = space.x.mesh();
  const Gradients gradients(space, gradient_quadrature(space));
  return assemble_strains(space.size(), mesh.triangle_count(), [&](int t) {
    const Eigen::VectorXi unknown = gradients.unknowns(t);
    Eigen::MatrixXd local = Eigen::MatrixXd::Zero(unknown.size(), unknown.size());
    gradients.at_points(t, [&](double weight, double factor, const Eigen::Matrix4Xd& d) {
      local +=
          weight * factor * d.transpose() * (mesh.region[t] == Region::body ? body : layer) * d;
    });
    return std::pair(unknown, local);
  });
}

FactoredForm strain_form_factored(const VectorSpace& space, const std::vector<StrainTerm>& strains,
                                  std::optional<Region> region) {
  const TriangleMesh& mesh = space.x.mesh();
  const Gradients gradients(space, strain_quadrature(space));
  FactoredFormBuilder rows;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (region && mesh.region[t] != *region) continue;
    const Eigen::VectorXi unknown = gradients.unknowns(t);
    gradients.at_points(t, [&](double weight, double factor, const Eigen::Matrix4Xd& d) {
      for (const StrainTerm& row : strains) {
        const Eigen::RowVectorXd strain = row.strain * d;
        rows.add(t, row.weight * weight * factor);
        for (Eigen::Index i = 0; i < unknown.size(); ++i)
          if (strain(i) != 0) rows.put(unknown(i), strain(i));
      }
    });
  }
  return rows.form(space.size());
}

std::vector<StrainTerm> Lame::rows() const {
  std::vector<StrainTerm> all{{{1, 0, 0, 0}, 2 * mu}, {{0, 0, 0, 1}, 2 * mu}, {{0, 1, 1, 0}, mu}};
  if (lambda > 0) all.push_back({{1, 0, 0, 1}, lambda});
  return all;
}

WeightedFactoredForm stiff_strain_rows(const VectorSpace& space,
                                       const std::vector<StrainTerm>& strains,
                                       std::optional<Region> region) {
  std::vector<StrainTerm> unweighted = strains;
  Eigen::VectorXd weights(static_cast<Eigen::Index>(strains.size()));
  for (std::size_t i = 0; i < strains.size(); ++i) {
    weights(static_cast<Eigen::Index>(i)) = strains[i].weight;
    unweighted[i].weight = 1;
  }
  FactoredForm form = strain_form_factored(space, unweighted, region);
  Eigen::VectorXd stiffness = weights.replicate(form.m.size() / weights.size(), 1);
  return {std::move(form), std::move(stiffness)};
}

FactoredForm divergence(const VectorSpace& space) {
  return strain_form_factored(space, {{{1, 0, 0, 1}}});
}

namespace {

/// act(edge, step of a component across it) for the interior edges and Dirichlet edges.
template <class Act>
void at_steps(const VectorSpace& space, bool clamped_in_x, Act&& act) {
  const TriangleMesh& mesh = space.x.mesh();
  for (const auto& [part, first] :
       {std::pair<const Space*, int>{&space.x, 0}, {&space.y, space.x.size()}}) {
    if (part->element().conforming()) continue;  // no steps
    require_triangles(mesh, "jumps of a displacement");
    if (part->element().equation().size() > 0) continue;  // Korn's inequality holds as it is
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const bool interior = mesh.edge_triangles(e, 1) >= 0;
      const bool dirichlet = is_dirichlet(mesh.edge_tag[e]) && (clamped_in_x || part == &space.y);
      if (interior || dirichlet) act(e, jump(*part, first, e));
    }
  }
}

}  // namespace

// |e|^-1 int_e of an affine function from s to -s squared: s^2 / 3; times 2 mu
Eigen::SparseMatrix<double> jump_form(const VectorSpace& space, double weight, bool clamped_in_x) {
  Triplets entries;
  at_steps(space, clamped_in_x, [&](int, const auto& step) {
    for (const auto& [i, a] : step)
      for (const auto& [j, b] : step) entries.emplace_back(i, j, 2 * weight * a * b / 3);
  });
  return from_triplets<SparseMatrix>(space.size(), space.size(), entries);
}

WeightedFactoredForm jump_rows(const VectorSpace& space, double weight, bool clamped_in_x) {
  FactoredFormBuilder rows;
  at_steps(space, clamped_in_x, [&](int e, const auto& step) {
    rows.add(space.x.mesh().edge_triangles(e, 0), 1.0 / 3);
    for (const auto& [i, a] : step) rows.put(i, a);
  });
  FactoredForm form = rows.form(space.size());
  Eigen::VectorXd stiffness = Eigen::VectorXd::Constant(form.m.size(), 2 * weight);
  return {std::move(form), std::move(stiffness)};
}

}  // namespace antilock
