#pragma once
#include <cmath>
#include <map>

#include "antilock/analysis/locking.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "course/chapter.hpp"

namespace antilock::tutorial {

/// A discretisation of the coating: an element per component, on triangles in columns or on
/// arbitrary ones.
struct CoatedBlock {
  std::string name, file;
  bool columns;
  const Element &in_x, &in_y;
  bool locks;  ///< in the force
  TriangleMesh mesh(int cells) const {
    return with_free_sides(columns ? structured_mesh(cells) : unstructured_mesh(cells));
  }
};
inline std::vector<CoatedBlock> coated_blocks() {
  const Element &one = p1(), &cr = crouzeix_raviart();
  return {{"P1 / P1", "p1", false, one, one, true},
          {"P2 / P2", "p2", false, p2(), p2(), true},
          {"CR / P1", "cr_p1", false, cr, one, true},
          {"P1 / P1 in columns", "columns", true, one, one, false},
          {"P1 / CR", "p1_cr", false, one, cr, false},
          {"CR / CR", "cr", false, cr, cr, false}};
}

/// The contact force at the thicknesses of the chapter: P2 in columns, 96 cells per unit
/// side (64 differ by 3e-4 of it).
inline double reference(double t) {
  static const std::map<double, double> force{
      {1, 0.038752},    {1e-1, 0.072489}, {1e-2, 0.067059}, {1e-3, 0.066773},
      {1e-4, 0.066746}, {1e-5, 0.066743}, {1e-6, 0.066743}, {0, 0.066747}};
  return force.at(t);
}

/// What the force is off by at most, in h per cent, the worst over t: 1.4 times what is
/// seen on 32 cells.
inline double percent_per_h(const std::string& method) {
  static const std::map<std::string, double> most{
      {"P1 / P1 in columns", 55}, {"P1 / CR", 42}, {"CR / CR", 12}};
  return most.at(method);
}

/// The deformed block and its coating, stretched to depth 1, with the pressure -(stress in
/// y) per triangle.
inline void write_coating(const std::filesystem::path& out, const CoatedBlock& method,
                          const VectorSpace& space, const Solution& solution,
                          const Coating& scene) {
  if (method.file == "p1") write_freefem_mesh(out / "mesh.freefem.msh", space.x.mesh());
  if (method.file != "p1" && method.file != "cr") return;
  write_deformed_vtu(out / (method.file + ".vtu"), space, solution.u,
                     pressure(scene, space, solution.u, solution.p));
}

/// Prints the tables of the chapter; writes force.csv, and punch.csv of the picture.
inline void show_coating(const std::filesystem::path& out, const Table& forces,
                         const Table& diagnoses, int cells, const Profile& gap) {
  const Table finest = forces.filter("h", 1.0 / cells);
  finest.pivot("method", "t", "force").print("contact force, by t");
  finest.pivot("method", "t", "corrections").print("corrections, by t");
  diagnoses.select({"method", "says"}).print("diagnosis");
  finest.filter_number("t", [](double t) { return t > 0; })
      .select({"method", "t", "force"})
      .write(out / "force.csv");
  Table punch({"x", "y"});
  for (int i = 0; i <= 40; ++i) punch.add({-0.1 + 0.03 * i, -1 - gap(-0.1 + 0.03 * i)});
  punch.write(out / "punch.csv");
}

}  // namespace antilock::tutorial
