#pragma once
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "course/chapter.hpp"
#include "course/rubber.hpp"

namespace antilock::tutorial {

/// -p; on crossed triangles, which carry a checkerboard in every square, the mean over the
/// square.
inline Eigen::VectorXd pressure(const Rubber& rubber, const Solution& solution) {
  Eigen::VectorXd p = -solution.p;
  if (rubber.file == "p1_crossed")
    for (Eigen::Index square = 0; square < p.size() / 4; ++square)
      p.segment<4>(4 * square).setConstant(p.segment<4>(4 * square).mean());
  return p;
}

/// The deformed block with its pressure -lambda div u.
inline void write_block(const std::filesystem::path& out, const Rubber& rubber,
                        const VectorSpace& space, const Solution& solution) {
  write_deformed_vtu(out / (rubber.file + ".vtu"), space, solution.u,
                     pressure(rubber, solution));
  if (rubber.file == "p1_right") write_freefem_mesh(out / "mesh.freefem.msh", rubber.mesh);
}

/// Writes force.csv, and obstacle.csv of the picture; prints the tables of the chapter.
inline void show_rubber(const std::filesystem::path& out, const Table& checks,
                        const Table& forces, const Profile& gap) {
  checks.print("", 2);
  forces.filter("known", 1)
      .pivot("element", "lambda", "percent")
      .print("error of the contact force in %, by lambda");
  forces.pivot("element", "lambda", "corrections").print("corrections, by lambda");
  forces.select({"element", "lambda", "epsilon", "force", "corrections"})
      .write(out / "force.csv");
  Table obstacle({"x", "y"});
  for (int i = 0; i <= 40; ++i) obstacle.add({-0.1 + 0.03 * i, -gap(-0.1 + 0.03 * i)});
  obstacle.write(out / "obstacle.csv");
}

}  // namespace antilock::tutorial
