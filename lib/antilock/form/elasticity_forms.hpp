#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// Throws Error for a mesh in space. `who` is the beginning of the message.
void require_plane(const Mesh& mesh, const char* who);

/// The derivatives (u_x, u_y, v_x, v_y) of a displacement (u, v), in this order, or coefficients of
/// them.
using GradientCoefficients = Eigen::RowVector4d;

struct StrainTerm;

/// Lame's pair of an isotropic material (dimensionless): the energy density is mu eps:eps + lambda
/// (div u)^2 / 2.
struct Lame {
  double lambda = 0, mu = 1;
  /// Returns the 4 x 4 matrix of 2 mu eps(u):eps(v) + lambda div u div v between the derivatives of
  /// u and those of v.
  Eigen::Matrix4d matrix() const;
  /// Returns 4 mu (lambda + mu) / (lambda + 2 mu), the modulus of a thin sheet in plane strain. The
  /// stress in y vanishes if v_y = -lambda / (lambda + 2 mu) u_x. Then, without shear, the form is
  /// this modulus times u_x^2.
  double plane_strain_modulus() const { return 4 * mu * (lambda + mu) / (lambda + 2 * mu); }
  /// Returns the form of `matrix` as a sum of weighted squares of u_x, v_y, u_y + v_x and, where
  /// lambda is not 0, u_x + v_y.
  std::vector<StrainTerm> rows() const;
};

/// Returns the N x N matrix of the form int (grad u)' D grad v, where D is the 4 x 4 matrix `body`
/// or `layer` of the region and grad u has the four derivatives of u.
Eigen::SparseMatrix<double> strain_form(const VectorSpace& space,
                                        const Eigen::Matrix4d& body = Lame{}.matrix(),
                                        const Eigen::Matrix4d& layer = Lame{}.matrix());

/// A term weight * strain(u) strain(v) of a form, where strain is a combination of the derivatives.
struct StrainTerm {
  GradientCoefficients strain;
  double weight = 1;
};
/// Returns the factored form of sum_k weight_k int strain_k(u) strain_k(v) over one region, or over
/// all. There is a row of B per strain and point of strain_quadrature. Its entry of M is the
/// product of weight_k, the weight of the point and the area of the triangle.
FactoredForm strain_form_factored(const VectorSpace& space, const std::vector<StrainTerm>& strains,
                                  std::optional<Region> region = {});

/// Returns the same form as a WeightedFactoredForm: the weights are its `stiffness`, and M holds
/// only the quadrature weights.
WeightedFactoredForm stiff_strain_rows(const VectorSpace& space,
                                       const std::vector<StrainTerm>& strains,
                                       std::optional<Region> region = {});

/// Returns the factored form of int div u div v, the strain_form_factored of u_x + v_y. For P1 and
/// CR div u is constant on a triangle, which has one row then, with M its area.
FactoredForm divergence(const VectorSpace& space);

/// Returns the quadrature rule of these rows. On triangles it is exact for the square of a
/// derivative, of degree 2 (k - 1), k the higher degree of the two components. On quadrilaterals it
/// follows from Element::strain_degree.
const Quadrature& strain_quadrature(const VectorSpace& space);
/// Returns the quadrature rule of strain_form. It is strain_quadrature but for Q1-selective.
const Quadrature& gradient_quadrature(const VectorSpace& space);

/// Returns the N x N matrix of 2 mu weight sum_e |e|^-1 int_e [u].[v], mu = 1, over the interior
/// and the clamped edges e, for the components that are CR. [u] is the jump. Crouzeix-Raviart needs
/// this form with the symmetric gradient, because Korn's inequality does not hold for this element
/// without the form (P. Hansbo and M. G. Larson, ESAIM: M2AN 37, 2003). With clamped_in_x = false
/// the clamped edges prescribe the component y alone.
Eigen::SparseMatrix<double> jump_form(const VectorSpace& space, double weight,
                                      bool clamped_in_x = true);
/// Returns the same form in factors: a row of B per edge and component, with the modulus 2 mu
/// weight.
WeightedFactoredForm jump_rows(const VectorSpace& space, double weight, bool clamped_in_x = true);

}  // namespace antilock
