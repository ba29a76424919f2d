#include "antilock/problem/bounded_unknowns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// Gaussian elimination of the combinations in their free unknowns, row by row: after it a row holds its pivot, and
/// beside it only unknowns that are no pivot of a row before it.
class Elimination {
 public:
  struct Row {
    std::map<int, double> of_u, of_w;  ///< of_u . u = of_w . w, w by the number of the combination
    double largest = 0;                ///< of its entries as given
    int pivot = -1;
  };

  Elimination(const VariationalInequality& problem) : candidate_(problem.size(), 1), rows_with_(problem.size()) {
    std::vector<char> fixed(problem.size(), 0);
    for (const int i : problem.fixed) fixed[i] = 1, candidate_[i] = 0;
    for (const int i : problem.contact) candidate_[i] = 0;
    rows_.resize(problem.combinations.rows());
    for (int k = 0; k < static_cast<int>(rows_.size()); ++k) {
      rows_[k].of_w[k] = 1;
      for (RowMatrix::InnerIterator c(problem.combinations, k); c; ++c) {
        const int j = static_cast<int>(c.col());
        if (c.value() == 0 || fixed[j] != 0) continue;
        rows_[k].of_u[j] = c.value();
        rows_[k].largest = std::max(rows_[k].largest, std::abs(c.value()));
        rows_with_[j].insert(k);
      }
    }
    for (int k = 0; k < static_cast<int>(rows_.size()); ++k) waiting_.insert(k);
    take_rows_with_an_unknown_of_their_own();
    while (!waiting_.empty()) {
      eliminate(fewest_entries());
      take_rows_with_an_unknown_of_their_own();
    }
  }

  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<int>& order() const { return order_; }  ///< in which the rows were taken

 private:
  /// The largest entry of a row among its candidates, or among those that are in no other waiting row; -1: none.
  int largest_candidate(const Row& row, bool own) const {
    int found = -1;
    double largest = 0;
    for (const auto& [j, value] : row.of_u) {
      if (candidate_[j] == 0 || (own && rows_with_[j].size() > 1) || std::abs(value) <= largest) continue;
      found = j;
      largest = std::abs(value);
    }
    return found;
  }

  void take_rows_with_an_unknown_of_their_own() {
    std::set<int> look = waiting_;
    while (!look.empty()) {
      const int k = *look.begin();
      look.erase(look.begin());
      const int own = largest_candidate(rows_[k], true);
      if (own < 0 || std::abs(rows_[k].of_u.at(own)) < 1e-3 * rows_[k].largest) continue;
      take(k, own);
      for (const auto& [j, value] : rows_[k].of_u)  // what it shared may be another row's own now
        if (rows_with_[j].size() == 1 && waiting_.count(*rows_with_[j].begin()) > 0)
          look.insert(*rows_with_[j].begin());
    }
  }

  int fewest_entries() const {
    int best = *waiting_.begin();
    for (const int k : waiting_)
      if (rows_[k].of_u.size() < rows_[best].of_u.size()) best = k;
    return best;
  }

  void take(int k, int pivot) {
    rows_[k].pivot = pivot;
    order_.push_back(k);
    waiting_.erase(k);
    for (const auto& [j, value] : rows_[k].of_u) rows_with_[j].erase(k);
  }

  void eliminate(int k) {
    const int pivot = largest_candidate(rows_[k], false);
    if (pivot < 0 || std::abs(rows_[k].of_u.at(pivot)) < 1e-10 * rows_[k].largest)
      throw Error(
          fmt::format("bounds: combination {} has no unknown of its own: its unknowns are fixed or bounded by "
                      "themselves, or the row depends on others; accepted: bounds that do not depend on each "
                      "other",
                      k));
    take(k, pivot);
    const std::set<int> others = rows_with_[pivot];
    for (const int other : others) {
      Row& row = rows_[other];
      const double factor = row.of_u.at(pivot) / rows_[k].of_u.at(pivot);
      for (const auto& [j, value] : rows_[k].of_u) {
        double& entry = row.of_u[j];
        const double before = entry;
        entry -= factor * value;
        rows_with_[j].insert(other);
        if (j != pivot && std::abs(entry) > 1e-15 * std::abs(before)) continue;
        row.of_u.erase(j);  // round-off
        rows_with_[j].erase(other);
      }
      for (const auto& [w, value] : rows_[k].of_w) row.of_w[w] -= factor * value;
    }
  }

  std::vector<Row> rows_;
  std::vector<char> candidate_;
  std::vector<std::set<int>> rows_with_;  ///< waiting rows by unknown
  std::set<int> waiting_;
  std::vector<int> order_;
};

/// T by rows: u_i of each pivot from the rows taken after its own, which hold no pivot that is not known by then.
SparseMatrix change_of_basis(const Elimination& elimination, const Eigen::VectorXd& scale, int size) {
  std::vector<std::map<int, double>> of_w(size);  // empty: u_i = w_i
  double entries = size;
  const double most = 20.0 * size + 1e6;
  for (auto k = elimination.order().rbegin(); k != elimination.order().rend(); ++k) {
    const Elimination::Row& row = elimination.rows()[*k];
    const double pivot = row.of_u.at(row.pivot);
    std::map<int, double>& u = of_w[row.pivot];
    for (const auto& [w, value] : row.of_w) u[elimination.rows()[w].pivot] += value / (scale(w) * pivot);
    for (const auto& [j, value] : row.of_u) {
      if (j == row.pivot) continue;
      if (of_w[j].empty())
        u[j] -= value / pivot;
      else
        for (const auto& [w, share] : of_w[j]) u[w] -= value / pivot * share;
    }
    entries += static_cast<double>(u.size());
    if (entries > most)
      throw Error(
          fmt::format("bounds: solving {} combinations for their unknowns takes more than {:.0f} entries; "
                      "accepted: rows that share fewer unknowns",
                      elimination.rows().size(), most));
  }
  std::vector<Eigen::Triplet<double>> t;
  for (int i = 0; i < size; ++i) {
    if (of_w[i].empty()) t.emplace_back(i, i, 1);
    for (const auto& [w, value] : of_w[i])
      if (value != 0) t.emplace_back(i, w, value);
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(t.begin(), t.end());
  return matrix;
}

/// The bounds in w: shifted by what the fixed unknowns bring into a combination, scaled like its row.
Eigen::VectorXd shifted(const Eigen::VectorXd& bound, const Eigen::VectorXd& of_fixed, const Eigen::VectorXd& scale) {
  return bound.size() == 0 ? bound : Eigen::VectorXd((bound - of_fixed).cwiseProduct(scale));
}

}  // namespace

BoundedUnknowns::BoundedUnknowns(const VariationalInequality& of) : problem(of), scale(of.lower.size()) {
  check_data(of);
  scale.setOnes();
  t.resize(of.size(), of.size());
  t.setIdentity();
  const int contact = static_cast<int>(of.contact.size());
  if (of.combinations.rows() == 0) return;
  const Elimination elimination(of);
  for (int k = 0; k < of.combinations.rows(); ++k) {
    problem.contact.push_back(elimination.rows()[k].pivot);
    scale(contact + k) = std::ldexp(1, -std::ilogb(elimination.rows()[k].largest));
  }
  t = change_of_basis(elimination, scale.tail(of.combinations.rows()), of.size());
  problem.combinations.resize(0, 0);
  Eigen::VectorXd fixed = Eigen::VectorXd::Zero(of.size()), of_fixed = Eigen::VectorXd::Zero(of.lower.size());
  fixed(of.fixed) = of.fixed_values;
  of_fixed.tail(of.combinations.rows()) = of.combinations * fixed;
  problem.lower = shifted(of.lower, of_fixed, scale);
  problem.upper = shifted(of.upper, of_fixed, scale);
  if (of.force_bound.size() > 0) problem.force_bound = of.force_bound.cwiseQuotient(scale);
  const SparseMatrix a1 = t.transpose() * of.a1 * t;
  problem.a1 = SparseMatrix(a1 + SparseMatrix(a1.transpose())) / 2;  // symmetric to the last bit
  if (of.b.rows() > 0) problem.b = RowMatrix(of.b * t);
  problem.load = t.transpose() * of.load;
  problem.a1.makeCompressed();
  problem.b.makeCompressed();
}

}  // namespace antilock
