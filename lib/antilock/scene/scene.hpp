#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "antilock/core/error.hpp"

namespace antilock {

/// A function that may be empty: a pointer, or an object such as std::function. A lambda never is,
/// and compilers warn where it is asked.
template <class Function>
concept MayBeEmpty = std::is_pointer_v<Function> || requires(const Function& f) {
  f.operator bool();
};

/// A scalar field (dimensionless): a function of x, of x and y, or of x, y and z. It does not
/// depend on the coordinates that its function does not take. In the plane z is 0. A function that
/// can be called with different numbers of coordinates is one of x and y.
class Field {
 public:
  Field() = default;
  Field(std::nullptr_t) {}  ///< empty
  template <class Function>
  requires(!std::is_same_v<Function, Field> &&
           (std::is_invocable_r_v<double, Function&, double, double> ||
            std::is_invocable_r_v<double, Function&, double, double, double> ||
            std::is_invocable_r_v<double, Function&, double>)) Field(Function f) {
    if constexpr (MayBeEmpty<Function>)
      if (!f) return;  // an empty function is an empty field
    if constexpr (std::is_invocable_r_v<double, Function&, double, double>)
      value_ = OfPlane<Function>{std::move(f)};
    else if constexpr (std::is_invocable_r_v<double, Function&, double, double, double>)
      value_ = std::move(f);
    else
      value_ = OfLine<Function>{std::move(f)};
  }
  double operator()(double x, double y = 0, double z = 0) const { return value_(x, y, z); }
  explicit operator bool() const { return static_cast<bool>(value_); }
  /// Returns the function from which the field was made, if it is of this type, and a null pointer
  /// else.
  template <class Function>
  const Function* target() const {
    if (const auto* of_plane = value_.template target<OfPlane<Function>>()) return &of_plane->f;
    if (const auto* of_line = value_.template target<OfLine<Function>>()) return &of_line->f;
    return value_.template target<Function>();
  }

 private:
  template <class Function>
  struct OfPlane {
    Function f;
    double operator()(double x, double y, double) { return f(x, y); }
  };
  template <class Function>
  struct OfLine {
    Function f;
    double operator()(double x, double, double) { return f(x); }
  };
  std::function<double(double, double, double)> value_;
};
/// A function on a boundary y = const (dimensionless): a function of x. In space the boundary is
/// z = const, and the function is one of x and y.
using Profile = Field;

/// The elastic body Omega+ = (0,1) x (0,1) under the body force f of (21) of [SR04], which is cited
/// in problem/variational_inequality.hpp. It is clamped on its sides and its top. A mesh file may
/// give it another shape.
struct Body {
  Field load;
  /// The stiffness, which is positive. Each triangle has the value at its centroid. Empty: 1.
  Field stiffness = {};
};

/// The boundary condition on the edges of a named group of a mesh file, with du/dn the outward
/// derivative of u and g = `value`:
///
///     free           stiffness du/dn = 0
///     displacement   u = g
///     traction       stiffness du/dn = g
///     spring         stiffness du/dn = -g u,  g >= 0
struct BoundaryCondition {
  enum class Kind { free, displacement, traction, spring };
  std::string group;
  Kind kind = Kind::free;
  Field value = {};  ///< g(x, y); needed for each kind except free
};

// The effects of a scene are its layer and its contact. Each kind of effect is a type of its own.
// An effect that is absent adds no mesh, no unknown and no iteration.

/// The body alone. A contact, if there is one, is on Sigma, the lower side of the body (y = 0).
struct NoLayer {};
/// The stiff layer below Sigma after the change of variable, (23) of [SR04], on (0,1) x (-1,0).
struct StiffLayer {
  /// The thickness of the layer, 0 <= epsilon <= 1. 0 is the limit problem (24) on the same mesh.
  double epsilon;
  /// Stiffness times thickness of the layer, relative to the body; s > 0. The form a_x^- of (23)
  /// has the factor s, and a_y^- the factor s / epsilon^2.
  double s = 1;
  Field load = {};  ///< a body force on the stretched layer; empty: none
};
/// The limit (25) of the layer: a second-derivative term on Sigma and no layer mesh.
struct VentcelLayer {};
/// The layer before the change of variable, (22), on (0,1) x (-epsilon,0).
struct ThinLayer {
  /// 1e-3 <= epsilon <= 1, because the mesh of a thinner layer has too many triangles.
  double epsilon;
};
using Layer = std::variant<NoLayer, StiffLayer, VentcelLayer, ThinLayer>;

/// Signorini contact on Gamma_C, the bottom of the layer or, without a layer, Sigma. It is the last
/// line of (21): u >= -gap, pressure >= 0, and one of the two is an equality.
struct UnilateralContact {
  /// The distance of the obstacle at x, in space at (x, y). A negative one presses the obstacle
  /// into the body.
  Profile gap = [](double) { return 0.0; };
  /// The x at which u = 0 is prescribed at the ends of Gamma_C. There gap and upper_obstacle must
  /// be >= 0.
  std::vector<double> zero_at = {0, 1};
  /// A second bound, u <= upper_obstacle (a double obstacle problem); empty: none.
  Profile upper_obstacle = {};
};

/// Thrown where no displacement satisfies the obstacle at some x.
struct ObstacleError : Error {
  enum class Obstacle { gap, ceiling };
  ObstacleError(Obstacle which, const std::string& message) : Error(message), which(which) {}
  Obstacle which;  ///< the obstacle with the error
};

/// Throws ObstacleError where the upper obstacle is below the lower one at x, so that no u
/// satisfies -gap(x) <= u <= upper_obstacle(x).
void check_upper_obstacle(const UnilateralContact& contact, double x);

/// The description of a problem: a body, at most one layer, and at most one contact. Construction
/// throws Error, with the reason, where the combination is meaningless.
class Scene {
 public:
  explicit Scene(Body body, Layer layer = NoLayer{},
                 std::optional<UnilateralContact> contact = std::nullopt,
                 std::vector<BoundaryCondition> edges = {});

  const Body& body() const { return body_; }
  const Layer& layer() const { return layer_; }
  const std::optional<UnilateralContact>& contact() const { return contact_; }
  /// The conditions on the named groups of its mesh, in the order of the groups (natural_group,
  /// dirichlet_group).
  const std::vector<BoundaryCondition>& edges() const { return edges_; }
  /// beyond_the_paper names a feature that the problem of [SR04] does not have, and
  /// beyond_the_certificate a feature that the certificate does not cover. Each returns an empty
  /// text if there is none.
  std::string beyond_the_paper() const;
  std::string beyond_the_certificate() const;
  /// The depth of the layer's mesh below Sigma: 0 (no mesh), 1 (scaled) or epsilon (thin).
  double layer_depth() const;
  /// The epsilon of [SR04]: empty without a layer, 0 for Ventcel.
  std::optional<double> epsilon() const;
  /// Returns "layer" if there is a layer, and "contact" if there is contact.
  std::vector<std::string> effects() const;

 private:
  Body body_;
  Layer layer_;
  std::optional<UnilateralContact> contact_;
  std::vector<BoundaryCondition> edges_;
};

/// The load of all figures of this project, f = 10 sin(2 pi x). [SR04] does not state its load.
double paper_load(double x, double y);

}  // namespace antilock
