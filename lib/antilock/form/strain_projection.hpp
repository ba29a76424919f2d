#pragma once
#include "antilock/form/factored_form.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The weights of a strain projection onto means (G x R): a row per mean, a column per row of B.
/// Weights are not negative, and each column sums to 1.
using StrainProjection = RowMatrix;

/// Returns the form of the projected strain, as in the B-bar method (T. J. R. Hughes, Int. J.
/// Numer. Methods Eng. 15, 1980). Row g of the new B is the mean of the rows r of B with the
/// weights projection(g, r) m(r), and the new M are the sums of these weights. Weights 0 and 1 make
/// groups: the strain is projected in L2 onto constants per group. Hat functions phi_g as weights
/// make a mixed form: a row is (int phi_g times the strain) / (int phi_g). By Jensen's inequality
/// the new form is never larger than the old one. `cell` of a mean is the first cell with a weight
/// in it; it is empty where the form has no cells. Throws Error for another number of columns, a
/// negative weight, a column that does not sum to 1, and an empty row.
FactoredForm project_strain(const FactoredForm& form, const StrainProjection& projection);

/// Returns the projection onto the means over the boxes of a grid that contain the centroid of a
/// cell. The boxes are `width` x `height` (lengths) and begin at the smallest x and y of the mesh.
/// Throws Error for a length that is not positive.
StrainProjection box_projection(const TriangleMesh& mesh, const FactoredForm& form, double width, double height);

/// Returns the projection onto one weighted mean per vertex of the cells, over its patch. The
/// weight is the hat function of the vertex at the points of `rule`: the rows of a cell are the
/// points of the rule, in turn. Throws Error where they are not.
StrainProjection vertex_projection(const TriangleMesh& mesh, const FactoredForm& form, const Quadrature& rule);

}  // namespace antilock
