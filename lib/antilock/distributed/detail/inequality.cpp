#include "antilock/distributed/detail/inequality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/distributed/ranks.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock::distributed {
namespace {

/// The same on every rank.
double penalty_over_all(RelativeStiffness s) {
  s.sum_0 = sum(s.sum_0), s.sum_1 = sum(s.sum_1);
  s.most_0 = largest(s.most_0), s.most_1 = largest(s.most_1);
  return choose_penalty(s);
}

long long layer_triangles(const TriangleMesh& mesh) {
  return std::count(mesh.region.begin(), mesh.region.end(), Region::layer);
}

}  // namespace

Inequality::Inequality(const Scene& scene, const Space& space, Penalty penalty) : rows_(space) {
  const bool here = layer_triangles(space.mesh()) > 0, somewhere = sum(layer_triangles(space.mesh())) > 0;
  together(
      [&] {  // a strip without a part of the layer (between the two feet of a body) has the body's part of the forms
        part_ = assemble(here || !somewhere ? scene : Scene(scene.body(), NoLayer{}, scene.contact()), space);
        lower_ = Eigen::VectorXd::Constant(rows_.owned(), -std::numeric_limits<double>::infinity());
        if (!scene.contact()) return;
        for (int place = 0; place < rows_.owned(); ++place) {
          if (rows_.on_contact()[rows_.unknown(place)] == 0) continue;
          const double x = space.points()(rows_.unknown(place), 0), gap = scene.contact()->gap(x);
          if (!std::isfinite(gap)) throw Error(fmt::format("contact: gap({:.6g}) is not finite", x));
          lower_(place) = -gap;
        }
      });
  const bool stiff = sum(static_cast<long long>(part_.m.size())) > 0;  // whether any rank has a row of B
  if (stiff) part_.compliance = largest(part_.m.size() > 0 ? part_.compliance : 0);
  const double rule =
      penalty_over_all(relative_stiffness(part_)) / (penalty == Penalty::loop ? tuned::next_penalty : 1);
  if (stiff) delta_ = penalty == Penalty::compliance ? part_.compliance : std::max(part_.compliance, rule);
  // B' M B is the layer's y-derivatives: the same form with weight delta^-1 on the layer is A1 + delta^-1 B' M B
  sum_k(stiff ? gradient_form(space, {1, 1}, {1, 1 / delta_}) : part_.a1);
}

/// The matrix of all ranks from the parts: room for every entry is counted first, since a matrix that must grow takes
/// many times the time of the rest.
void Inequality::sum_k(const SparseMatrix& part) {
  Eigen::VectorXd entries = Eigen::VectorXd::Zero(part.cols());
  for (Eigen::Index j = 0; j < part.cols(); ++j) entries(j) = static_cast<double>(part.col(j).nonZeros());
  const Vector counted = rows_.vector();
  rows_.summed(entries, counted);
  entries = Entries(counted);
  std::vector<PetscInt> own(rows_.owned(), 0), other(rows_.owned(), 0);
  for (int place = 0; place < rows_.owned(); ++place) {
    if (rows_.shared(rows_.unknown(place))) {  // how many of them coincide is not known: room for all
      other[place] = static_cast<PetscInt>(entries(place));
      own[place] = std::min<PetscInt>(other[place], rows_.owned());
      continue;
    }
    for (SparseMatrix::InnerIterator entry(part, rows_.unknown(place)); entry; ++entry) {
      const PetscInt column = rows_.row(static_cast<int>(entry.row()));
      if (column >= 0) ++(rows_.owns(column) ? own : other)[place];
    }
  }
  ok(MatCreateAIJ(PETSC_COMM_WORLD, rows_.owned(), rows_.owned(), PETSC_DETERMINE, PETSC_DETERMINE, 0, own.data(), 0,
                  other.data(), &k_));
  std::vector<PetscInt> columns;
  std::vector<PetscScalar> values;
  for (int unknown = 0; unknown < part.cols(); ++unknown) {
    columns.clear(), values.clear();
    for (SparseMatrix::InnerIterator entry(part, unknown); entry; ++entry) {  // symmetric: column = row
      if (entry.value() == 0) continue;  // across the long edge of a right angle: 7 entries become 5
      columns.push_back(rows_.row(static_cast<int>(entry.row())));
      values.push_back(entry.value());
    }
    const PetscInt row = rows_.row(unknown);  // PETSc passes over -1, here and among the columns
    ok(MatSetValues(k_, 1, &row, static_cast<PetscInt>(columns.size()), columns.data(), values.data(), ADD_VALUES));
  }
  ok(MatAssemblyBegin(k_, MAT_FINAL_ASSEMBLY)), ok(MatAssemblyEnd(k_, MAT_FINAL_ASSEMBLY));
}

Eigen::VectorXd Inequality::equilibrium(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
  return part_.load - part_.a1 * u - part_.b.transpose() * part_.m.cwiseProduct(p);
}

Eigen::VectorXd Inequality::compatibility(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
  return part_.compliance * p - part_.b * u;
}

Eigen::VectorXd Inequality::right_side(const Eigen::VectorXd& r1, const Eigen::VectorXd& r2) const {
  return r1 + part_.b.transpose() * part_.m.cwiseProduct(r2) / delta_;
}

Eigen::VectorXd Inequality::stress_step(const Eigen::VectorXd& du, const Eigen::VectorXd& r2) const {
  return (part_.b * du - r2) / delta_;
}

}  // namespace antilock::distributed
