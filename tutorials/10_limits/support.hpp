#pragma once
// Three models of the layer on meshes, for chapter 10, and its files.
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// The largest difference of two columns in a row.
inline double most_apart(const Table& table, const std::string& one,
                         const std::string& other) {
  double apart = 0;
  for (const Table& row : table.rows())
    apart = std::max(apart, std::abs(row.number(one) - row.number(other)));
  return apart;
}

/// P1 on the structured mesh of a scene: with a layer of its depth, or without one.
inline Space p1_for(const Scene& scene, int cells) {
  return {structured_mesh(cells, Domain{scene.layer_depth()}), p1()};
}
inline Scene with_layer(const Layer& layer) {
  return Scene(Body{paper_load}, layer, UnilateralContact{});
}

/// u_h^0 of P1 on the two squares (epsilon = 0) against the discrete (25) on the body
/// alone: the largest difference.
inline double against_ventcel(int cells) {
  const Scene scaled = with_layer(StiffLayer{0}), ventcel = with_layer(VentcelLayer{});
  const Space both = p1_for(scaled, cells), body = p1_for(ventcel, cells);
  const Eigen::VectorXd u0 = active_set(assemble(scaled, both)).u,
                        u = active_set(assemble(ventcel, body)).u;
  return (u0.tail(u.size()) - u).cwiseAbs().maxCoeff();  // the body's rows come last
}

/// u on Gamma_C in three models: x, thin (22), scaled (23), limit (25); P1 on structured
/// meshes.
inline Table three_models(double epsilon, int cells) {
  std::vector<Eigen::VectorXd> u;
  for (const Layer& layer :
       {Layer(ThinLayer{epsilon}), Layer(StiffLayer{epsilon}), Layer(VentcelLayer{})}) {
    const Scene scene = with_layer(layer);
    const Space space = p1_for(scene, cells);
    u.push_back(active_set(assemble(scene, space)).u(space.contact_dofs()));
  }
  Table table({"x", "thin", "scaled", "limit"});
  table.add({0, 0, 0, 0});  // clamped
  for (int i = 1; i < cells; ++i)
    table.add({static_cast<double>(i) / cells, u[0](i - 1), u[1](i - 1), u[2](i - 1)});
  table.add({1, 0, 0, 0});
  return table;
}

/// way.csv (one row per quantity and epsilon), sigma.csv, models.csv.
inline void write_limits(const std::filesystem::path& out, const Table& way,
                         const Table& sigma, const Table& models) {
  Table quantities({"quantity", "epsilon", "value"});
  for (const auto& [name, column] :
       {std::pair{"$‖u^ε − u^0‖$", "distance"}, {"$ε^2 ‖p‖^2$", "stiff"}})
    for (const Table& row : way.rows())
      quantities.add({name, row.number("epsilon"), row.number(column)});
  quantities.write(out / "way.csv");
  sigma.write(out / "sigma.csv");
  models.write(out / "models.csv");
}

}  // namespace antilock::tutorial
