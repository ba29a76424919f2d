// # Solving the inequality
//
// Run: 34_solving_the_inequality                eight solvers, 1/h from 8 to 64, four ε
// Run: 34_solving_the_inequality --cells 32     the same down to 1/32
// Run: 34_solving_the_inequality --exercise 1
// Run: 34_solving_the_inequality --exercise 2
// Run: 34_solving_the_inequality --exercise 3
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) for the active set,
// [03](../03_by_hand/03_by_hand.cpp) for the iterated penalty,
// [06](../06_p1_unstructured/06_p1_unstructured.cpp) for the mesh on which P1 locks.
//
// **Afterwards you can** name the solvers of an obstacle problem and say what each step of
// them costs; predict how the number of steps grows as $h$ or ε falls, for Uzawa's method
// from a condition number; and read from the way in which a solver fails that an element
// has locked.
//
// **Predict.** The answer at ε = 0 touches the obstacle along a part of $Γ_C$. Two methods
// start without knowing where: the *active set* guesses the points that touch, *proximal
// Galerkin* approaches from above and never touches. (a) Which of the two needs more linear
// solves on a fine mesh? (b) P1 on the unstructured mesh of Figure 7 locks. At ε = 0 the
// only admissible function is 0 on all of $Γ_C$. What does each of the two methods answer?
//
// ## Everything happens on Γ_C
//
// A discrete problem has thousands of unknowns, and only those on $Γ_C$ are bounded. Let
// $s$ be their values, and let the obstacle exert the forces λ there. The problem without
// bounds is linear, so $s$ depends on λ by
//
// $$ s = w + F λ,   s ≥ 0,   λ ≥ 0,   s_i λ_i = 0. $$
//
// Here $w$ are the values of $s$ without an obstacle. Column $i$ of $F$ is the displacement
// that the force 1 at the point $i$ alone brings about: $F$ is the *flexibility matrix* of
// $Γ_C$, its *compliance*: force in, displacement out. It is symmetric, and it is
// positive semidefinite, because $λ^T F λ$ is twice the energy that the forces λ store. The
// iterated penalty of chapter 03 computes $w$ and $F$ by one linear solve for each of their
// columns, and nothing is divided by ε in it. So the line above is the whole problem
// for *every* ε, and ε = 0 is a value like any other: all that ε and the element do is in
// $F$. A step of any method below costs products with $F$ or a linear system on $Γ_C$.
//
// There are two energies on $Γ_C$. The *dual* one is a function of the forces,
// $D(λ) = ½ λ^T F λ + w^T λ$ with $λ ≥ 0$. Up to a constant this is the energy that body
// and layer store under the load and the forces λ. Its gradient is $s$. Where $F$ has an
// inverse, the energy of chapter 00 becomes the *primal* one, a function of the
// displacements, $J(s) = ½ (s - w)^T F^{-1} (s - w)$ with $s ≥ 0$, and its gradient is λ.

#include <CLI/CLI.hpp>

#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/solve/proximal_galerkin.hpp"
#include "antilock/solve/summed.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using Eigen::MatrixXd, Eigen::VectorXd;
using tutorial::Exact, tutorial::Found, tutorial::OnContact;

// ## The active set is Newton's method
//
// Three conditions per point are one equation. For any number $c > 0$
//
// $$ λ_i - \max(0, λ_i - c s_i) = 0 $$
//
// says the same as $s_i ≥ 0$, $λ_i ≥ 0$, $s_i λ_i = 0$: if the maximum is 0, then $λ_i = 0$
// and $c s_i ≥ 0$; otherwise $s_i = 0$ and $λ_i > 0$. The maximum has a kink, so the
// equation has no derivative there. It has one on either side, and Newton's method with
// either of them is a *semismooth Newton method*. Write down its step. At the points where
// $λ_i - c s_i > 0$ the equation is $c s_i = 0$, and elsewhere it is $λ_i = 0$. Both are
// linear, so the next iterate satisfies them exactly: $s_i = 0$ on the set of these points
// and $λ_i = 0$ off it. This is the active set method of chapter 00, guess by guess
// (Hintermüller, Ito and Kunisch 2002). SNESVI, the solver of PETSc that
// [chapter 24](../24_past_one_machine/24_past_one_machine.cpp) runs, is a method of the
// same kind. After one guess $s_i$ or $λ_i$ is 0, so that $c$ no longer matters. The active
// set method converges as Newton's method does near the answer, and it ends exactly: if two
// guesses in a row are equal, they are the answer. (For an M-matrix chapter 00 proves that
// no guess comes back. Other matrices may cycle.)
//
// *Near the answer* is the restriction. As ε → 0 the layer resists like a string (chapter
// 04). Where a string lies on the obstacle it does not bend, so its force there is minus
// the load, wherever the border of the set is. Only at the last point of the set has the
// string a kink, and only there can the force have a wrong sign. So a guess moves the
// border by about one point. The second guess is the set where the load presses down,
// $x > ½$, and contact begins at some $c > ½$: some $(c - ½)/h$ guesses. At ε = 1 the force
// at a point depends on all others, and the border jumps. The border of a coarse mesh is a
// good guess on a fine one. This is the *nested* start of the library.
Found semismooth_newton(const OnContact& p, std::vector<bool> active) {
  const auto n = p.w.size();
  Found found{VectorXd::Zero(n), VectorXd::Zero(n)};
  for (std::vector<bool> guess; guess != active;) {
    guess = active;
    const std::vector<int> set = tutorial::members(guess);
    found.lambda.setZero();
    if (!set.empty())
      found.lambda(set) = tutorial::solve_positive(p.f(set, set), -p.w(set), "active set");
    found.s = p.w + p.f * found.lambda;
    for (const int i : set) found.s(i) = 0;  // without round-off
    found.shapes.push_back(found.s);
    for (int i = 0; i < n; ++i) active[i] = guess[i] ? found.lambda(i) > 0 : found.s(i) < 0;
    tutorial::count_step(found, "active set", 1000);
  }
  found.active = std::move(active);
  return found;
}

// ## Uzawa, and its acceleration
//
// Guess the forces of the obstacle instead. They give the displacements $s = w + F λ$.
// Where these are below the obstacle, push more; where they are above, push less, but never
// pull:
//
// $$ λ_i ← \max(0, λ_i - ρ s_i). $$
//
// This is *Uzawa's* method, with which the paper computes. The *step* $ρ$ is a positive
// number of our choice. A pair that no step changes is the answer: where $λ_i > 0$ it has
// $s_i = 0$, and where $λ_i = 0$ it has $s_i ≥ 0$. If ρ is not too large, the steps get
// there, because each of them goes downhill in the dual energy $D$: its gradient is $s$,
// the step goes against it, and the maximum projects back onto $λ ≥ 0$. So this is a
// *projected gradient* method.
//
// *How many steps does a digit take?* The gradient step multiplies the part of the error
// that belongs to the eigenvalue $σ$ of $F$ by $1 - ρσ$. The maximum moves no λ farther
// from the answer, because the answer is not negative. So each step below $2/σ_{max}$ is
// safe. With $ρ = 2/(σ_{max} + σ_{min})$ no part has a factor above $(κ - 1)/(κ + 1)$ in
// size, about $1 - 2/κ$, where the *condition number* $κ = σ_{max}/σ_{min}$ is the largest
// eigenvalue over the smallest. For the string of chapter 00 it can be computed. There
// $F = A^{-1}$, and the eigenvalues of $A$ are $4 \sin^2(kπh/2)/h$. So those of $F$ lie
// between about $h/4$ and $1/(π² h)$, and $κ ≈ 4/(π² h²)$: halve $h$, and a digit takes
// four times as many steps. As ε → 0 the layer resists like a string (chapter 04), and κ
// grows like $1/h^2$ there, too.
//
// *Nesterov's* method takes the gradient at a point a little further along the last step,
// and its factor is about $1 - 1/\sqrt κ$. The extrapolation may go uphill. Where it does,
// the method starts again without extrapolation (O'Donoghue and Candès 2015). So its steps
// grow like $1/h$, and Uzawa's like $1/h^2$.
Found uzawa_on_contact(const OnContact& p, bool accelerated, double longer = 1) {
  const VectorXd eigenvalues = symmetric_eigenvalues(p.f);
  const double most = std::max(eigenvalues.maxCoeff(), 1e-300);
  const double least = std::max(eigenvalues.minCoeff(), 0.0);
  const double rho = longer * (accelerated ? 1 / most : 2 / (most + least));
  Found found{p.w, 0 * p.w};
  VectorXd ahead = found.lambda;  // where the gradient is taken
  double weight = 1;
  for (double change = 1; change > 1e-10;) {
    const VectorXd gradient = p.w + p.f * ahead,
                   next = (ahead - rho * gradient).cwiseMax(0);
    const bool uphill = (ahead - next).dot(next - found.lambda) > 0;
    const double next_weight = uphill ? 1 : (1 + std::sqrt(1 + 4 * weight * weight)) / 2;
    const double beyond = accelerated && !uphill ? (weight - 1) / next_weight : 0;
    change = (next - ahead).lpNorm<Eigen::Infinity>() / rho / tutorial::size_of(p);
    ahead = next + beyond * (next - found.lambda);
    found.lambda = next;
    weight = next_weight;
    tutorial::count_step(found, "Uzawa", 1'000'000);
  }
  found.s = p.w + p.f * found.lambda;
  return found;
}

// ## The augmented Lagrangian
//
// Uzawa's step uses the old $s$. Use the new one instead: $μ = \max(0, λ - r s)$ with
// $s = w + F μ$. This is the *proximal point method* for $D$, or the *augmented Lagrangian
// method* for $J$ (Hestenes and Powell 1969, Rockafellar 1976). The number $r$ may be
// large: the error falls by the factor $1/(1 + rσ)$ for each eigenvalue σ of $F$. But $s$
// and μ now depend on each other, by an equation with a kink. Semismooth Newton solves it:
// on the set where $λ_i - r s_i > 0$, $(1 + r F) s = w + F λ$, restricted to the set. With
// $r = ∞$ one outer step is left, and it is the active set.
//
// Chapter 03 has this method already, for the *equation* $B u = ε^2 p$ in place of the
// inequality: a correction there is a step of the augmented Lagrangian with
// $r = 1/(δ - ε^2)$. There the inner problem is linear in $u$ and $p$.
Found augmented_lagrangian(const OnContact& p, double r) {
  Found found{p.w, 0 * p.w};
  std::vector<bool> active(p.w.size(), false);
  for (double change = 1; change > 1e-10; ++found.outer) {
    VectorXd force;
    for (std::vector<bool> guess; guess != active;) {
      guess = active;
      const std::vector<int> set = tutorial::members(guess);
      force = 0 * p.w;
      if (!set.empty()) {
        const VectorXd known = p.w(set) + p.f(set, set) * found.lambda(set);
        const MatrixXd matrix =
            MatrixXd::Identity(known.size(), known.size()) + r * p.f(set, set);
        force(set) = found.lambda(set) -
                     r * tutorial::solve_positive(matrix, known, "augmented Lagrangian");
      }
      found.s = p.w + p.f * force;
      for (int i = 0; i < force.size(); ++i)
        active[i] = found.lambda(i) - r * found.s(i) > 0;
      tutorial::count_step(found, "augmented Lagrangian", 1000);
    }
    change = (force - found.lambda).lpNorm<Eigen::Infinity>() / r / tutorial::size_of(p);
    found.lambda = force;
  }
  return found;
}

// ## Proximal Galerkin
//
// Keep $s > 0$ by construction: $s_i = e^{ψ_i}$. The *latent variable* ψ may be any number.
// Start anywhere and repeat: minimise $J(s)$ plus $1/α$ times a distance from the last
// $s'$, the distance that belongs to the entropy $s \ln s - s$,
//
// $$ D_h(s, s') = ∑ h\, (s_i \ln (s_i / s'_i) - s_i + s'_i). $$
//
// It is not negative, and 0 only at $s = s'$. Its gradient is
// $h (\ln s_i - \ln s'_i) = h (ψ_i - ψ'_i)$, which tends to $-∞$ as $s_i → 0$: the
// minimiser never touches. Its condition is $λ + h (ψ - ψ')/α = 0$. So the force is a
// difference of latent variables, and with $s = w + F λ$
//
// $$ e^{ψ} + F\, h (ψ - ψ') / α = w. $$
//
// Newton's method solves it, with the positive definite matrix
// $\operatorname{diag}(e^ψ) + F h/α$. This is the *latent variable proximal point*
// or *proximal Galerkin* method (Keith and Surowiec 2024; Dokken, Farrell, Keith,
// Papadopoulos and Surowiec 2025), *lumped*: each point has a latent variable of its own,
// so that the limit is the discrete problem of the other solvers. Below, ψ is a finite
// element function, as in these papers.
//
// How many proximal steps? Let $u_k$ be the iterates and $u$ the answer. Each step is a
// minimum, and $J$ is convex, so
//
// $$ J(u_k) - J(u) ≤ D_h(u, u_0) / (α_1 + ... + α_k)   (proved, exercise 4). $$
//
// Neither $h$ nor ε stands there: with $α_k = 2^k$ each step halves the bound, on every
// mesh and at every ε. Each step must have a solution, and for this an *inner point* is
// needed: some force λ must make $s_i > 0$ at all points at once.
Found proximal_by_hand(const OnContact& p) {
  const auto n = p.w.size();
  const double h = 1.0 / static_cast<double>(n + 1);
  VectorXd psi = VectorXd::Constant(n, std::log(tutorial::size_of(p)));
  Found found{psi.array().exp().matrix(), 0 * p.w};
  for (double change = 1, alpha = 2; change > 1e-10; alpha *= 2, ++found.outer) {
    const VectorXd before = psi;
    const MatrixXd stiff = h / alpha * p.f;
    VectorXd step = VectorXd::Ones(n);
    while (!newton_step_has_converged(step, psi - before)) {
      MatrixXd matrix = stiff;
      matrix.diagonal() += psi.array().exp().matrix();
      const VectorXd residual = psi.array().exp().matrix() - p.w + stiff * (psi - before);
      step = -tutorial::solve_positive(matrix, residual, "proximal Galerkin");
      psi += tutorial::without_overflow(step) * step;
      tutorial::count_step(found, "proximal Galerkin", 1000);
    }
    const VectorXd next = psi.array().exp();
    change = (next - found.s).lpNorm<Eigen::Infinity>() / tutorial::size_of(p);
    found.lambda = h / alpha * (before - psi);
    found.s = next;
    found.shapes.push_back(found.s);
  }
  return found;
}

// **As published**, $ψ_h$ is a function in P1 on $Γ_C$ too, and $u_h = e^{ψ_h}$ is asked in
// the mean, $∫ u_h v = ∫ e^{ψ_h} v$ for all $v$ of this space. There are two answers then:
// $u_h$, which is linear between the vertices and may be a little below 0, and $e^{ψ_h}$,
// which is positive at every point. Let $N_{ij} = ∫ φ_i φ_j$ be the mass matrix of $Γ_C$.
// The force at a vertex is $λ = N (ψ' - ψ)/α$, and the step reads
//
// $$ ∫ e^{ψ_h} φ_i + (N F N (ψ - ψ'))_i / α = (N w)_i. $$
//
// (At the two clamped ends $u_h = 0$, which $e^{ψ_h}$ is not. There $ψ_h$ is constant in
// the last cell, as multipliers of mortar methods are.)
Found proximal_published(const OnContact& p) {
  const MatrixXd n = tutorial::mass_matrix(p.w.size()), nfn = n * p.f * n;
  VectorXd psi = VectorXd::Constant(p.w.size(), std::log(tutorial::size_of(p)));
  Found found{psi.array().exp().matrix(), 0 * p.w};
  for (double change = 1, alpha = 2; change > 1e-9; alpha *= 2, ++found.outer) {
    const VectorXd before = psi;
    VectorXd step = VectorXd::Ones(psi.size());
    while (!newton_step_has_converged(step, psi - before)) {
      const tutorial::Exponential e(psi);
      const VectorXd residual = e.integrals - n * p.w + nfn * (psi - before) / alpha;
      step = -tutorial::solve_positive(e.products + nfn / alpha, residual,
                                       "proximal Galerkin, as published");
      psi += tutorial::without_overflow(step) * step;
      tutorial::count_step(found, "proximal Galerkin, as published", 1000);
    }
    found.lambda = n * (before - psi) / alpha;
    const VectorXd next = p.w + p.f * found.lambda;
    change = (next - found.s).lpNorm<Eigen::Infinity>() / tutorial::size_of(p);
    found.s = next;
  }
  found.latent = psi;
  return found;
}

// ## An interior point method
//
// Replace $s_i λ_i = 0$ by $s_i λ_i = μ$ and let $μ → 0$, one Newton step for each μ. Both
// $s$ and λ stay positive: a step goes 0.995 of the way to where the first of them would
// vanish. The matrix is $F + \operatorname{diag}(s/λ)$. *Mehrotra's* choice (1992) of μ
// needs no parameter: a trial step with $μ = 0$ tells how far one can go; if far, then μ is
// small. Compare the two matrices:
// proximal Galerkin has $\operatorname{diag}(e^ψ)$, of the size $s$, and $F$ over a number
// that grows. Here $s/λ = s^2/μ$ stands in its place: both are barriers, with the entropy
// and with the logarithm. An inner point is needed here, too.
//
// *Why is it not Ipopt?* The best-known free interior point program (Wächter and Biegler
// 2006) is made for problems that are not convex. Most of it (a filter for the line search,
// corrections of the inertia, a phase that restores feasibility) has nothing to do here,
// because $F$ is positive semidefinite and $s = w + F λ$ is linear. With $u$ as its unknowns
// it needs their Hessian, which is $A_1 + ε^{-2} B^T M B$. This matrix loses the digits of
// $A_1$ as ε falls, and does not exist at ε = 0 (chapter 18), so that the run would measure
// the sum of the two forms, and not the method. With $p$ as further unknowns and
// $B u = ε^2 p$ as constraints it could take the split form. This was not run. Mehrotra's
// method has the same barrier, and takes the problem on $Γ_C$ at every ε.
Found interior_point(const OnContact& p) {
  const auto n = p.w.size();
  const double size = tutorial::size_of(p), flexible = p.f.diagonal().maxCoeff();
  Found found{VectorXd::Constant(n, size),
              VectorXd::Constant(n, flexible > 0 ? size / flexible : 1)};
  VectorXd &s = found.s, &lambda = found.lambda;
  const double first = s.dot(lambda);
  while (s.dot(lambda) > 1e-20 * first ||
         (s - p.w - p.f * lambda).lpNorm<Eigen::Infinity>() > 1e-10 * size) {
    MatrixXd matrix = p.f;
    matrix.diagonal() += s.cwiseQuotient(lambda);
    const VectorXd residual = s - p.w - p.f * lambda;
    // F dl - ds = residual, s dl + lambda ds = target - s lambda
    const auto direction = [&](const VectorXd& target) {
      const VectorXd dl = tutorial::solve_positive(
          matrix, residual + target.cwiseQuotient(lambda) - s, "interior point");
      return std::pair(VectorXd(p.f * dl - residual), dl);
    };
    const auto [trial_s, trial_lambda] = direction(VectorXd::Zero(n));
    const double reach = tutorial::longest_step(s, trial_s, lambda, trial_lambda);
    const double mu = s.dot(lambda) / static_cast<double>(n);
    const double ahead =
        (s + reach * trial_s).dot(lambda + reach * trial_lambda) / static_cast<double>(n);
    const VectorXd target = VectorXd::Constant(n, mu * std::pow(ahead / mu, 3)) -
                            trial_s.cwiseProduct(trial_lambda);
    const auto [ds, dl] = direction(target);
    const double step = std::min(1.0, 0.995 * tutorial::longest_step(s, ds, lambda, dl));
    s += step * ds;
    lambda += step * dl;
    tutorial::count_step(found, "interior point", 100);
  }
  return found;
}

// ## Projected gradients: no factor at all
//
// All methods above have $F$, and a factor of the whole problem behind it. The simplest
// method without any factor works on all unknowns and on products with
// $K = A_1 + ε^{-2} B^T M B$ alone: *conjugate gradients* as long as the iterate stays
// above the obstacle, a projected gradient step where it would go below, and a gradient
// step for the points that should be released. Which of the three is next follows from the
// sizes of the gradient on the free points and on the touching ones. This is MPRGP
// (*modified proportioning with reduced gradient projections*, Dostál and Schöberl 2005).
// Its rate is proved there, and depends on the condition number of $K$ alone. This number
// is like $ε^{-2} h^{-2}$ for small ε. So the number of products depends on ε, while all
// entries of $F$ stay finite as ε → 0. At ε = 0 $K$ does not exist.
Found mprgp(const SummedSystem& system, int bounded, int most_products) {
  const auto k = system.upper_triangle.selfadjointView<Eigen::Upper>();
  const VectorXd& b = system.load;
  const auto n = b.size(), first = n - bounded;
  Found found{VectorXd::Zero(bounded), VectorXd::Zero(bounded)};
  const auto times = [&](const VectorXd& x) {
    if (found.steps == most_products)
      throw NotConverged("MPRGP: too many products", 1, found.steps);
    ++found.steps;
    return VectorXd(k * x);
  };
  const double step = 1.9 / largest_eigenvalue(times, n, 1e-2, 10);
  VectorXd x = VectorXd::Zero(n), g = -b, free(n), chopped(n), reduced(n);
  const auto split_gradient = [&] {
    free = g;
    chopped.setZero();
    for (auto i = first; i < n; ++i)
      if (x(i) <= 0) {
        free(i) = 0;
        chopped(i) = std::min(g(i), 0.0);
      }
    reduced = free;
    for (auto i = first; i < n; ++i) reduced(i) = std::min(x(i) / step, free(i));
  };
  split_gradient();
  VectorXd p = free;
  while ((free + chopped).norm() > 1e-10 * b.norm()) {
    if (chopped.squaredNorm() > reduced.dot(free)) {  // let go
      const VectorXd kd = times(chopped);
      const double length = g.dot(chopped) / chopped.dot(kd);
      x -= length * chopped;
      g -= length * kd;
      split_gradient();
      p = free;
      continue;
    }
    const VectorXd kp = times(p);
    const double length = g.dot(p) / p.dot(kp);
    double feasible = length;
    for (auto i = first; i < n; ++i)
      if (p(i) > 0) feasible = std::min(feasible, x(i) / p(i));
    x -= feasible * p;
    g -= feasible * kp;
    split_gradient();
    if (feasible == length) {  // conjugate gradients
      p = free - free.dot(kp) / p.dot(kp) * p;
    } else {  // a projected gradient step
      x -= step * free;
      x.tail(bounded) = x.tail(bounded).cwiseMax(0);
      g = times(x) - b;
      split_gradient();
      p = free;
    }
  }
  found.s = x.tail(bounded);
  found.lambda = g.tail(bounded).cwiseMax(0);
  return found;
}

// ## The measurement
//
// All solvers run on three spaces: P1 on columns, P1 on the unstructured mesh, which locks,
// and Crouzeix-Raviart (CR) on the same mesh. The answers are compared with that of
// `active_set` on the whole problem.
void solve_one(const Method& method, const Exact& exact, int cells,
               std::vector<bool>& coarse, tutorial::Study& study) {
  const double epsilon = exact.epsilon;
  // ### Mesh
  const Space space = method.space(cells);
  // ### Forms
  const VariationalInequality problem = assemble(tutorial::paper_scene(epsilon), space);
  // ### Solve
  const auto measure = [&](const std::string& solver, const std::function<void()>& solve) {
    study.add_price({method.name(), solver, epsilon, 1.0 / cells},
                    tutorial::median_seconds(study.repeats, solve));
  };
  OnContact p;
  Solution u_h;
  measure(tutorial::condensation, [&] { p = tutorial::condense(problem); });
  measure("active_set of the library", [&] { u_h = active_set(problem); });
  study.add_mesh({method.name(), "", epsilon, 1.0 / cells}, problem.free_count(),
                 exact.errors(space, u_h).max_at_unknowns / u_h.u.cwiseAbs().maxCoeff());
  const int count = static_cast<int>(p.w.size());
  const auto add = [&](const std::string& solver, const std::function<Found()>& solve) {
    study.add({method.name(), solver, epsilon, 1.0 / cells},
              tutorial::on_contact(problem, u_h), u_h.penalised_max_u, solve);
  };
  const std::vector<bool> nothing(count, false), nested = tutorial::transfer(coarse, count);
  add("active set", [&] { return semismooth_newton(p, nothing); });
  add("active set, nested", [&] {
    Found found = semismooth_newton(p, nested);
    coarse = found.active;
    return found;
  });
  add("augmented Lagrangian",
      [&] { return augmented_lagrangian(p, 1e3 / p.f.diagonal().mean()); });
  add("proximal Galerkin", [&] { return proximal_by_hand(p); });
  add("proximal Galerkin, library",
      [&] { return tutorial::on_contact(problem, proximal_galerkin(problem)); });
  add("interior point", [&] { return interior_point(p); });
  add("Uzawa", [&] { return uzawa_on_contact(p, false); });
  add("Uzawa, accelerated", [&] { return uzawa_on_contact(p, true); });
  if (epsilon > 0 && method.name() == "P1 structured")
    add("MPRGP",
        [&] { return mprgp(summed_system(problem, "MPRGP", "active_set"), count, 5000); });
}

// **As published**: both answers of proximal Galerkin against the exact solution.
Table published_answers(int finest) {
  Table answers(tutorial::answer_columns);
  for (const double epsilon : {1e-2, 1e-6, 0.0}) {
    const ExactSolution exact(paper_sine_load(), epsilon, true, 14);
    for (int n = 16; n <= finest; n *= 2) {
      const Space space(structured_mesh(n), p1());
      const OnContact p =
          tutorial::condense(assemble(tutorial::paper_scene(epsilon), space));
      const Found nodal = semismooth_newton(p, std::vector<bool>(p.w.size(), false));
      answers.add(tutorial::answer_row(exact, nodal, proximal_published(p)));
    }
  }
  return answers;
}

void judge(const Table& runs, tutorial::Report& report);

void solve_all(const tutorial::Options& options, tutorial::Report& report,
               tutorial::Study study) {
  const std::vector<Exact> exact_solutions =
      tutorial::exact_solutions({1, 1e-2, 1e-6, 0}, 14);
  for (const Method& method : {Method{&p1(), structured()},
                               {&p1(), unstructured()},
                               {&crouzeix_raviart(), unstructured()}}) {
    report.stage(method.name());
    for (const Exact& exact : exact_solutions) {
      std::vector<bool> coarse;
      const int finest = options.cells / (method.family.name == "structured" ? 1 : 2);
      for (int n = 8; n <= finest; n *= 2) solve_one(method, exact, n, coarse, study);
    }
  }
  report.stage("proximal Galerkin as published");
  const Table answers = published_answers(options.cells);
  report.finish();
  // ### Output
  study.runs.write(options.out / "steps.csv");
  tutorial::write_price_list(options.out, study);
  tutorial::print_steps(study, options.cells);
  answers.print("As published: errors on Gamma_C over the ridge, by epsilon and h", 2);
  answers.write(options.out / "published.csv");
  tutorial::chart(study.runs).write(options.out / "chart.csv");
  const Space space(structured_mesh(32), p1());
  const OnContact p = tutorial::condense(assemble(tutorial::paper_scene(0), space));
  const std::vector<bool> nothing(p.w.size(), false);
  tutorial::shapes(semismooth_newton(p, nothing).shapes, proximal_by_hand(p).shapes)
      .write(options.out / "shapes.csv");
  judge(study.runs, report);
  tutorial::judge_published(answers, report);
}

void judge(const Table& runs, tutorial::Report& report) {
  const Table agreeing = runs.filter("answer", "agrees");
  const Table fine =
      agreeing.filter_number("h", [](double h) { return h < 0.1; });  // from 1/16 on
  const Table rigid = fine.filter("space", "P1 structured").filter("epsilon", 0.0);
  // On columns alone, because gmsh's meshes differ from version to version: with gmsh 4.13
  // P1 takes 6 steps at epsilon = 0.01.
  const Table nested =
      fine.filter("space", "P1 structured").filter("solver", "active set, nested");
  const Table proximal = agreeing.filter("solver", "proximal Galerkin");
  const Table interior = agreeing.filter("solver", "interior point");
  tutorial::judge_border(runs.filter("space", "P1 structured").filter("epsilon", 0.0),
                         report);
  report.claim(
      nested.max("steps") <= 4,
      "from the coarser mesh, on columns: {} steps at most, at every epsilon (observed)",
      nested.max("steps"));
  report.claim(proximal.max("outer") <= 25 && proximal.max("steps") <= 110,
               "proximal Galerkin: {} proximal and {} Newton steps at most (observed)",
               proximal.max("outer"), proximal.max("steps"));
  report.claim(interior.max("steps") <= 30, "interior point: {} steps at most (observed)",
               interior.max("steps"));
  report.claim_orders(rigid.filter("solver", "Uzawa"), "steps", -2.3, -1.6,
                      "Uzawa at epsilon = 0: steps");
  report.claim_orders(rigid.filter("solver", "Uzawa, accelerated"), "steps", -1.4, -0.6,
                      "accelerated Uzawa at epsilon = 0: steps");
  tutorial::judge_answers(runs, report);
}

// ## What came out
// :output: P1 on columns, epsilon = 0
// :figure: solver_steps
//
// (a) The active set without a first guess. At ε = 0 and 1/h = 64 it needs 15 guesses, and
// twice as many on the next mesh: there are $(c - ½)/h + 2$ guesses, up to 1. At ε = 1
// there are 5.
// :number: 15 = table "P1 on columns, epsilon = 0" 0.01562 "solver=active set"
// :number: 5 = table "P1 on columns, epsilon = 1" 0.01562 "solver=active set"
//
// Proximal Galerkin needs 41 Newton steps there, each with a new matrix, on the coarsest
// mesh 39, and about as many at every ε from 0.01 down. At ε = 1 there are 71. The interior
// point method needs 13.
// :number: 41 = table "P1 on columns, epsilon = 0" 0.01562 "solver=proximal Galerkin"
// :number: 39 = table "P1 on columns, epsilon = 0" 0.125 "solver=proximal Galerkin"
// :number: 71 = table "P1 on columns, epsilon = 1" 0.01562 "solver=proximal Galerkin"
// :number: 13 = table "P1 on columns, epsilon = 0" 0.01562 "solver=interior point"
//
// From the contact set of the coarser mesh the active set needs 2 guesses at most, fewer
// than any other solver here. With CR on the unstructured mesh it needs 4
// guesses from nothing at every ε (1/h = 32).
// :number: 4 = table "CR, unstructured" 0 "solver=active set"
// :figure: solver_shapes
// :live: solvers
//
// (b) The active set answers 0, which is right: 0 is the only admissible function. Proximal
// Galerkin refuses, because $F = 0$ and $e^ψ = 0$ has no solution. *At ε = 0 this refusal
// detects locking at no cost.* The interior point method above does not refuse, although it
// is a barrier method, too: it starts from an $s$ that is not $w + F λ$, and its $s$ tends
// to 0. At ε = 1e-6 $F$ is tiny and not 0. Then all methods agree on an answer that is as
// wrong as the space: no solver repairs a discretisation that locks.
//
// Uzawa's steps grow like $1/h^2$, to 8091, and the accelerated ones like $1/h$, to 810, at
// ε = 1e-6 and 0 alike. The products of MPRGP keep growing as ε falls: from 485 at ε = 1 to
// more than 5000 at 0.01, where it is stopped. At ε = 0 it does not exist.
// :number: 8091 = table "P1 on columns, epsilon = 0" 0.01562 solver=Uzawa
// :number: 810 = table "P1 on columns, epsilon = 0" 0.01562 "solver=Uzawa, accelerated"
// :number: 485 = table "P1 on columns, epsilon = 1" 0.01562 solver=MPRGP
// :output: As published
//
// As published, $u_h$ has the error of the active set, up to a factor of 1.21, and is below
// 0 by up to 0.6 % of the ridge. $e^{ψ_h}$ is positive, but it is not 0 at the clamped
// ends, and beside them its error falls like $h$ alone.
// :number: 1.21 = line "u_h has at most {} times"
// :output: P1 on columns: seconds
//
// In seconds $w$ and $F$ take more than all methods on $Γ_C$ together that use them: one
// linear solve per point of $Γ_C$. The `active_set` of the library does not
// compute $F$. It reads the Schur complement of $Γ_C$ from its factor (chapter 18).
// `price_list.md` has the seconds of the whole problem, those of $w$ and $F$ included, to
// an error of 1 % and of 0.1 %. `figures/benchmark` appends it to the price list of chapter
// 21.
//
// ## Exercises
//
// 1. Proximal Galerkin at ε = 0 with $α = 1$ in every step. How many proximal steps are
//    there then?
// 2. The augmented Lagrangian at ε = 0: multiply $r$ by 100. What happens to the outer
//    steps, and to the linear systems?
// 3. Uzawa at ε = 0 with twice the step, beyond $2/σ_{max}$. Does it diverge? (At which
//    points is λ not 0?)
// 4. On paper: prove the bound for $J(u_k) - J(u)$.
// 5. On paper: why do the active set and Uzawa's method end without an error for $F = 0$?
//
// ## Further reading
//
// - [Glowinski 1984](../guides/bibliography.md#glowinski-1984): Uzawa's method and its
//   step.
// - M. R. Hestenes, *Multiplier and gradient methods*, J. Optim. Theory Appl. 4 (1969),
//   doi:10.1007/BF00927673
// - M. J. D. Powell, *A method for nonlinear constraints in minimization problems*, in R.
//   Fletcher (editor), Optimization, Academic Press, 1969
// - R. T. Rockafellar, *Augmented Lagrangians and applications of the proximal point
//   algorithm in convex programming*, Math. Oper. Res. 1 (1976), doi:10.1287/moor.1.2.97
// - M. Hintermüller, K. Ito, K. Kunisch, *The primal-dual active set strategy as a
//   semismooth Newton method*, SIAM J. Optim. 13 (2002), doi:10.1137/S1052623401383558
// - B. Keith, T. M. Surowiec, *Proximal Galerkin: a structure-preserving finite element
//   method for pointwise bound constraints*, Found. Comput. Math. (2024),
//   doi:10.1007/s10208-024-09681-8
// - J. S. Dokken, P. E. Farrell, B. Keith, I. P. A. Papadopoulos, T. M. Surowiec, *The
//   latent variable proximal point algorithm for variational problems with inequality
//   constraints*, Comput. Methods Appl. Mech. Engrg. 445 (2025),
//   doi:10.1016/j.cma.2025.118181
// - Z. Dostál, J. Schöberl, *Minimizing quadratic functions subject to bound constraints
//   with the rate of convergence and finite termination*, Comput. Optim. Appl. 30 (2005),
//   doi:10.1023/B:COAP.0000049888.80264.25
// - S. Mehrotra, *On the implementation of a primal-dual interior point method*, SIAM
//   J. Optim. 2 (1992), doi:10.1137/0802028
// - A. Wächter, L. T. Biegler, *On the implementation of an interior-point filter
//   line-search algorithm for large-scale nonlinear programming*, Math. Program. 106
//   (2006), doi:10.1007/s10107-004-0559-y
// - B. O'Donoghue, E. Candès, *Adaptive restart for accelerated gradient schemes*, Found.
//   Comput. Math. 15 (2015), doi:10.1007/s10208-013-9150-3

#include "answers.hpp"

int main(int argc, char** argv) {
  tutorial::Study study;
  const auto add_options = [&](CLI::App& line) {
    line.add_option("--repeats", study.repeats,
                    "runs of each solver; their median is its time")
        ->check(CLI::Range(1, 99));
  };
  return tutorial::run(
      argc, argv, "34_solving_the_inequality",
      "eight solvers of one inequality, down to epsilon = 0",
      {.takes_epsilon = false,
       .cells = 64,
       .least_cells = 32,
       .most_cells = 128,
       .add = add_options,
       .exercises = exercises},
      [&](const tutorial::Options& o, tutorial::Report& r) { solve_all(o, r, study); });
}
