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

Inequality::Inequality(const Scene& scene, const MeshPart& piece, const Space& space, Penalty penalty)
    : rows_(piece, space) {
  const bool here = layer_triangles(piece.mesh) > 0, somewhere = sum(layer_triangles(piece.mesh)) > 0;
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
  stiff_ = sum(static_cast<long long>(part_.m.size())) > 0;
  if (stiff_) part_.compliance = largest(part_.m.size() > 0 ? part_.compliance : 0);
  const double rule =
      penalty_over_all(relative_stiffness(part_)) / (penalty == Penalty::loop ? tuned::next_penalty : 1);
  if (stiff_) delta_ = penalty == Penalty::compliance ? part_.compliance : std::max(part_.compliance, rule);
  // B' M B is the layer's y-derivatives: the same form with weight delta^-1 on the layer is A1 + delta^-1 B' M B
  if (stiff_)
    sum_k(gradient_form(space, {1, 1}, {1, 1 / delta_}));
  else
    sum_k(part_.a1);
}

/// The matrix of all ranks from the parts: room for every entry is counted first, since a matrix that must grow takes
/// many times the time of the rest.
void Inequality::sum_k(const SparseMatrix& part) {
  Eigen::VectorXd entries = Eigen::VectorXd::Zero(part.cols());
  for (Eigen::Index j = 0; j < part.cols(); ++j) entries(j) = static_cast<double>(part.col(j).nonZeros());
  const Vector counted = rows_.vector();
  rows_.summed(entries, counted);
  std::vector<PetscInt> own(rows_.owned(), 0), other(rows_.owned(), 0);
  const PetscScalar* all = nullptr;
  ok(VecGetArrayRead(counted, &all));
  for (int place = 0; place < rows_.owned(); ++place) {
    if (place < rows_.shared()) {  // how many of them coincide is not known: room for all
      own[place] = std::min(static_cast<PetscInt>(all[place]), static_cast<PetscInt>(rows_.owned()));
      other[place] = static_cast<PetscInt>(all[place]);
      continue;
    }
    for (SparseMatrix::InnerIterator entry(part, rows_.unknown(place)); entry; ++entry) {
      const int column = rows_.place(static_cast<int>(entry.row()));
      if (column >= 0) ++(column < rows_.owned() ? own : other)[place];
    }
  }
  ok(VecRestoreArrayRead(counted, &all));
  ok(MatCreateAIJ(PETSC_COMM_WORLD, rows_.owned(), rows_.owned(), PETSC_DETERMINE, PETSC_DETERMINE, 0, own.data(), 0,
                  other.data(), &k_));
  std::vector<PetscInt> columns;
  std::vector<PetscScalar> values;
  for (int place = 0; place < rows_.held(); ++place) {
    columns.clear(), values.clear();
    for (SparseMatrix::InnerIterator entry(part, rows_.unknown(place)); entry; ++entry) {  // symmetric: column = row
      const int column = rows_.place(static_cast<int>(entry.row()));
      if (column < 0 || entry.value() == 0) continue;  // 0 across the long edge of a right angle: 7 entries become 5
      columns.push_back(rows_.row(column));
      values.push_back(entry.value());
    }
    const PetscInt row = rows_.row(place);
    ok(MatSetValues(k_, 1, &row, static_cast<PetscInt>(columns.size()), columns.data(), values.data(), ADD_VALUES));
  }
  ok(MatAssemblyBegin(k_, MAT_FINAL_ASSEMBLY)), ok(MatAssemblyEnd(k_, MAT_FINAL_ASSEMBLY));
}

Eigen::VectorXd Inequality::equilibrium(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
  Eigen::VectorXd r = part_.load - part_.a1 * u;
  if (part_.m.size() > 0) r -= part_.b.transpose() * part_.m.cwiseProduct(p);
  return r;
}

Eigen::VectorXd Inequality::compatibility(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
  return part_.compliance * p - part_.b * u;
}

}  // namespace antilock::distributed
