#include "antilock/form/strain_projection.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "antilock/core/error.hpp"
#include "antilock/form/sparse_assembly.hpp"

namespace antilock {
namespace {

void check_projection(const FactoredForm& form, const StrainProjection& projection) {
  if (projection.cols() != form.b.rows())
    throw Error(fmt::format("strain projection: weights of {} rows; accepted: of the {} rows of B",
                            projection.cols(), form.b.rows()));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(projection.cols());
  for (Eigen::Index g = 0; g < projection.rows(); ++g) {
    double own = 0;
    for (StrainProjection::InnerIterator weight(projection, g); weight; ++weight) {
      if (!(weight.value() >= 0))
        throw Error(fmt::format("strain projection: weight {} of row {}; accepted: 0 to 1",
                                weight.value(), weight.col()));
      sum(weight.col()) += weight.value();
      own += weight.value();
    }
    if (!(own > 0))
      throw Error(
          fmt::format("strain projection: mean {} has no row of B; accepted: at least one", g));
  }
  for (Eigen::Index r = 0; r < sum.size(); ++r)
    if (!(std::abs(sum(r) - 1) < 1e-12))
      throw Error(fmt::format("strain projection: the weights of row {} sum to {}; accepted: 1", r,
                              sum(r)));
}

void check_cells(const TriangleMesh& mesh, const FactoredForm& form) {
  for (const int t : form.cell)
    if (t < 0 || t >= mesh.triangle_count())
      throw Error(
          fmt::format("strain projection: a row of B in cell {} of a mesh of {}; accepted: the "
                      "mesh of the form",
                      t, mesh.triangle_count()));
}

}  // namespace

FactoredForm project_strain(const FactoredForm& form, const StrainProjection& projection) {
  check_projection(form, projection);
  FactoredForm mean;
  mean.m = projection * form.m;
  const StrainProjection weights = projection * form.m.asDiagonal();
  mean.b = weights * form.b;
  for (Eigen::Index g = 0; g < mean.b.rows(); ++g)
    for (RowMatrix::InnerIterator entry(mean.b, g); entry; ++entry) entry.valueRef() /= mean.m(g);
  if (!form.cell.empty())
    for (Eigen::Index g = 0; g < projection.rows(); ++g)
      mean.cell.push_back(form.cell[StrainProjection::InnerIterator(projection, g).col()]);
  return mean;
}

StrainProjection cell_projection(const FactoredForm& form) {
  Triplets entries;
  std::set<int> cells;
  for (std::size_t r = 0; r < form.cell.size(); ++r) {
    const bool next = r == 0 || form.cell[r] != form.cell[r - 1];
    if (next && !cells.insert(form.cell[r]).second)
      throw Error(
          fmt::format("cell_projection: the rows of cell {} of B do not follow each other; "
                      "accepted: the rows of a form cell by cell",
                      form.cell[r]));
    entries.emplace_back(static_cast<int>(cells.size()) - 1, static_cast<int>(r), 1.0);
  }
  return from_triplets<StrainProjection>(static_cast<Eigen::Index>(cells.size()), form.b.rows(),
                                         entries);
}

StrainProjection box_projection(const TriangleMesh& mesh, const FactoredForm& form, double width,
                                double height) {
  require_triangles(mesh, "box_projection");
  for (const double length : {width, height})
    if (!(length > 0 && std::isfinite(length)))
      throw Error(fmt::format("box_projection: a box of {} x {}; accepted: positive lengths", width,
                              height));
  const Eigen::RowVector2d from = mesh.vertices.colwise().minCoeff(),
                           size = mesh.vertices.colwise().maxCoeff() - from;
  if (!(width >= 1e-9 * size(0) && height >= 1e-9 * size(1)))
    throw Error(
        fmt::format("box_projection: a box of {} x {} of a mesh of {} x {}; accepted: a billionth "
                    "of it or more",
                    width, height, size(0), size(1)));
  check_cells(mesh, form);
  std::vector<std::pair<long, long>> box;
  for (const int t : form.cell) {
    const Eigen::Vector2d at =
        point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3)) - from.transpose();
    box.emplace_back(static_cast<long>(at(0) / width), static_cast<long>(at(1) / height));
  }
  // numbered in the order of their places, so that the means do not depend on the order of the rows
  std::map<std::pair<long, long>, int> mean;
  for (const auto& place : box) mean[place] = 0;
  int means = 0;
  for (auto& [place, number] : mean) number = means++;
  Triplets entries;
  for (std::size_t r = 0; r < box.size(); ++r)
    entries.emplace_back(mean[box[r]], static_cast<int>(r), 1.0);
  return from_triplets<StrainProjection>(means, form.b.rows(), entries);
}

StrainProjection vertex_projection(const TriangleMesh& mesh, const FactoredForm& form,
                                   const Quadrature& rule) {
  require_triangles(mesh, "vertex_projection");
  check_cells(mesh, form);
  const auto points = static_cast<std::size_t>(rule.weights.size());
  std::vector<int> mean(mesh.vertex_count(), -1);
  for (std::size_t r = 0; r < form.cell.size(); ++r) {
    if (form.cell.size() % points != 0 || form.cell[r] != form.cell[r - r % points] ||
        (r > 0 && r % points == 0 && form.cell[r] == form.cell[r - 1]))
      throw Error(
          fmt::format("vertex_projection: row {} of B is not a point of the rule of {} points per "
                      "cell; accepted: "
                      "the rule that the form was made with",
                      r, points));
    for (int i = 0; i < 3; ++i) mean[mesh.triangles(form.cell[r], i)] = 0;
  }
  int means = 0;
  for (int& number : mean)
    if (number == 0) number = means++;
  Triplets entries;
  for (std::size_t r = 0; r < form.cell.size(); ++r)
    for (int i = 0; i < 3; ++i)
      entries.emplace_back(mean[mesh.triangles(form.cell[r], i)], static_cast<int>(r),
                           rule.points(static_cast<Eigen::Index>(r % points), i));
  return from_triplets<StrainProjection>(means, form.b.rows(), entries);
}

}  // namespace antilock
