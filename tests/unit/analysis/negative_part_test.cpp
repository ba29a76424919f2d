#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/analysis/negative_part.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/measure/contact_edges.hpp"
#include "antilock/measure/residual.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"
#include "unit/measure/helpers.hpp"

namespace antilock::test::analysis_test::negative_part_test {

using namespace measure_test;

TEST(ContactTrace, IsTheFunctionOnGammaC) {
  for (const NamedSpace& space : two_square_spaces(4, elements())) {
    const Eigen::MatrixX3d trace = contact_trace(space, interpolant(space, affine(1).value));
    EXPECT_NEAR(trace.col(2).sum(), 1, 1e-12) << space.name;
    const Eigen::ArrayXd exact = 0.2 + 3 * trace.col(0).array() + 2;  // y = -1
    EXPECT_LT((trace.col(1).array() - exact).abs().maxCoeff(), 1e-11)
        << space.name;  // gmsh: 1e-12 off
  }
}

/// The samples of an edge (s = (k + 1/2) / 32, values v_k) minus their mean, or minus the chords
/// 0 - 1/2 - 1 of the parabola through three of them.
Eigen::VectorXd hidden(const Eigen::VectorXd& v, bool parabola) {
  if (!parabola) return v.array() - v.mean();
  const auto place = [](int k) { return (k + 0.5) / 32; };
  const auto value = [&](double s) {
    double sum = 0;
    for (const int i : {0, 15, 31}) {
      double phi = 1;
      for (const int j : {0, 15, 31})
        if (j != i) phi *= (s - place(j)) / (place(i) - place(j));
      sum += phi * v(i);
    }
    return sum;
  };
  Eigen::VectorXd rest(32);
  for (int k = 0; k < 32; ++k) {
    const double left = k < 16 ? 0 : 0.5, r = 2 * (place(k) - left);
    rest(k) = v(k) - (1 - r) * value(left) - r * value(left + 0.5);
  }
  return rest;
}

TEST(ContactTrace, TheConstantIsTheLargestHiddenPartOfSampledFunctions) {
  for (const NamedSpace& space : two_square_spaces(3, {&p2(), &crouzeix_raviart()})) {
    std::vector<int> free;
    for (int i = 0; i < space.size(); ++i)
      if (!std::binary_search(space.dirichlet_dofs().begin(), space.dirichlet_dofs().end(), i))
        free.push_back(i);
    Eigen::MatrixXd samples(3 * 32, free.size());  // three edges on Gamma_C
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Eigen::MatrixX3d trace =
          contact_trace(space, Eigen::VectorXd::Unit(space.size(), free[i]));
      for (int e = 0; e < 3; ++e)
        samples.col(i).segment(32 * e, 32) =
            hidden(trace.col(1).segment(32 * e, 32), &space.element() == &p2())
                .cwiseProduct(trace.col(2).segment(32 * e, 32).cwiseSqrt());
    }
    const Eigen::MatrixXd norm = Eigen::MatrixXd(h1_gram_matrix(space))(free, free);
    const double largest =
        generalised_eigenvalues(test::product(samples.transpose(), samples), norm).maxCoeff();
    const double constant =
        negative_part(space, stiff_problem(space, 1), h1_gram_matrix(space)).constant;
    EXPECT_NEAR(constant / std::sqrt(largest), 1, 5e-3) << space.name;  // midpoint sums: 32^-2
  }
}

TEST(ContactTrace, WhatLiesBelowZeroIsBoundedByTheConstantTimesTheNorm) {
  for (const NamedSpace& space : two_square_spaces(6, {&p1(), &p2(), &crouzeix_raviart()})) {
    const Eigen::SparseMatrix<double> norm = h1_gram_matrix(space);
    const double constant = negative_part(space, stiff_problem(space, 1), norm).constant;
    double closest = 0;
    for (int k = 1; k <= 20; ++k) {
      Eigen::VectorXd v(space.size());  // of K_h, otherwise wild
      for (int i = 0; i < space.size(); ++i) v(i) = std::sin(k * 1.7 * i * i + i);
      for (const int i : space.dirichlet_dofs()) v(i) = 0;
      for (const int i : space.contact_dofs()) v(i) = std::max(0.0, v(i));
      const Eigen::MatrixX3d trace = contact_trace(space, v);
      const double below =
          std::sqrt((trace.col(1).array().min(0).square() * trace.col(2).array()).sum());
      EXPECT_LE(below, constant * std::sqrt(v.dot(norm * v))) << space.name;
      if (below > 0) closest = std::max(closest, below / (constant * std::sqrt(v.dot(norm * v))));
    }
    EXPECT_EQ(closest > 0, &space.element() != &p1()) << space.name;  // P1 never; the others do
  }
  const Space cubic(structured_mesh(2), p3());
  test::expect_refused(
      [&] { negative_part(cubic, stiff_problem(cubic, 1), h1_gram_matrix(cubic)); }, "P3");
}

}  // namespace antilock::test::analysis_test::negative_part_test
