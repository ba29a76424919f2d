#pragma once
// What the precompiled headers hold: the library's, the tutorials' and the tests' (CMake names this file; no page includes
// it). First the headers of others that most pages read.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

// Then, for clang, the expressions of vectors and matrices that most pages write. Each is a class of Eigen's with some
// hundred members, 10 to 20 ms of compilation in every page that writes it: a tenth of all seconds. clang keeps what
// the functions below instantiate; g++ would compile them anew in every page. Nothing calls them.
#ifdef __clang__
namespace antilock::precompiled {

using Sparse = Eigen::SparseMatrix<double>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Triples = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Pairs = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

template <class V>
double vectors(V a, const V& b, const V& c, double s, Eigen::Index n) {
  a = b;
  a += b;
  a -= b;
  a *= s;
  a /= s;
  a = -b;
  a = s * b;
  a = b / s;
  a = b + c;
  a = b - c;
  a = b + s * c;
  a = b - s * c;
  a += s * b;
  a -= s * b;
  a = b.cwiseProduct(c);
  a = b.cwiseQuotient(c);
  a = b.cwiseAbs();
  a = b.cwiseMax(c);
  a = V::Zero(n, 1);
  a = V::Ones(n, 1);
  a = V::Constant(n, 1, s);
  a.setZero();
  return a.dot(b) + a.norm() + a.squaredNorm() + (a - b).norm() + (a - b).squaredNorm() + a.sum() + a.maxCoeff() +
         a.minCoeff() + a.mean() + a.cwiseAbs().maxCoeff() + a.cwiseAbs().sum() + (a - b).cwiseAbs().maxCoeff() +
         a.cwiseProduct(b).dot(c) + a.array().abs().maxCoeff() + a(n);
}

inline double long_vectors(Eigen::VectorXd a, const Eigen::VectorXd& b, double s, Eigen::Index n) {
  a.head(n) = b.tail(n);
  a.tail(n) = b.head(n);
  a.segment(n, n) = b.segment(n, n);
  a.segment(n, n) += b.segment(n, n);
  a = Eigen::VectorXd::LinSpaced(n, s, s);
  a.conservativeResize(n);
  a.resize(n);
  return vectors(a, b, b, s, n) + a.lpNorm<Eigen::Infinity>() + (a - b).lpNorm<Eigen::Infinity>();
}

inline double meshes(Eigen::Vector2d a, Eigen::RowVector2d r, Points p, Triples t, Pairs e, int i, double s) {
  p.resize(i, 2);
  t.resize(i, 3);
  e.resize(i, 2);
  a = p.row(i);
  a = p.row(i).transpose();
  r = p.row(i);
  r = p.row(t(i, 1)) - p.row(e(i, 0));
  p.row(i) = r;
  p.row(i) = p.row(i + 1);
  p.row(i) = s * (p.row(i) + p.row(i));
  return r.norm() + r.x() * a.y() + vectors(a, a, a, s, 2) + (p.row(i) - p.row(i)).norm();
}

inline double matrices(Eigen::MatrixXd a, const Eigen::MatrixXd& b, Eigen::VectorXd v, const Eigen::VectorXd& w,
                       double s, Eigen::Index n) {
  a = Eigen::MatrixXd::Zero(n, n);
  a = Eigen::MatrixXd::Identity(n, n);
  a = b + a;
  a = b - a;
  a += b;
  a = s * b;
  a = b.transpose();
  v = b.col(n);
  v = b.row(n).transpose();
  a.col(n) = w;
  a.row(n) = w.transpose();
  v = b * w;
  v += b * w;
  v -= b * w;
  v = b.transpose() * w;
  a.setZero();
  return a.norm() + (a - b).norm() + a.cwiseAbs().maxCoeff() + (a - b).cwiseAbs().maxCoeff() + a.sum() + v.dot(b * w) +
         a(n, n);
}

template <class S>
double sparse_matrices(S a, const S& b, Eigen::VectorXd v, const Eigen::VectorXd& w, double s, int n) {
  v = b * w;
  v += b * w;
  v -= b * w;
  v = w - b * w;
  v.noalias() = b * w;
  v = b.transpose() * w;
  v += b.transpose() * w;
  v -= b.transpose() * w;
  v = b.transpose() * w.cwiseProduct(v);
  std::vector<Eigen::Triplet<double>> entries;
  entries.emplace_back(n, n, s);
  a.resize(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  for (typename S::InnerIterator i(b, n); i; ++i) s += i.value();
  a.makeCompressed();
  a = b;
  return s + v.dot(b * w) + b.coeff(n, n) + b.norm();
}

inline double sparse(Sparse a, Rows b, Eigen::MatrixXd m, const Eigen::VectorXd& w, double s, int n) {
  a = b;
  b = a;
  a = b.transpose();
  a = a + a;
  a = s * a;
  m = a;
  m = b;
  const Eigen::VectorXd v = a.selfadjointView<Eigen::Upper>() * w;
  return sparse_matrices(a, a, v, w, s, n) + sparse_matrices(b, b, v, w, s, n);
}

}  // namespace antilock::precompiled
#endif
