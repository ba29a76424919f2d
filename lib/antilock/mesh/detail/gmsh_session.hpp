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

/// gmsh's one global model, from its initialisation to its end, whatever is thrown in between. The library of gmsh is
/// loaded when the first session starts, not when a program does: with all that it needs (93 libraries) that takes 0.1
/// s, and most programs never ask for an unstructured mesh. Its C functions are called, which have no mangled names.
///
/// gmsh has one model and one set of options per process. A session of another thread waits until this one has ended.
/// The process keeps its locale and its environment. Where its program uses gmsh itself, from this thread, its models
/// and options are the same after the session as before.
class GmshSession {
 public:
  /// Throws Error where gmsh's library cannot be loaded.
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// Calls one of gmshc.h's functions by its type and its name, with all its arguments but the last one (int* ierr):
  /// `gmsh.call<decltype(gmshModelMeshGenerate)>("gmshModelMeshGenerate", 2)`. Throws Error where gmsh reports a
  /// failure.
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
  /// A point at (x, y) around which edges are `size` long; its tag.
  int add_point(double x, double y, double size) const;
  /// A line between two points; its tag.
  int add_line(int from, int to) const;
  /// A plane surface inside four lines that follow each other, -line for one that is run through backwards.
  void add_surface(std::array<int, 4> lines) const;
  /// Makes triangles of the geometry, surface by surface.
  std::pair<Points, Triples> generate() const;

  /// The tags of a geometry's curves. Throws Error where gmsh cannot read it.
  std::vector<int> read_curves(const Geometry& geometry);
  /// The points of a curve that are nearest to some points, three coordinates each.
  std::vector<double> nearest(int curve, std::vector<double> xyz) const;

 private:
  /// The session's turn, and the locale that its thread has afterwards.
  struct Turn {
    Turn();
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    std::lock_guard<std::mutex> alone;
    void* locale;
  };

  void read(const Geometry& geometry);
  static void* symbol(const char* name);
  /// The name of gmsh's current model; empty where gmsh is not initialised.
  static std::optional<std::string> current_model();
  void check(int failed, const char* name) const;

  Turn turn_;
  std::optional<std::string> callers_model_;
  std::vector<std::pair<std::string, double>> callers_options_;
};

}  // namespace antilock
