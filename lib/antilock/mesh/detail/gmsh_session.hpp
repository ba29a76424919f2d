#pragma once
#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The one global model of gmsh, from its initialisation to its end, whatever is thrown in between.
/// The library of gmsh is loaded when the first session starts, not when a program starts. With the
/// 93 libraries that it needs this takes 0.1 s, and most programs never need an unstructured mesh.
/// The C functions of gmsh are called, because their names are not mangled.
///
/// gmsh has one model and one set of options per process. Therefore a session of another thread
/// waits until this one has ended. The process keeps its locale and its environment. If the program
/// uses gmsh itself, from this thread, its models and options are the same after the session as
/// before. The variables of its scripts are deleted where a geometry is read.
class GmshSession {
 public:
  /// Throws Error where gmsh's library cannot be loaded.
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Calls a function of gmshc.h by its type and its name, with all its arguments except for the
  /// last one (int* ierr): `gmsh.call<decltype(gmshModelMeshGenerate)>("gmshModelMeshGenerate",
  /// 2)`. Throws Error where gmsh reports a failure.
  template <class Function, class... Arguments>
  auto call(const char* name, Arguments... arguments) const {
    auto* const function = reinterpret_cast<Function*>(symbol(name));
    int failed = 0;
    if constexpr (std::is_void_v<decltype(function(arguments..., &failed))>) {
      function(arguments..., &failed);
      check(failed, name);
    } else {
      const auto result = function(arguments..., &failed);
      check(failed, name);
      return result;
    }
  }

  void set(const char* option, double value);
  /// Adds a point at (x, y, z) around which edges are `size` long. Returns its tag.
  int add_point(double x, double y, double size, double z = 0) const;
  /// Adds a line between two points. Returns its tag.
  int add_line(int from, int to) const;
  /// Adds a plane surface inside four lines that follow each other; a line in the opposite
  /// direction is given as -line. Returns its tag.
  int add_surface(std::array<int, 4> lines) const;
  /// Adds the volume inside six surfaces.
  void add_volume(std::array<int, 6> surfaces) const;
  /// Makes the triangles or quadrilaterals of the geometry, surface by surface, or its tetrahedra,
  /// volume by volume. Returns their vertices and corners.
  std::pair<Points, IndexRows> generate(CellKind kind = CellKind::triangle) const;

  /// Returns the tags of the curves of a geometry. Throws Error where gmsh cannot read it.
  std::vector<int> read_curves(const Geometry& geometry);
  /// Returns the points of a curve that are nearest to the given points, three coordinates each.
  std::vector<double> nearest(int curve, std::vector<double> xyz) const;

 private:
  /// Excludes sessions of other threads, and restores the locale of the thread at its end.
  struct Turn {
    Turn();
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    std::lock_guard<std::mutex> alone;
    void* locale;
  };

  void read(const Geometry& geometry);
  /// Keeps the numbers of the options that a script may change, for the end of the session.
  void keep_geometry_options();
  static void* symbol(const char* name);
  /// Returns the name of the current model of gmsh; empty where gmsh is not initialised.
  static std::optional<std::string> current_model();
  void check(int failed, const char* name) const;

  Turn turn_;
  std::optional<std::string> callers_model_;
  std::vector<std::pair<std::string, double>> callers_options_;
};

}  // namespace antilock
