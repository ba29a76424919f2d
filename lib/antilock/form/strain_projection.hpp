#pragma once
#include "antilock/form/factored_form.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The weights of a strain projection: a row per mean (G), a column per row of B (R). No weight is negative, and each
/// column sums to 1.
using StrainProjection = RowMatrix;

/// The form of the projected strain, as in the B-bar method (Hughes 1980). Row g of B is the mean of the rows of B
/// with the weights projection(g, r) m(r), and the new M are the sums of these weights. Weights 0 and 1 make groups:
/// the strain is projected in L2 onto constants per group. Hat functions as weights make a mixed form: a row is
/// (integral of phi_g times the strain) / (integral of phi_g). The new form is never larger than the old one (Jensen).
/// `cell` of a mean: the first cell that has a weight, or none where the form names none. Throws Error for weights
/// that do not fit: another number of columns, a negative one, a column that does not sum to 1, an empty row.
FactoredForm project_strain(const FactoredForm& form, const StrainProjection& projection);

/// A mean per box of the grid of `width` x `height` (lengths, positive; from the smallest x and y of the mesh on) that
/// has the centroid of a cell in it. Throws Error for a length that is not positive.
StrainProjection box_projection(const TriangleMesh& mesh, const FactoredForm& form, double width, double height);

/// A mean per vertex of the cells, over its patch, with its hat function at the points of `rule` as the weight: the
/// rows of a cell are those of the rule, in turn. Throws Error where they are not.
StrainProjection vertex_projection(const TriangleMesh& mesh, const FactoredForm& form, const Quadrature& rule);

}  // namespace antilock
