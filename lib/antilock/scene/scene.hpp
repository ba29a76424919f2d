#pragma once
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "antilock/core/error.hpp"

namespace antilock {

using Field = std::function<double(double x, double y)>;  ///< a scalar field (dimensionless)
using Profile = std::function<double(double x)>;          ///< a function on the line y = const (dimensionless)

/// The elastic body Omega+ = (0,1) x (0,1), clamped on its sides and its top, under the body force f of (21).
struct Body {
  Field load;
  Field stiffness = {};  ///< positive, constant on each triangle: taken at its centroid; empty: 1
};

/// What holds on the edges of a named group of a mesh file: the outward derivative of u times the stiffness is 0 (free), g
/// (traction) or -k u (spring, k >= 0), or u itself is given (displacement).
struct BoundaryCondition {
  enum class Kind { free, displacement, traction, spring };
  std::string group;
  Kind kind = Kind::free;
  Field value = {};
};

/// An effect of a scene is a type; an effect that is absent brings no mesh, no unknown and no iteration.
struct NoLayer {};  ///< the body alone; contact, if any, on Sigma (y = 0)
/// The stiff layer after the change of variable, (23), on (0,1) x (-1,0).
struct StiffLayer {
  double epsilon;  ///< 0 <= epsilon <= 1: its thickness; exactly 0 is the limit problem (24) on the same mesh
  /// s > 0, stiffness times thickness, relative to the body: s stands before a_x^-, s / epsilon^2 before a_y^-
  double s = 1;
  Field load = {};  ///< a body force on the stretched layer; empty: none
};
/// The layer replaced by its limit (25): a second-derivative term on Sigma, no layer mesh.
struct VentcelLayer {};
/// The layer before the change of variable, (22), on (0,1) x (-epsilon,0).
struct ThinLayer {
  double epsilon;  ///< 1e-3 <= epsilon <= 1: below, the mesh of the true layer outgrows any use
};
using Layer = std::variant<NoLayer, StiffLayer, VentcelLayer, ThinLayer>;

/// Signorini contact on Gamma_C, the last line of (21): u >= -gap, pressure >= 0, complementary.
struct UnilateralContact {
  Profile gap = [](double) { return 0.0; };  ///< distance of the obstacle at x (negative: it presses in)
  std::vector<double> zero_at = {0, 1};  ///< where beside Gamma_C u = 0 is prescribed: gap, upper_obstacle >= 0 there
  Profile upper_obstacle = {};           ///< u <= upper_obstacle, too (a double obstacle problem); empty: none
};

/// An obstacle that no displacement keeps to, at some x.
struct ObstacleError : Error {
  enum class Obstacle { gap, ceiling };
  ObstacleError(Obstacle which, const std::string& message) : Error(message), which(which) {}
  Obstacle which;  ///< that at fault
};

/// Throws ObstacleError where the upper obstacle is below the lower one at x: no u satisfies -gap(x) <= u <= upper_obstacle(x).
void check_upper_obstacle(const UnilateralContact& contact, double x);

/// A scene (the description of a problem): a body, a layer or none, contact or not.
/// Construction throws Error where the combination is meaningless, with the reason.
class Scene {
 public:
  explicit Scene(Body body, Layer layer = NoLayer{}, std::optional<UnilateralContact> contact = std::nullopt,
                 std::vector<BoundaryCondition> edges = {});

  const Body& body() const { return body_; }
  const Layer& layer() const { return layer_; }
  const std::optional<UnilateralContact>& contact() const { return contact_; }
  /// Of the groups of its mesh (natural_group, dirichlet_group), in their order.
  const std::vector<BoundaryCondition>& edges() const { return edges_; }
  /// What goes beyond the paper's problem, in words, and what of it the certificate has no proof for; empty where nothing
  /// does.
  std::string beyond_the_paper() const;
  std::string beyond_the_certificate() const;
  /// Depth of the layer's mesh below Sigma: 0 (no mesh), 1 (scaled) or epsilon (thin).
  double layer_depth() const;
  /// The paper's epsilon; empty without a layer (0 for Ventcel).
  std::optional<double> epsilon() const;
  /// Names of the effects present, of "layer" and "contact".
  std::vector<std::string> effects() const;

 private:
  Body body_;
  Layer layer_;
  std::optional<UnilateralContact> contact_;
  std::vector<BoundaryCondition> edges_;
};

/// The load of every figure here, f = 10 sin(2 pi x); the paper gives none.
double paper_load(double x, double y);

}  // namespace antilock
