#pragma once
#include "antilock/form/factored_form.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The weights of a strain projection onto G means (G x R), with one row per mean and one column
/// per row of B. Weights are not negative, and each column sums to 1.
using StrainProjection = RowMatrix;

/// Returns the form of the projected strain, as in the B-bar method (T. J. R. Hughes, Int. J.
/// Numer. Methods Eng. 15, 1980). Row g of the new B is the mean of the rows r of B with the
/// weights projection(g, r) m(r), and the new M are the sums of these weights. With weights 0 and 1
/// the rows form groups, and the strain is projected in L2 onto the functions that are constant on
/// each group. With hat functions phi_g as weights the form is a mixed one: a row is (int phi_g
/// times the strain) / (int phi_g). By Jensen's inequality the new form is never larger than the
/// old one. The entry of `cell` for a mean is the first cell whose rows have a weight in this mean.
/// `cell` is empty if the form has no cells. Throws Error for another number of columns, a negative
/// weight, a column that does not sum to 1, and an empty row.
FactoredForm project_strain(const FactoredForm& form, const StrainProjection& projection);

/// Returns the projection onto one mean per cell that has rows of B, for a mesh of any kind: the
/// mean dilatation of Hughes' B-bar method, if the form is the divergence. The means stand in the
/// order of the cells in the form, which has one strain per quadrature point. The rows of a cell
/// must follow each other. On a convex quadrilateral the mean of a derivative of Q1 is its value at
/// the centre. So the projected form of Q1 is that of Q1-selective (tutorials/40_switches). Throws
/// Error for rows of a cell in two places.
StrainProjection cell_projection(const FactoredForm& form);

/// Returns the projection onto the means over the boxes of a grid that contain the centroid of a
/// cell. The boxes are `width` x `height` (lengths) and begin at the smallest x and y of the mesh.
/// Throws Error for a length that is not positive.
StrainProjection box_projection(const TriangleMesh& mesh, const FactoredForm& form, double width,
                                double height);

/// Returns the projection onto one weighted mean per vertex, over the cells that have this vertex.
/// The weight is the hat function of the vertex at the points of `rule`. The rows of a cell must
/// belong to the points of the rule, in their order. Throws Error otherwise.
StrainProjection vertex_projection(const TriangleMesh& mesh, const FactoredForm& form,
                                   const Quadrature& rule);

}  // namespace antilock
