// # Does a neural network lock?
//
// Run: 36_neural_network              random weights, then a trained network; 10 seconds
// Run: 36_neural_network --cells 32   with 32 Gauss points in each direction, not 20
// Run: 36_neural_network --exercise 1
// Run: 36_neural_network --exercise 2
// Run: 36_neural_network --exercise 3
//
// Needs: [16](../16_degree/16_degree.cpp) for the share of the ridge that is kept,
// [07](../07_kernel/07_kernel.cpp) for $G_h$, [01](../01_domain/01_domain.cpp) for the
// scaled layer. Nothing later needs this chapter.
//
// **The picture.** The share of the exact energy that networks with random weights have,
// against the number $N$ of features. *There is no mesh that could be aligned with the
// layer. All the same the network locks: the smaller ε is, the more features it needs
// (left). If half of the features have no weight across the layer, it does not (right).*
//
// :figure: neural_network
//
// **Predict.** A feature is $\tanh(w_x x + w_y y + b)$ on the layer, and $u_N$ is a sum of
// 50 of them, each with a factor $a_j$. (a) All $w$ and $b$ are random. How many
// independent sums depend on $x$ alone? And if every second feature has $w_y = 0$? (b)
// Training changes all weights, to lower the energy. Does it find $w_y = 0$?
//
// ## No mesh, and yet it locks
//
// A network with one hidden layer of $N$ features is
//
// $$ u_N = 4 x (1 - x)(1 - y^+) ∑_j a_j \tanh(w_j x + w_j^+ y^+ + w_j^- y^- + b_j), $$
//
// with $y^+ = \max(y, 0)$ in the body and $y^- = \min(y, 0)$ in the layer, so that it may
// have a kink on $Σ$. The factor in front of the sum is 0 on the clamped sides. First the
// inner weights $w_j$, $w_j^±$, $b_j$ are random numbers and stay as they are. Then the
// functions $u_N$ form a space of dimension $N$, and the Ritz method takes the one of least
// energy. (Rahimi and Recht call these functions *random features*; Huang, Zhu and Siew
// call such a network an *extreme learning machine*.) The obstacle is left out, so that the
// problem is linear.
//
// **The functions that cost nothing.** On the layer $∂_y u_N = 0$ means
//
// $$ ∑_j a_j w_j^- \cosh^{-2}(w_j x + w_j^- y + b_j) = 0. $$
//
// At almost every $x$ no two terms have the same argument up to its sign. Then these
// functions of $y$ are linearly independent (exercise 4). So $a_j w_j^- = 0$ for each
// $j$: only features without weight across the layer remain, and $\dim G_N$ is the
// number of these. *Such a feature is a column*: a function of $x$ alone, as a hat
// function on columns is. With random weights there is none. Then $a_0$ is positive
// definite on the space, and $u_N$ tends to 0 as $ε → 0$, in the body too, because each
// feature has its factor $a_j$ in body and layer at once. P1 loses the layer alone.
//
// **The cost of all other functions.** One basis serves every ε. Let $ψ_i$ be
// orthonormal in $a_1 + a_0$, the energy at ε = 1, and orthogonal in $a_0$ (an
// eigenvalue problem). Let $s_i = ‖∂_y ψ_i‖$ on the layer. Then
// $a(ψ_i, ψ_i) = 1 + (ε^{-2} - 1) s_i^2$, and
//
// $$ u_N = ∑_i \frac{(f, ψ_i)}{1 + (ε^{-2} - 1) s_i^2} ψ_i. $$
//
// This is chapter 16's share $1/(1 + ρ)$, mode by mode: a mode is lost where ε is below its
// $s_i$. More features have sums with smaller slopes $s_i$, so that locking begins at a
// smaller ε. It still begins, because no $s_i$ is 0.
//
// **With training.** The *deep Ritz method* (E and Yu) lowers the energy $J(u_N)$ by means
// of all weights, the inner ones included. Columns are within reach then: nothing forbids
// $w_j^- = 0$. The run below trains this network with 50 features, 250 weights in all, by
// L-BFGS (Liu and Nocedal): the energy is integrated by 12 Gauss points in each direction,
// the same ones in each step. E and Yu take residual blocks with the activation
// $\max(x^3, 0)$, new random points in each step, stochastic gradients, and a penalty for
// the clamped sides. The verdicts are about the run below, not about theirs.

#include "antilock/exact/wave.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using Eigen::ArrayXd, Eigen::ArrayXXd, Eigen::MatrixXd, Eigen::VectorXd;
using tutorial::FeatureSlopes, tutorial::GaussPoints, tutorial::Network, tutorial::median;

// The Ritz method for every ε at once. Each vector has one entry per mode $ψ_i$.
struct Modes {
  VectorXd squared_slope;  // $s_i^2$
  VectorXd work;           // $(f, ψ_i)$
  VectorXd ridge;          // the height of the wave $\sin 2πx$ of $ψ_i$ on $Γ_C$
};

// `depth` is that of the layer in the coordinates of the features: 1, except in exercises.
Modes ritz(const Network& network, int points, double depth = 1, double tolerance = 1e-9) {
  // ### Forms
  // One row of $A$ per Gauss point and derivative, times the root of the weight: then
  // $a(v, v) = |A v|^2$ at ε = 1. The work of the load is an integral of $∂_x v$ as well.
  const GaussPoints body(points, false), layer(points, true, depth);
  const FeatureSlopes above = feature_slopes(network, body);
  const FeatureSlopes below = feature_slopes(network, layer);
  const ArrayXd root = body.weight.sqrt();
  const Eigen::Index rows = root.size();
  MatrixXd a(4 * rows, network.rows());
  a.topRows(rows) = above.along.colwise() * root;
  a.middleRows(rows, rows) = above.across.colwise() * root;
  a.middleRows(2 * rows, rows) = below.along.colwise() * root;
  a.bottomRows(rows) = below.across.colwise() * root;
  // ### Solve
  // The features are nearly dependent. $A^T A$ would square the condition number;
  // orthogonal columns do not. A feature that is a sum of others, up to the tolerance, is
  // left out.
  const VectorXd length = a.colwise().norm();
  a *= length.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  qr.setThreshold(tolerance);
  const Eigen::Index rank = qr.rank();
  const MatrixXd basis = qr.householderQ() * MatrixXd::Identity(4 * rows, rank);
  const MatrixXd slopes = basis.bottomRows(rows);
  const SymmetricEigen modes = symmetric_eigen(slopes.transpose() * slopes);
  const VectorXd load = (body.load_flux() * root).matrix();
  const VectorXd work = basis.topRows(rows).transpose() * load;
  // The heights of the basis solve $R^T x$ = heights of the features, in the order of the
  // pivots.
  const VectorXd heights = tutorial::ridge_heights(network, depth).cwiseQuotient(length);
  const VectorXd in_order = qr.colsPermutation().transpose() * heights;
  const MatrixXd r = qr.matrixQR().topLeftCorner(rank, rank);
  VectorXd ridge = in_order.head(rank);
  r.triangularView<Eigen::Upper>().transpose().solveInPlace(ridge);
  const MatrixXd turn = modes.vectors.transpose();
  return {modes.values.cwiseMax(0.0), turn * work, turn * ridge};
}

// The parts of the exact ridge on $Γ_C$ and of the exact energy that a network has.
struct Share {
  double ridge, energy;
};

Share share(const Modes& modes, double stiffness, const ExactSolution& exact) {
  const ArrayXd factors = 1 + (stiffness - 1) * modes.squared_slope.array();
  const VectorXd answers = modes.work.array() / factors;
  const double height = modes.ridge.dot(answers), work = modes.work.dot(answers);
  return {height / exact.max_on_contact(), work / (-2 * exact.energy())};
}

ExactSolution without_obstacle(double epsilon) {
  return {paper_sine_load(), epsilon, false, 6};
}

// The share of the energy that a rigid layer leaves. In the body $u = G(y) \sin 2πx$.
double energy_without_ridge(double epsilon) {
  const double body = LoadResponse(2, {10}).work() / 4;
  return body / -without_obstacle(epsilon).energy();
}

// Draws random weights between -6 and 6. With `columns` every second feature is a column.
Network draw(int features, bool columns, int seed) {
  Network network = tutorial::random_network(features, 6, 0, seed);
  for (int j = 0; columns && j < features; j += 2) network(j, tutorial::column_layer) = 0;
  return network;
}

using Parts = std::array<GaussPoints, 2>;
Parts parts(int n, double depth = 1) {
  const GaussPoints body(n, false), layer(n, true, depth);
  return {body, layer};
}

// Returns $J(u_N)$ and writes its derivatives by all weights. `stiffness` is $ε^{-2}$.
double energy(const Network& network, const Parts& parts, double stiffness,
              Network& gradient) {
  gradient.setZero(network.rows(), 5);
  double value = 0;
  const VectorXd a = network.col(tutorial::column_outer);
  const VectorXd w_x = network.col(tutorial::column_x);
  for (const GaussPoints& at : parts) {
    const double factor = at.layer ? stiffness : 1;
    const VectorXd w_y = network.col(at.across());
    const ArrayXd c = at.clamp(), c_x = at.clamp_x(), c_y = at.clamp_y();
    const MatrixXd phi = activations(network, at);
    const MatrixXd slope = 1 - phi.array().square();  // of tanh
    const ArrayXd sum = phi * a;
    const ArrayXd u_x = c_x * sum + c * (slope * a.cwiseProduct(w_x)).array();
    const ArrayXd u_y = c_y * sum + c * (slope * a.cwiseProduct(w_y)).array();
    const ArrayXd density =
        (u_x.square() + factor * u_y.square()) / 2 - at.load_flux() * u_x;
    value += (at.weight * density).sum();
    // Backwards: the derivatives by $u_x$ and $u_y$, by the three sums, and by the weights.
    const ArrayXd by_u_x = at.weight * (u_x - at.load_flux());
    const ArrayXd by_u_y = at.weight * factor * u_y;
    const VectorXd by_sum = c_x * by_u_x + c_y * by_u_y;
    const VectorXd by_sum_x = c * by_u_x;
    const VectorXd by_sum_y = c * by_u_y;
    const VectorXd slope_x = slope.transpose() * by_sum_x;
    const VectorXd slope_y = slope.transpose() * by_sum_y;
    const MatrixXd by_slope = by_sum_x * w_x.transpose() + by_sum_y * w_y.transpose();
    const MatrixXd bends = by_slope * a.asDiagonal();
    const MatrixXd by_phi = by_sum * a.transpose() - 2 * phi.cwiseProduct(bends);
    const MatrixXd by_argument = slope.cwiseProduct(by_phi);
    gradient.col(tutorial::column_outer) += phi.transpose() * by_sum;
    gradient.col(tutorial::column_outer) +=
        w_x.cwiseProduct(slope_x) + w_y.cwiseProduct(slope_y);
    gradient.col(tutorial::column_x) += a.cwiseProduct(slope_x);
    gradient.col(tutorial::column_x) += by_argument.transpose() * at.x.matrix();
    gradient.col(at.across()) += a.cwiseProduct(slope_y);
    gradient.col(at.across()) += by_argument.transpose() * at.y.matrix();
    gradient.col(tutorial::column_shift) += by_argument.colwise().sum().transpose();
  }
  return value;
}

constexpr int features = 50, seeds = 3, training_points = 12;
constexpr int draw_count = 35;  // seven times five, see the table of the ridge
const std::vector<std::string> training_columns{
    "epsilon",   "seed", "steps", "ridge", "energy",
    "across",       // the median of $|w_j^-|$
    "quadrature"};  // the change by twice the points

// Trains one network, and returns a row per number of steps. The weights start between -1
// and 1, the outer ones near 0. With `true_depth` the layer has the depth ε, and no
// derivative is stiff.
Table train(double epsilon, int seed, const std::vector<int>& steps, bool true_depth) {
  const double depth = true_depth ? epsilon : 1;
  const double stiffness = true_depth ? 1 : std::pow(epsilon, -2);
  const Parts points = parts(training_points, depth),
              finer = parts(2 * training_points, depth);
  const ExactSolution exact = without_obstacle(epsilon);
  Network by_weights;
  const auto objective = [&](const VectorXd& at, VectorXd& gradient) {
    const double value = energy(at.reshaped(features, 5), points, stiffness, by_weights);
    gradient = by_weights.reshaped();
    return value;
  };
  const Network start = tutorial::random_network(features, 1, 0.01, seed);
  tutorial::Lbfgs training(objective, start.reshaped());
  Table rows(training_columns);
  int done = 0;
  for (const int next : steps) {
    while (done < next && training.step()) ++done;
    const Network network = training.x().reshaped(features, 5);
    const VectorXd heights = tutorial::ridge_heights(network, depth);
    const double ridge = heights.dot(network.col(tutorial::column_outer));
    const VectorXd across = network.col(tutorial::column_layer).cwiseAbs();
    const double checked = energy(network, finer, stiffness, by_weights);
    const double change = std::abs(checked / training.value() - 1);
    const double share = training.value() / exact.energy();
    const double kept = ridge / exact.max_on_contact();
    rows.add(
        {epsilon, seed, next, kept, share, median({across.begin(), across.end()}), change});
  }
  return rows;
}

const std::vector<std::string> draw_columns{"weights", "features", "seed",
                                            "epsilon",  // of the layer
                                            "ridge",   "energy"};

// Draws of one kind of network. `points`: Gauss points in each direction.
Table fixed(int count, bool columns, int points, const std::vector<double>& epsilons) {
  const std::string kind = columns ? "half of the features are columns" : "any weights";
  Table rows(draw_columns);
  for (int seed = 1; seed <= draw_count; ++seed) {
    const Modes modes = ritz(draw(count, columns, seed), points);
    for (const double epsilon : epsilons) {
      const Share kept = share(modes, std::pow(epsilon, -2), without_obstacle(epsilon));
      rows.add({kind, count, seed, epsilon, kept.ridge, kept.energy});
    }
  }
  return rows;
}

void judge_random(const Table& random, tutorial::Report& report);
void judge_training(const Table& trained, tutorial::Report& report);
void judge_numerics(tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<double> epsilons{1e-1, 1e-2, 1e-3, 1e-4};
  Table random(draw_columns), trained(training_columns);
  report.stage("random weights");
  for (const bool columns : {false, true})
    for (const int count : {25, 50, 100}) {
      const Table draws = fixed(count, columns, options.cells, epsilons);
      random.add(draws);
    }
  report.stage("training");
  const std::vector<int> steps{10, 30, 100, 300, 1000};
  for (const double epsilon : epsilons)
    for (int seed = 1; seed <= seeds; ++seed)
      trained.add(train(epsilon, seed, steps, false));
  report.finish();
  // ### Output
  tutorial::show_draws(options.out, random);
  tutorial::show_training(options.out, trained);
  judge_random(random, report);
  judge_training(trained, report);
  judge_numerics(report);
}

void judge_random(const Table& random, tutorial::Report& report) {
  // u_N has the least J of its space and u that of V, so that |J(u_N)| <= |J(u)|. A
  // millionth is left for errors of quadrature.
  report.claim(random.max("energy") < 1 + 1e-6,
               "no network has more than the energy (proved)");
  const Table any = random.filter("weights", "any weights");
  const auto middle = [&](int count, double epsilon) {
    return median(
        any.filter("features", count).filter("epsilon", epsilon).numbers("energy"));
  };
  report.claim(
      middle(50, 1e-1) > 0.9 && middle(50, 1e-4) < 0.6,
      "50 features lock: the median has more than 0.9 of the energy at epsilon = 0.1, "
      "less than 0.6 at 1e-4 (observed)");
  report.claim(middle(100, 1e-4) > 0.85, "100 features: more than 0.85 at 1e-4 (observed)");
  const Table half = random.filter("weights", "half of the features are columns");
  const Table columns = half.filter("features", 50);
  // A rigid layer leaves 0.97 of the energy, so the energy alone does not show a ridge.
  report.claim(columns.min("energy") > 0.9 && columns.min("ridge") > 0.8 &&
                   columns.max("ridge") < 1.2,
               "half of 50 features are columns: each draw has more than 0.9 of the energy "
               "and 0.8 to 1.2 of the ridge, whatever epsilon is (observed)");
  const Table without = any.filter("features", 50).filter("epsilon", 1e-4);
  report.claim(columns.filter("epsilon", 1e-4).min("energy") > without.max("energy"),
               "epsilon = 1e-4: each of them has more than each draw without (observed)");
}

void judge_training(const Table& trained, tutorial::Report& report) {
  const Table last = trained.filter("steps", 1000);
  const Table easy = last.filter("epsilon", 1e-1), hard = last.filter("epsilon", 1e-4);
  report.claim(trained.max("energy") < 1 + 1e-6,
               "trained: never more than the energy (proved)");
  report.claim(trained.max("quadrature") < 1e-4,
               "twice the Gauss points change it by < 1e-4");
  report.claim(easy.min("energy") > 0.98, "epsilon = 0.1: 1000 steps give 0.98 (observed)");
  const double rigid = energy_without_ridge(1e-4);
  report.claim(hard.max("energy") < rigid,
               "epsilon = 1e-4, 1000 steps: each seed has less energy than the {:.2f} that "
               "a rigid layer leaves (observed)",
               rigid);
  report.claim(hard.min("across") > 0.2,
               "and half of its weights across are above 0.2 (observed)");
}

// The answers depend neither on the tolerance nor on the Gauss points.
void judge_numerics(tutorial::Report& report) {
  const Network network = draw(100, false, 1);
  const ExactSolution exact = without_obstacle(1e-3);
  const auto at = [&](int points, double tolerance) {
    return share(ritz(network, points, 1, tolerance), 1e6, exact).energy;
  };
  report.claim(
      std::abs(at(20, 1e-9) - at(20, 1e-11)) < 1e-3,
      "100 features, epsilon = 1e-3: the tolerance 1e-11 changes the energy by < 1e-3");
  report.claim(std::abs(at(20, 1e-9) - at(32, 1e-9)) < 1e-3,
               "and 32 Gauss points by < 1e-3");
  const Network start = tutorial::random_network(features, 1, 1, 1);
  const Network direction = tutorial::random_network(features, 1, 1, 2);
  const Parts points = parts(training_points);
  Network gradient, unused;
  energy(start, points, 100, gradient);
  const double step = 1e-5;  // errors of order step^2 and 1e-16 / step
  const double further = energy(start + step * direction, points, 100, unused);
  const double nearer = energy(start - step * direction, points, 100, unused);
  const double slope = gradient.cwiseProduct(direction).sum();
  report.claim(std::abs((further - nearer) / (2 * step) / slope - 1) < 1e-6,
               "the gradient agrees with differences of the energy to 1e-6");
}

// ## What came out
//
// :output: the energy, by epsilon
//
// (a) None, and 25. With any weights 25 features have less than half of the energy at ε =
// 1e-2, and 50 features at ε = 1e-4. 100 features have 0.93 of it there, and lock at a
// smaller ε. With half of 50 features columns, 25 functions of $x$ carry
// the ridge at every measured ε, and 0.98 of the energy is there at 1e-4.
// :number: 0.93 = table "the energy" 0.0001 "network=100, any weights"
// :number: 0.98 = table "the energy" 0.0001 "network=50, half of the features are columns"
//
// :output: 50 features
//
// **Energy and ridge.** Ritz's method makes the energy as large as the space allows, and it
// falls with ε. Neither holds for the height of the ridge. Where the body is approximated
// badly as well, the ridge may be higher than the exact one. It also differs from draw to
// draw: at ε = 1e-4 its median is 0.24, and the medians of five draws each lie between 0.09
// and 0.78. So a small energy shows that a network locks. A large one does not prove the
// contrary, because a layer that cannot move leaves 0.97 of it. Then the ridge decides:
// with columns each draw keeps 0.98 to 1.07 of it.
// :number: 0.24 = table "50 features" median "weights=any weights" epsilon=0.0001
//
// :live: network
//
// :figure: trained_network
//
// (b) No. At ε = 0.1 a thousand steps give 99 % of the energy, at ε = 1e-4 less than a
// third of it. This is less than the 97 % of a layer that cannot move, so the body is
// approximated badly as well.
// :number: 97 = 100 * line "less energy than the {} that a rigid layer leaves"
//
// :output: training of 50 features
//
// The first steps make the slope across small, since it counts $ε^{-2}$ times. The median
// of the weights across stays between 0.2 and 0.6 (it starts near 0.5): the slopes of the
// features cancel each other in the sum. All further steps have to keep this balance. The
// second derivatives of $J$ differ by factors of order $ε^{-2}$, and L-BFGS takes more
// steps for it. Ten times as many steps find most of the energy, but no columns either
// (exercise 3). *The set of all networks contains columns and does not lock. This training
// does not find them.*
//
// Both are cured by the coordinate (exercises 1 and 2). On the true layer all slopes are of
// the same size, and a feature with weights of order 1 is nearly a column.
//
// ## Exercises
//
// 1. Give the features the coordinate of the true layer, $εy$ in place of $y$. How much of
//    energy and ridge does a network with random weights have?
// 2. Train in this coordinate. How much of the energy is there after 1000 steps at ε =
//    1e-4?
// 3. Train at ε = 1e-4 for 10000 steps, ten times as many. Does one seed find columns now?
// 4. On paper: let $w_j ≠ 0$, and $(w_i, b_i) ≠ ±(w_j, b_j)$ for $i ≠ j$. Show that the
//    functions $\cosh^{-2}(w_j y + b_j)$ of one variable are linearly independent.
//
// ## Further reading
//
// - W. E and B. Yu, The deep Ritz method: a deep learning-based numerical algorithm for
//   solving variational problems, Commun. Math. Stat. 6 (2018) 1-12,
//   [10.1007/s40304-018-0127-z](https://doi.org/10.1007/s40304-018-0127-z).
// - A. Rahimi and B. Recht, Random features for large-scale kernel machines, Advances in
//   Neural Information Processing Systems 20 (2007) 1177-1184.
// - G.-B. Huang, Q.-Y. Zhu and C.-K. Siew, Extreme learning machine: theory and
//   applications, Neurocomputing 70 (2006) 489-501,
//   [10.1016/j.neucom.2005.12.126](https://doi.org/10.1016/j.neucom.2005.12.126).
// - J. Chen, X. Chi, W. E and Z. Yang, Bridging traditional and machine learning-based
//   algorithms for solving PDEs: the random feature method, J. Mach. Learn. 1 (2022)
//   268-298, [10.4208/jml.220726](https://doi.org/10.4208/jml.220726). It asks for the
//   equation at points, in place of the least energy.
// - D. C. Liu and J. Nocedal, On the limited memory BFGS method for large scale
//   optimization, Math. Program. 45 (1989) 503-528,
//   [10.1007/BF01589116](https://doi.org/10.1007/BF01589116).

#include "answers.hpp"

int main(int argc, char** argv) {
  tutorial::Options options{.takes_epsilon = false, .cells = 20, .exercises = exercises};
  options.least_cells = 12;
  options.most_cells = 64;
  const std::string about = "Networks with random and with trained weights";
  return tutorial::run(argc, argv, "36_neural_network", about, options, study);
}
