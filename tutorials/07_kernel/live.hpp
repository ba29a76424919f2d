// Behind 07_kernel.cpp: what the kernel on the layer leaves of sin πx on Γ_C, for one
// method.
#include <CLI/CLI.hpp>

std::string name = "P1", family = "structured";

void project_sine(const tutorial::Options& options, tutorial::Report&) {
  const Method method{&element(name), mesh_family(family)};
  const Space space = method.space(options.cells);
  const Eigen::MatrixXd basis = kernel_basis(stiff_part(assemble(scene, space)));
  const Eigen::VectorXd sine =
      (std::numbers::pi * space.dof_coordinates().col(0).array()).sin();
  const Eigen::VectorXd left = basis * (basis.transpose() * sine);
  Table points({"x", "left"});
  const bool clamped =
      method.element->conforming();  // in the corners; CR has no unknown there
  if (clamped) points.add({0.0, 0.0});
  for (const int i : space.contact_dofs())
    points.add({space.dof_coordinates()(i, 0), left(i)});
  if (clamped) points.add({1.0, 0.0});
  points.write(options.out / "points.csv");
  fmt::print("The kernel on this layer has {}. The library: {}.\n",
             basis.cols() == 1 ? "1 dimension" : fmt::format("{} dimensions", basis.cols()),
             diagnose(method).text());
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--element", name, "P1, P2, P3, P4 or CR");
    line.add_option("--mesh", family, "a family of meshes");
  };
  return tutorial::run(
      argc, argv, "figure_07_kernel", "what the kernel leaves of a sine",
      {.takes_epsilon = false, .cells = 8, .least_cells = 4, .most_cells = 16, .add = add},
      project_sine);
}
