#include "antilock/distributed/detail/dof_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "antilock/core/error.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

/// A vector of PETSc that looks at the values of a piece.
Vector view(const Eigen::VectorXd& values) {
  Vector v;
  ok(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(values.size()), values.data(),
                           &v));
  return v;
}

}  // namespace

DofMap::DofMap(const Space& space) {
  require_triangles(space.mesh(), "unknowns of all ranks");
  const TriangleMesh& mesh = space.mesh();
  const int size = space.size();
  const auto place = [&](int i) {
    return std::array{space.dof_coordinates()(i, 0), space.dof_coordinates()(i, 1)};
  };
  // what ranks share lies on the border of their pieces, at places that are the same to the last
  // bit
  std::vector<char> on_border(size, 0);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_triangles(e, 1) >= 0) continue;
    if (space.element().dofs_per_vertex() > 0)
      on_border[mesh.edges(e, 0)] = on_border[mesh.edges(e, 1)] = 1;
    else
      on_border[e] = 1;
  }
  // per unknown: its value, on the border that of the first rank that knows one; below 0: not known
  const auto agreed = [&](Eigen::VectorXd value) {
    std::vector<double> mine;
    for (int i = 0; i < size; ++i)
      if (on_border[i] != 0 && value(i) >= 0)
        mine.insert(mine.end(), {place(i)[0], place(i)[1], value(i)});
    const std::vector<double> all = all_gather(mine);
    std::map<std::array<double, 2>, double> first;
    for (std::size_t k = 0; k < all.size(); k += 3)
      first.try_emplace({all[k], all[k + 1]}, all[k + 2]);
    for (int i = 0; i < size; ++i)
      if (on_border[i] != 0)
        if (const auto found = first.find(place(i)); found != first.end()) value(i) = found->second;
    return value;
  };
  const auto marked = [&](const std::vector<int>& unknowns) {
    Eigen::VectorXd mark = Eigen::VectorXd::Constant(size, -1);
    mark(unknowns).setOnes();
    return agreed(std::move(mark));
  };
  const Eigen::VectorXd owner = agreed(Eigen::VectorXd::Constant(size, rank()));
  // a piece may hold a boundary vertex without a boundary edge: another rank knows
  const Eigen::VectorXd clamped = marked(space.dirichlet_dofs()),
                        contact = marked(space.contact_dofs());
  long long solved = 0;
  for (int i = 0; i < size; ++i) {
    clamped_.push_back(clamped(i) > 0 ? 1 : 0);
    on_contact_.push_back(contact(i) > 0 && clamped(i) < 0 ? 1 : 0);
    if (owner(i) != rank()) continue;
    unknown_.push_back(i);
    solved += clamped(i) < 0;
  }
  std::sort(unknown_.begin(), unknown_.end(), [&](int i, int j) { return place(i) < place(j); });
  std::vector<long long> start{0};  // what comes before each rank's own
  for (const long long count : all_gather(owned())) start.push_back(start.back() + count);
  constexpr long long most =
      std::numeric_limits<PetscInt>::max() / 16;  // 16 entries per row have indices, too
  if (start.back() > most)
    throw Error(
        fmt::format("mesh: {} unknowns; accepted by this build of PETSc (32-bit indices): {}",
                    start.back(), most));
  first_ = static_cast<PetscInt>(start[rank()]);
  total_ = sum(solved);
  Eigen::VectorXd row = Eigen::VectorXd::Constant(size, -1);  // a double: exact up to 2^53
  for (int k = 0; k < owned(); ++k) row(unknown_[k]) = first_ + static_cast<double>(k);
  for (const double r : agreed(std::move(row))) row_.push_back(static_cast<PetscInt>(r));

  Handle<IS, ISDestroy> rows;
  ok(ISCreateGeneral(PETSC_COMM_SELF, size, row_.data(), PETSC_COPY_VALUES, &rows));
  const Eigen::VectorXd here = Eigen::VectorXd::Zero(size);
  ok(VecScatterCreate(vector(), rows, view(here), nullptr, &scatter_));
}

Vector DofMap::vector() const {
  Vector v;
  ok(VecCreateMPI(PETSC_COMM_WORLD, owned(), PETSC_DETERMINE, &v));
  return v;
}

Eigen::VectorXd DofMap::local(Vec v) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(row_.size()));
  const Vector here = view(values);
  ok(VecScatterBegin(scatter_, v, here, INSERT_VALUES, SCATTER_FORWARD));
  ok(VecScatterEnd(scatter_, v, here, INSERT_VALUES, SCATTER_FORWARD));
  return values;
}

void DofMap::summed(const Eigen::VectorXd& local, Vec v) const {
  const Vector here = view(local);
  ok(VecSet(v, 0));
  ok(VecScatterBegin(scatter_, here, v, ADD_VALUES, SCATTER_REVERSE));
  ok(VecScatterEnd(scatter_, here, v, ADD_VALUES, SCATTER_REVERSE));
}

Eigen::VectorXd DofMap::unclamped(Eigen::VectorXd local) const {
  for (Eigen::Index i = 0; i < local.size(); ++i)
    if (clamped_[i] != 0) local(i) = 0;
  return local;
}

}  // namespace antilock::distributed
