#pragma once
#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "antilock/measure/result.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

struct ContactZone {
  int points = 0;                  ///< contact unknowns
  int active = 0;                  ///< those in contact
  std::optional<double> from, to;  ///< the range of x of those in contact; empty if there are none
  /// In space: the range of y of those in contact. Empty in the plane.
  std::optional<std::pair<double, double>> y_range = {};
  /// The intervals of x in which this range begins and ends. The discrete problem bounds u at the
  /// contact unknowns alone, so it does not say where between two neighbours contact ends. Each
  /// interval lies between an end of the range and its neighbour outside, or the end of Gamma_C if
  /// there is no neighbour. It is no bound of the error against the exact zone. Both are empty in
  /// space, where the unknowns beside a zone are not its neighbours in x.
  std::optional<std::pair<double, double>> from_within, to_within;
};
/// Returns the contact zone of a solution. The space of `result` must be that of the bounded
/// component, with one bound per unknown on Gamma_C, the contact boundary. Throws Error for another
/// space, for bounds on constraints, which have no point, and for friction.
ContactZone contact_zone(const Result& result);
/// Returns the contact zone of unknowns at the places x (C, ascending), with their marks (C), on a
/// Gamma_C that reaches from `ends.first` to `ends.second`.
ContactZone contact_zone(const Eigen::VectorXd& x, const std::vector<bool>& active,
                         const std::pair<double, double>& ends);

/// Returns the smallest and the largest x of the edges with a tag, by default those of Gamma_C;
/// infinity and minus infinity where the mesh has no such edge.
std::pair<double, double> contact_ends(const TriangleMesh& mesh, EdgeTag tag = EdgeTag::contact);

/// The resultant of the forces of the obstacles on the body, in the plane per unit length of the
/// third direction. Its unit is that of the body force f times length^2, in space times length^3.
struct ContactForce {
  /// The sum of all lambda_i, upwards: int p for the contact pressure p (contact_table). Above 0 an
  /// obstacle below pushes, below 0 one above.
  double normal = 0;
  /// The sum of the forces of friction, to the right; empty without friction.
  std::optional<double> tangential = {};
  /// The sum of all lambda_i x_i, int x p, in the unit of f times length^3, in space length^4. It
  /// is the moment about the point of the contact line with x = 0, anticlockwise, since friction
  /// acts along this line. In space it is minus the moment about the axis y.
  double moment = 0;
  /// The sum of all lambda_i y_i, int y p, in space: the moment about the axis x. Empty in the
  /// plane.
  std::optional<double> moment_y = {};
};
/// Returns normal force and moments of a solution: the work of the discrete contact forces on the
/// displacements 1, x and y, without a quadrature error, since each element has affine functions
/// with their values at the places of the unknowns. Forces at prescribed unknowns, such as the
/// clamped ends of Gamma_C, are not contained. Throws Error as contact_zone does.
ContactForce contact_force(const Result& result);

/// Returns the length of Gamma_C that belongs to each contact unknown: the length of its edge for
/// CR, and half of the lengths of its two edges for P1. lambda divided by it is the contact
/// pressure as a density (force per length). In space it is an area: that of its face for CR, and a
/// third of the areas of its faces for P1. Throws Error for P2 in space: its functions of vertices
/// have mean 0 on a face, so that their forces are no pressures.
Eigen::VectorXd contact_lengths(const Space& space);

/// Returns a row per contact unknown (C x 3, in space C x 4): x, in space also y, the distance to
/// the nearer bound, and the contact pressure (a density), >= 0 at a lower bound and <= 0 at an
/// upper one. Throws Error as contact_zone and contact_lengths do.
Eigen::MatrixXd contact_table(const Result& result);

}  // namespace antilock
