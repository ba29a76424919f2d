// The compiled part of Python's module `antilock`, which antilock/__init__.py shows to its users.
//
// Arrays of an answer are views of the library's memory, or moved into the array; matrices are
// copied once, since the library keeps what it factors. Whatever takes long gives Python's lock
// back.
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/analysis/locking.hpp"
#include "antilock/exact/sine_load.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/runner/expression.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "antilock/runner/scene_results.hpp"
#include "antilock/runner/solve_scene.hpp"
#include "antilock/solve/active_set.hpp"

namespace py = pybind11;
using namespace py::literals;
using namespace antilock;
using Eigen::VectorXd;

namespace {

using Unlocked = py::gil_scoped_release;

VariationalInequality problem_from(SparseMatrix a1, RowMatrix b, VectorXd m, VectorXd load,
                                   double compliance, std::vector<int> fixed, VectorXd fixed_values,
                                   std::vector<int> bounded, VectorXd lower, VectorXd upper,
                                   std::optional<VectorXd> force_limit) {
  BoundLimits limits(std::move(lower), std::move(upper));
  if (force_limit) limits.force_limit = std::move(*force_limit);
  VariationalInequality problem{.a1 = std::move(a1),
                                .b = std::move(b),
                                .m = std::move(m),
                                .compliance = compliance,
                                .load = std::move(load),
                                .dirichlet_dofs = std::move(fixed),
                                .dirichlet_values = std::move(fixed_values),
                                .bounds = {std::move(bounded), std::move(limits)}};
  check(problem);
  return problem;
}

/// What solve hands back: lambda and active have one entry per unknown.
struct Solved : Solution {
  double energy = 0;
};

/// An argument of Python as a number: antilock/_arguments.py says what is accepted, and refuses the
/// rest.
double number(const char* name, const py::object& given, const char* accepted) {
  return py::module_::import("antilock._arguments")
      .attr("number")(name, given, accepted)
      .cast<double>();
}
/// Real numbers of any shape.
py::array_t<double> numbers(const char* name, const py::object& given) {
  return py::module_::import("antilock._arguments")
      .attr("numbers_of")(name, given)
      .cast<py::array_t<double>>();
}

/// Ctrl-C ends a solve between two corrections, and an accuracy between two steps of a level.
bool not_interrupted(const Progress&) {
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return true;
}

CorrectionOptions corrections(double tolerance) {
  if (!(tolerance > 0 && tolerance <= MethodRequest::roughest_tolerance))
    throw Error(fmt::format("solve: tolerance = {}; accepted: above 0, at most {}", tolerance,
                            MethodRequest::roughest_tolerance));
  CorrectionOptions options{std::max(tolerance, MethodRequest::finest_tolerance)};
  options.progress = not_interrupted;
  return options;
}

Solved answer_of(const VariationalInequality& problem, double tolerance) {
  ActiveSetOptions options;
  options.corrections = corrections(tolerance);
  const Unlocked unlocked;
  Solved a{active_set(problem, options)};
  a.energy = energy(problem, a);
  const VectorXd lambda = a.lambda;
  const std::vector<bool> active = a.active;
  a.lambda.setZero(problem.size());
  a.active.assign(std::size_t(problem.size()), false);
  for (std::size_t i = 0; i < problem.bounds.unknowns.size(); ++i) {
    a.lambda(problem.bounds.unknowns[i]) = lambda(Eigen::Index(i));
    a.active[std::size_t(problem.bounds.unknowns[i])] = active[i];
  }
  return a;
}

SceneFile scene_of(const std::string& text, const std::string& folder) {
  SceneFile file = read_scene(text, std::filesystem::path(folder) / "scene");
  if (file.method.solver == "petsc")
    throw Error(file.name +
                ": method.solver: \"petsc\" is for run_scene; accepted: \"active-set\", \"uzawa\"");
  return file;
}

py::tuple run(const std::string& text, const std::string& folder) {
  const SceneFile file = scene_of(text, folder);
  std::string summary;
  CertifiedSolution found = [&] {
    const Unlocked unlocked;
    CertifiedSolution answered = solve_scene(file, {{}, not_interrupted, {}});
    const CertifiedSolution* const certified = answered.history.empty() ? nullptr : &answered;
    summary = summary_text(file, summary_of(file, answered.result, certified),
                           answered.result.seconds, 0, certified);
    return answered;
  }();
  Result& answer = found.result;
  const auto given = [](auto& owned) {
    return py::cast(std::move(owned));
  };  // moved into the array, not copied
  const Mesh& mesh = answer.space.mesh();
  py::dict arrays("points"_a = answer.space.dof_coordinates(), "vertices"_a = mesh.vertices);
  arrays[mesh.reference().plural] = mesh.triangles;  // "triangles" or "tetrahedra"
  if (const auto contact = contact_results(file, answer)) arrays["contact"] = contact->table;
  answer.solution.p.conservativeResize(answer.problem.parametric_row_count());
  if (answer.space.element().nodal()) {
    arrays["u"] = given(answer.solution.u);
  } else {  // the unknowns are means
    Eigen::VectorXd values = values_at_dofs(answer.space, answer.solution.u);
    arrays["u"] = given(values);
    arrays["mean"] = given(answer.solution.u);
  }
  arrays["p"] = given(answer.solution.p);
  return py::make_tuple(arrays, summary);
}

py::dict certify_scene(const std::string& text, double accuracy, const std::string& folder) {
  const SceneFile file = scene_of(text, folder);
  require_paper_problem(file, "certify");
  const CertifiedSolution found = [&] {
    const Unlocked unlocked;
    AccuracyGoal asked{accuracy, Quantity::displacement, file.method.most_unknowns, {}, 1};
    asked.follow = not_interrupted;
    return solve_to(file.scene, make_mesh(file), asked);
  }();
  const Certificate& proof = found.certificate;
  return py::dict("energy_lower"_a = proof.energy_lower, "energy_upper"_a = proof.energy_upper,
                  "bound"_a = proof.displacement,
                  "relative"_a = proof.relative(Quantity::displacement),
                  "layer_share"_a = proof.layer_share, "unknowns"_a = found.history.back().unknowns,
                  "warning"_a = found.result.warning);
}

/// The exact solution and its table.
struct TabulatedExact {
  TabulatedExact(double epsilon, const std::string& load, bool contact)
      : solution([&] {
          const Scene scene({Expression(load, {"x", "y"})}, StiffLayer{epsilon},
                            contact ? std::optional(UnilateralContact{}) : std::nullopt);
          std::optional<ExactSolution> known = exact_solution_of(scene);
          if (!known)
            throw Error("exact solution: load \"" + printable(load) +
                        "\" is no sum of sines in x with polynomials in y; accepted: such as "
                        "10*sin(2*pi*x), or run "
                        "and certify for any other");
          return std::move(*known);
        }()),
        table(solution) {}
  ExactSolution solution;
  ExactTable table;
};

ExactPoint at(const TabulatedExact* known, double x, double y, double top = 1) {
  const double in_x = std::clamp(x, 0.0, 1.0), in_y = std::clamp(y, -1.0, top);
  if (!(std::hypot(x - in_x, y - in_y) <= 1e-9))  // coordinates are rounded; u is right to 1e-8
    throw Error(
        fmt::format("exact solution: ({}, {}); accepted: 0 <= x <= 1, -1 <= y <= {}", x, y, top));
  return known->table.at(in_x, in_y);
}

double pressure_at(const TabulatedExact& known, double x) {
  const double in_x = std::clamp(x, 0.0, 1.0);
  if (!(std::abs(x - in_x) <= 1e-9))
    throw Error(fmt::format("exact solution: x = {}; accepted: 0 <= x <= 1", x));
  return known.solution.pressure(in_x);
}

/// f(x, y) at numbers or arrays that broadcast to one shape.
template <class Function>
py::object at_points(const Function& f, const py::object& x, const py::object& y) {
  using Array = py::array_t<double>;
  const auto [xs, ys] = py::module_::import("antilock._arguments")
                            .attr("points")(x, y)
                            .cast<std::pair<Array, Array>>();
  return py::vectorize(Function(f))(xs, ys);
}

/// What the language or the C++ library throws becomes an Error of one line, memory that runs out
/// too.
void translate(std::exception_ptr thrown) {
  const auto raise = [](const char* what) {
    PyErr_SetString(py::module_::import("antilock._antilock").attr("Error").ptr(), what);
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error&) {  // these have translators of their own
    throw;
  } catch (const py::error_already_set&) {
    throw;
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const std::bad_alloc&) {
    raise("out of memory; accepted: a smaller problem, or a higher limit");
  } catch (const std::exception& failure) {
    raise(failure.what());
  }
}

void register_errors(py::module_& module) {
  const py::object error = py::register_exception<Error>(module, "Error", PyExc_ValueError);
  py::register_exception<NotConverged>(module, "NotConverged", error);
  for (const char* name : {"Error", "NotConverged"})
    module.attr(name).attr("__module__") = "antilock";
  py::register_local_exception_translator(&translate);
}

void register_problem(py::module_& module) {
  using P = VariationalInequality;
  py::class_<P>(module, "Problem")
      .def(py::init(&problem_from))
      .def(
          "solve",
          [](const P& p, const py::object& tolerance) {
            return answer_of(p, number("tolerance", tolerance, "a number above 0, at most 1e-3"));
          },
          "tolerance"_a = 1e-10,
          "The answer, to a relative error of u. Throws NotConverged, or Error for a problem that "
          "has none.")
      .def_property(
          "compliance", [](const P& p) { return p.compliance; },
          [](P& p, const py::object& given) {
            const double compliance = number("compliance", given, "0 or more");
            if (!(compliance >= 0 && std::isfinite(compliance)))
              throw Error(fmt::format("compliance = {}; accepted: 0 or more", compliance));
            p.compliance = compliance;
          },
          "0 or more")
      .def_readonly("m", &P::m, "R")
      .def_readonly("own_compliances", &P::fixed_compliances,
                    "of the last rows of b, in place of `compliance`")
      .def_readonly("load", &P::load, "N")
      .def_readonly("fixed", &P::dirichlet_dofs, "the unknowns that are held")
      .def_property_readonly(
          "contact", [](const P& p) { return p.bounds.unknowns; }, "the unknowns that are bounded")
      .def_property_readonly(
          "a1", [](const P& p) { return p.a1; }, "N x N, scipy's CSC, a copy")
      .def_property_readonly(
          "b", [](const P& p) { return p.b; }, "R x N, scipy's CSR, a copy");
}

void register_solution(py::module_& module) {
  using S = Solved;
  py::class_<S>(module, "Solution",
                "u with its forces. Arrays are read-only views of the answer's memory.")
      .def_readonly("u", &S::u, "N")
      .def_readonly("p", &S::p, "R, the stress compliance^-1 B u; finite at compliance 0")
      .def_readonly("lambda_", &S::lambda,
                    "N, the force of each bound: >= 0 at a lower one, <= 0 at an upper one")
      .def_readonly("active", &S::active, "N: whether a bound holds")
      .def_readonly("energy", &S::energy, "J(u) = a(u, u) / 2 - L(u)")
      .def_readonly("error", &S::error, "algebraic error of u at most, relative to the largest |u|")
      .def_readonly("warning", &S::warning, "empty, or one line: the reason to distrust it")
      .def_property_readonly("corrections", [](const S& s) { return s.counters.corrections; })
      .def_property_readonly(
          "residual", [](const S& s) { return s.kkt.residual; }, "of the KKT report, relative");
}

void register_diagnosis(py::module_& module) {
  py::class_<LockingDiagnosis>(
      module, "Diagnosis", "Whether a discretisation can follow compliance -> 0; str() says why.")
      .def_property_readonly("locks", &LockingDiagnosis::locks)
      .def_readonly("coarse", &LockingDiagnosis::coarse,
                    "independent motions of the bounds without strain, coarse mesh")
      .def_readonly("fine", &LockingDiagnosis::fine, "the same on the finer mesh")
      .def("__str__", &LockingDiagnosis::text);
}

void register_exact_solution(py::module_& module) {
  using T = TabulatedExact;
  using Any = const py::object&;
  py::class_<T>(module, "ExactSolution",
                "The exact solution of (23). x and y are numbers or arrays, which broadcast.")
      .def(py::init([](Any epsilon, Any load, Any contact) {
             const auto arguments = py::module_::import("antilock._arguments");
             const double size = number("epsilon", epsilon, "0 to 1");
             const auto f =
                 arguments.attr("text")("load", load, "a formula in x and y").cast<std::string>();
             const bool bounded = arguments.attr("flag")("contact", contact).cast<bool>();
             const Unlocked unlocked;
             return std::make_unique<T>(size, f, bounded);
           }),
           "epsilon"_a, "load"_a, "contact"_a)
      .def(
          "__call__",
          [](const T& t, Any x, Any y) {
            return at_points([&t](double a, double b) { return at(&t, a, b).value; }, x, y);
          },
          "x"_a, "y"_a, "u, to 1e-8")
      .def(
          "u_x",
          [](const T& t, Any x, Any y) {
            return at_points([&t](double a, double b) { return at(&t, a, b).gradient(0); }, x, y);
          },
          "x"_a, "y"_a, "to 4e-6 of the largest; 5e-4 within 1e-4 of an end of contact")
      .def(
          "u_y",
          [](const T& t, Any x, Any y) {
            return at_points([&t](double a, double b) { return at(&t, a, b).gradient(1); }, x, y);
          },
          "x"_a, "y"_a, "as u_x; on y = 0 the body's")
      .def(
          "p",
          [](const T& t, Any x, Any y) {
            return at_points([&t](double a, double b) { return at(&t, a, b, 0).layer_stress; }, x,
                             y);
          },
          "x"_a, "y"_a,
          "the layer stress epsilon^-2 u_y where y <= 0, to 1e-6; 1e-4 near an end of contact")
      .def(
          "pressure",
          [](const T& t, Any x) {
            return py::vectorize([&t](double a) { return pressure_at(t, a); })(numbers("x", x));
          },
          "x"_a, "of contact on y = -1, a density, 0 or more")
      .def_property_readonly(
          "energy", [](const T& t) { return t.solution.energy(); }, "J(u), to 1e-8")
      .def_property_readonly(
          "contact", [](const T& t) { return t.solution.contact_zones(); },
          "intervals of x, to 1e-5");

  module.attr("Truth") = module.attr("ExactSolution");  // the name in 0.2
}

void register_functions(py::module_& module) {
  module.def("without_void_bound", py::vectorize(&bound_or_infinity),
             "infinite where |bound| >= 1e40");
  module.def("diagnose", &diagnose_locking, py::call_guard<Unlocked>());
  module.def("assemble", [](const std::string& text, const std::string& folder) {
    const SceneFile file = scene_of(text, folder);
    const Unlocked unlocked;
    const Element& chosen = element(file.method.element, file.mesh.cell_kind());
    return problem_of(file, Space(make_mesh(file), chosen));
  });
  module.def("run", &run);
  module.def("certify", &certify_scene);
}

}  // namespace

PYBIND11_MODULE(_antilock, module) {
  module.attr("__version__") = ANTILOCK_VERSION;
  register_errors(module);
  register_problem(module);
  register_solution(module);
  register_diagnosis(module);
  register_exact_solution(module);
  register_functions(module);
}
