#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// The derivatives (u_x, u_y, v_x, v_y) of a displacement (u, v), in this order, or coefficients of them.
using GradientCoefficients = Eigen::RowVector4d;

struct StrainTerm;

/// Lame's pair of an isotropic material (dimensionless): the energy density is mu eps:eps + lambda (div u)^2 / 2.
struct Lame {
  double lambda = 0, mu = 1;
  /// 2 mu eps(u):eps(v) + lambda div u div v as a 4 x 4 matrix between the derivatives of u and those of v.
  Eigen::Matrix4d matrix() const;
  /// What the form leaves of u_x v_x where nothing pulls in y, v_y = -lambda / (lambda + 2 mu) u_x: the modulus of a thin
  /// sheet in plane strain, 4 mu (lambda + mu) / (lambda + 2 mu).
  double plane_strain_modulus() const { return 4 * mu * (lambda + mu) / (lambda + 2 * mu); }
  /// The same form as `matrix` as squares: u_x, v_y, u_y + v_x and, where lambda is not 0, u_x + v_y.
  std::vector<StrainTerm> rows() const;
};

/// N x N matrix of int D u : D v, with the 4 x 4 matrices `body` and `layer` between the derivatives on each region.
Eigen::SparseMatrix<double> strain_form(const VectorSpace& space, const Eigen::Matrix4d& body = Lame{}.matrix(),
                                        const Eigen::Matrix4d& layer = Lame{}.matrix());

/// A row of B: a combination of the derivatives, and the weight of its square.
struct StrainTerm {
  GradientCoefficients strain;
  double weight = 1;
};
/// The factored form of sum_k weight_k int strain_k(u) strain_k(v) over one region, or over all: at each point of
/// strain_quadrature a row of B per `strain`, M its weights times the area's.
FactoredForm strain_form_factored(const VectorSpace& space, const std::vector<StrainTerm>& strains,
                                  std::optional<Region> region = {});

/// The same with the weights beside M, as moduli.
WeightedFactoredForm stiff_strain_rows(const VectorSpace& space, const std::vector<StrainTerm>& strains,
                                       std::optional<Region> region = {});

/// The factored form of int div u div v: strain_form_factored of u_x + v_y. For P1 and CR div is constant on a
/// triangle: one row each, M its area.
FactoredForm divergence(const VectorSpace& space);

/// The rule behind the rows of a triangle: exact for the square of a derivative, 2 (k - 1) for the higher degree k of
/// the two components.
const Quadrature& strain_quadrature(const VectorSpace& space);

/// N x N matrix of 2 mu weight sum_e |e|^-1 int_e [u].[v], mu = 1, over the interior and the clamped edges, of the
/// components that are CR. Crouzeix-Raviart needs it with the symmetric gradient: there is no Korn inequality without
/// (Hansbo and Larson 2003). clamped_in_x = false: the clamped edges hold the component y alone.
Eigen::SparseMatrix<double> jump_form(const VectorSpace& space, double weight, bool clamped_in_x = true);
/// The same as rows: a step per edge and component, of the modulus 2 mu weight.
WeightedFactoredForm jump_rows(const VectorSpace& space, double weight, bool clamped_in_x = true);

}  // namespace antilock
