// antilock estimate SCENE.toml MESH.msh U.csv: the error of another program's solution, estimated
// and bounded.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "antilock/analysis/locking_report.hpp"
#include "antilock/certificate/companion.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/core/number.hpp"
#include "antilock/exact/sine_load.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/measure/point_values.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "programs/program.hpp"
#include "programs/subcommands/csv_reader.hpp"
#include "programs/subcommands/subcommands.hpp"

namespace antilock::subcommands {
namespace {

/// The rows of a file, each at an unknown of a space.
struct Matched {
  Eigen::VectorXd u;  ///< by unknown
  double off =
      0;  ///< of the row that is farthest from its unknown, as a share of the triangle's size
  Eigen::Index farthest = 0;  ///< that row
  std::string wrong =
      {};  ///< not empty: the first row at no unknown, or at one for the second time
};

/// The digits of a file are cut off: a row is at the unknown that is nearest, within `most_off` of
/// the triangle's size.
Matched matched(const Space& space, const Eigen::MatrixXd& rows, double most_off) {
  const PointValues at(space);
  const Eigen::MatrixX3d nodes = space.element().support_points();
  Matched found{Eigen::VectorXd::Zero(space.size())};
  std::vector<char> met(static_cast<std::size_t>(space.size()), 0);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto place = at.locate({rows(i, 0), rows(i, 1), 0}, most_off);
    int unknown = -1;
    double nearest =
        2 * most_off;  // the barycentric coordinates sum to 1: one of them may be twice as far off
    for (Eigen::Index k = 0; place && k < nodes.rows(); ++k) {
      const double off = (nodes.row(k).transpose() - place->lambda).lpNorm<Eigen::Infinity>();
      if (off >= nearest) continue;
      nearest = off;
      unknown = space.cell_dofs()(place->triangle, k);
    }
    if (unknown < 0 || met[static_cast<std::size_t>(unknown)]++) {
      found.wrong = fmt::format("row {}, ({:g}, {:g}), is the first of them that is {}; ", i + 1,
                                rows(i, 0), rows(i, 1), unknown < 0 ? "none" : "there twice");
      return found;
    }
    found.u(unknown) = rows(i, 2);
    if (nearest > found.off) found.farthest = i;
    found.off = std::max(found.off, nearest);
  }
  return found;
}

/// The significant digits with which the numbers were written: the fewest that give each of them
/// back.
int digits_of(const Eigen::MatrixXd& numbers) {
  constexpr int most = std::numeric_limits<double>::max_digits10;
  const auto gives_back = [](double number, int digits) {
    double read = 0;
    return read_number(fmt::format("{:.{}g}", number, digits), read) && read == number;
  };
  int digits = 1;
  for (const double number : numbers.reshaped())
    while (digits < most && !gives_back(number, digits)) ++digits;
  return digits;
}

/// Where more than this share of a triangle's size is cut off from the rows' places, as much is cut
/// off from u and its slopes, and the four digits of the errors that are printed are none.
constexpr double most_cut_off = 1e-4;

/// The answer of another program, by unknown of the first space that its rows fit.
struct ReadAnswer {
  std::optional<Space> space;
  Eigen::VectorXd u;
  std::string digits = {};  ///< what is to be said of them
};

/// Throws Error for rows that fit neither the vertices nor the midpoints, or with too few digits to
/// tell where they are.
void match(ReadAnswer& answer, const TriangleMesh& mesh, const Eigen::MatrixXd& rows,
           const std::string& file, const std::string& mesh_file) {
  const int digits = digits_of(rows.leftCols(2));
  std::string wrong;
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space& space = answer.space.emplace(mesh, *element);
    if (rows.rows() != space.size()) continue;
    // Nine digits leave less than the first on any mesh that is not extreme. The last, a tenth of
    // the way to the next unknown, is for the message alone: what is farther off is of another
    // mesh.
    Matched found;
    for (const double most_off : {1e-6, most_cut_off, 0.05}) {
      found = matched(space, rows, most_off);
      if (most_off == 1e-6 && !found.wrong.empty()) wrong = found.wrong;
      if (found.wrong.empty()) break;
    }
    if (!found.wrong.empty()) continue;
    if (found.off > 2 * most_cut_off)
      throw Error(fmt::format(
          "{}: the coordinates have {} digits, which place row {}, ({:g}, {:g}), {:.1g} of a "
          "triangle's "
          "size beside its "
          "{}; accepted: {:g} of it at most, {} digits or more",
          file, digits, found.farthest + 1, rows(found.farthest, 0), rows(found.farthest, 1),
          found.off, element->conforming() ? "vertex" : "midpoint", most_cut_off,
          digits + static_cast<int>(std::ceil(std::log10(found.off / most_cut_off)))));
    if (found.off > 2e-6)  // the first of the three did not do
      answer.digits = fmt::format(
          "  coordinates of {} digits: rows and {} are up to {:.1g} of a triangle's size apart\n",
          digits, element->conforming() ? "vertices" : "midpoints", found.off);
    answer.u = found.u;
    return;
  }
  throw Error(
      fmt::format("{}: {} rows that fit neither the {} vertices nor the {} edge midpoints of {}; "
                  "{}accepted: one row "
                  "per vertex or one per midpoint",
                  file, rows.rows(), mesh.vertex_count(), mesh.edge_count(), mesh_file, wrong));
}

/// |v|_a of a discrete function; infinite at compliance 0 unless B v = 0 to the round-off of values
/// of the size of `of`.
double energy_norm(const VariationalInequality& problem, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& of) {
  const Eigen::VectorXd slope = problem.b * v;
  const double stiff = slope.dot(problem.m.cwiseProduct(slope)), soft = v.dot(problem.a1 * v);
  if (problem.compliance > 0) return std::sqrt(soft + stiff / problem.compliance);
  return stiff <= 1e-24 * of.dot(problem.a1 * of) ? std::sqrt(soft)
                                                  : std::numeric_limits<double>::infinity();
}

struct Bound {
  double value;
  std::string of;  // what it bounds, and why it holds
};

/// Conforming: v is raised into K where it is not there, and J(v) - J(u) >= |u - v|_a^2 / 2, since
/// u minimises J over K.
Bound conforming_bound(const Scene& scene, const Space& space, const VariationalInequality& problem,
                       Eigen::VectorXd v, double energy_lower) {
  const Eigen::VectorXd given = v;
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    v(problem.dirichlet_dofs[i]) = problem.dirichlet_values(Eigen::Index(i));
  if (scene.contact()) {
    const Eigen::VectorXd lower = admissible_bounds(*scene.contact(), space, v);
    for (std::size_t i = 0; i < problem.bounds.unknowns.size(); ++i)
      v(problem.bounds.unknowns[i]) =
          std::max(v(problem.bounds.unknowns[i]), lower(Eigen::Index(i)));
  }
  const double norm = energy_norm(problem, v, v), moved = energy_norm(problem, v - given, v);
  double work = 0;  // int f v, by a finer rule than the load's: what this mesh misses of f must not
                    // count as energy
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = triangle_rule(12);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (Eigen::Index q = 0; mesh.region[t] == Region::body && q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double at = rule.points.row(q).dot(v(mesh.triangles.row(t)));
      work += mesh.area(t) * rule.weights(q) * scene.body().load(x(0), x(1)) * at;
    }
  const double j = norm * norm / 2 - work;
  return {std::sqrt(2 * std::max(0.0, j - energy_lower)) + moved,
          fmt::format("|u - v|_a, from J(v) and the proved lower bound {:.9g} of J{}", energy_lower,
                      moved > 0 ? fmt::format(", and {:.2g} for the way into K", moved) : "")};
}

/// Nonconforming: the certificate of our own Crouzeix-Raviart answer on this mesh, and the distance
/// of the two.
Bound nonconforming_bound(const Scene& scene, const Result& own, const Eigen::VectorXd& v) {
  const double certified = certify(scene, own).gradient;
  const double apart = energy_norm(own.problem, own.solution.u - v, v);
  return {certified + apart,
          fmt::format("the broken energy norm of u - v: {:.4g} proved of Antilock's "
                      "Crouzeix-Raviart answer on this mesh, and {:.2g} "
                      "between the two",
                      certified, apart)};
}

/// Theorem C (tutorials/guides/uniform_rate.md): where each triangle has a vertical and a
/// horizontal edge, the error of the discrete solution is at most 1.7 h |f| (CR) and 1.3 h |f| (P1)
/// in the energy norm, whatever epsilon is; h is the longest edge, |f| the L2 norm over the body.
/// Empty on any other mesh.
std::optional<double> a_priori_bound(const Space& space, const Field& f) {
  const TriangleMesh& mesh = space.mesh();
  double squared = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    bool vertical = false;
    bool horizontal = false;
    for (int i = 0; i < 3; ++i) {
      const Eigen::RowVector2d edge = mesh.vertices.row(mesh.triangles(t, (i + 1) % 3)) -
                                      mesh.vertices.row(mesh.triangles(t, i));
      vertical |= edge(0) == 0;
      horizontal |= edge(1) == 0;
    }
    if (!vertical || !horizontal) return {};
    if (mesh.region[t] != Region::body) continue;
    const Quadrature& rule = triangle_rule(8);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      squared += mesh.area(t) * rule.weights(q) * f(x(0), x(1)) * f(x(0), x(1));
    }
  }
  return (space.element().conforming() ? 1.3 : 1.7) * mesh.diameter() * std::sqrt(squared);
}

/// Antilock's own answer in place of the exact solution, at any point of its mesh. Both must
/// outlive it.
Reference reference(const Result& own, const PointValues& at) {
  const auto place = [&at](double x, double y) {
    const auto found = at.locate(
        {x, y, 0}, 1e-6);  // of a triangle's size: its own mesh has the same boundary, rounded
    if (!found)
      throw Error(
          fmt::format("estimate: ({}, {}) is outside the mesh of the certified answer", x, y));
    return *found;
  };
  const std::vector<int> row = stress_rows(own.space.mesh());
  Reference reference;
  reference.value = [=, &own, &at](double x, double y) {
    return at.value(own.solution.u, place(x, y));
  };
  reference.at = [=, &own, &at](double x, double y) {
    const auto found = place(x, y);
    const int t = found.triangle;
    const bool stress = own.space.mesh().region[t] == Region::layer && own.solution.p.size() > 0;
    return ExactPoint{at.value(own.solution.u, found), at.gradient(own.solution.u, found).head<2>(),
                      stress ? own.solution.p(row[t]) : 0};
  };
  return reference;
}

/// Where the error lies. The share of a region is that of the square of the error, since squares
/// add up.
struct Places {
  double layer = 0, contact = 0;  // shares: of the layer, and of the triangles with an unknown on
                                  // the contact boundary
  std::vector<int> worst;         // the triangles that hold half of the square, the worst first
};

Places places_of(const Space& space, const Eigen::VectorXd& error) {
  const TriangleMesh& mesh = space.mesh();
  std::vector<char> bounded(space.size(), 0);
  for (const int i : space.contact_dofs()) bounded[i] = 1;
  Places places;
  const double all = error.squaredNorm();
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const double share = error(t) * error(t) / all;
    if (mesh.region[t] == Region::layer) places.layer += share;
    const auto unknowns = space.cell_dofs().row(t);
    if (std::any_of(unknowns.begin(), unknowns.end(), [&](int i) { return bounded[i]; }))
      places.contact += share;
  }
  std::vector<int> order(mesh.triangle_count());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return error(a) > error(b); });
  double sum = 0;
  for (auto t = order.begin(); t != order.end() && sum < all / 2; ++t) {
    places.worst.push_back(*t);
    sum += error(*t) * error(*t);
  }
  return places;
}

/// The arguments of the command line.
struct Request {
  std::filesystem::path scene;
  std::filesystem::path mesh;
  std::filesystem::path answer;  ///< x,y,u
  std::filesystem::path out;
  std::filesystem::path where;
  double accuracy = 1e-2;
  std::string row;  ///< the name of the code, for a row of the table
};

void add_arguments(CLI::App& line, Request& request) {
  line.add_option("SCENE", request.scene,
                  "the scene file, in TOML (run_scene --help); its [mesh] is not used")
      ->required();
  line.add_option("MESH", request.mesh,
                  "MSH 2.2 or 4.1, with the groups body, layer, clamped, contact")
      ->required();
  line.add_option("U", request.answer,
                  "CSV with the header x,y,u: one row per vertex (P1) or per edge midpoint (CR), "
                  "in any order")
      ->required();
  line.add_option("--accuracy", request.accuracy,
                  "to which the energy's lower bound is proved, relative, in the energy norm")
      ->check(CLI::Range(1e-4, 0.5));
  line.add_option("--json", request.out, "the same numbers as a JSON file");
  line.add_option("--where", request.where,
                  "a CSV file: triangle,region,x,y,error, one row per triangle of MESH with its "
                  "centroid and its error in the "
                  "energy norm");
  line.add_option("--row", request.row,
                  "NAME of the code: prints a row for the table of codes as well");
  line.footer(
      "Where the error lies is measured against the exact solution where that is known. Elsewhere "
      "it is an estimate: "
      "Antilock's own answer to --accuracy stands in for the exact solution, and its own error, "
      "which is proved, is "
      "printed.");
}

/// The discrete function v whose values the file has, and Antilock's solution in the same space.
struct GivenSolution {
  const Scene& scene;
  Result own;
  Solution v;
  std::string file;  ///< that v was read from
};

/// What is printed and written. It is printed when all is known: a refusal prints nothing else.
struct EstimateReport {
  nlohmann::json found;
  std::string text;

  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
  }
};

/// The errors against the exact solution. Returns those by triangle.
Eigen::VectorXd add_exact_errors(EstimateReport& report, const GivenSolution& given,
                                 const ExactSolution& exact) {
  const ExactTable table(exact);
  const Space& space = given.own.space;
  const Errors e = measure_errors(space, given.v, exact.epsilon(), reference(table));
  report.found["errors"] = {{"max_at_unknowns", e.max_at_unknowns},
                            {"max", e.max},
                            {"l2", e.l2},
                            {"h1", e.h1},
                            {"energy", e.energy}};
  report.print(
      "  errors (exact): {:.4g} at the unknowns, {:.4g} in the maximum norm, {:.4g} L2, {:.4g} H1, "
      "{:.4g} energy "
      "norm\n",
      e.max_at_unknowns, e.max, e.l2, e.h1, e.energy);
  if (const auto most = a_priori_bound(space, given.scene.body().load)) {
    report.found["a_priori"] = *most;
    report.print("  on this mesh the discrete solution is within {:.4g} (proved, order h){}\n",
                 *most, e.energy > *most ? ": this answer is not it" : "");
  }
  return e.by_triangle;
}

void add_bound(EstimateReport& report, const GivenSolution& given, const Bound& bound) {
  if (std::isfinite(bound.value)) {
    report.found["bound"] = bound.value;
    report.print("  proved: at most {:.4g} ({})\n", bound.value, bound.of);
    return;
  }
  const VariationalInequality& problem = given.own.problem;
  const bool rigid = problem.compliance == 0 && problem.b.rows() > 0;
  if (!rigid)
    throw Error(fmt::format(
        "{}: no bound can be given: the error's is {}; accepted: values of the size of an answer",
        given.file, bound.value));
  report.found["bound"] = nullptr;  // 1e-12 in h^-1: what 17 digits leave
  report.print(
      "  proved: nothing; at epsilon = 0 a strain in the layer has no finite energy, and that of "
      "this "
      "answer is not 0: digits are missing, or it is not of this mesh's space\n");
}

/// Where the error lies. `error` (by triangle) is exact, or against a solution whose own error is
/// at most `within`.
void add_places(EstimateReport& report, const Space& space, const Eigen::VectorXd& error,
                bool exact, double within) {
  const TriangleMesh& mesh = space.mesh();
  const Places places = places_of(space, error);
  if (places.worst.empty()) return;
  std::string list;
  nlohmann::json worst = nlohmann::json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(3, places.worst.size()); ++i) {
    const int t = places.worst[i];
    const Eigen::Vector2d x = point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3));
    fmt::format_to(std::back_inserter(list), "{}({:.3g}, {:.3g})", i > 0 ? ", " : "", x(0), x(1));
    worst.push_back({{"triangle", t}, {"x", x(0)}, {"y", x(1)}, {"error", error(t)}});
  }
  report.found["where"] = {{"exact", exact},
                           {"within", exact ? 0 : within},
                           {"energy", error.norm()},
                           {"layer", places.layer},
                           {"contact", places.contact},
                           {"half_lies_in", places.worst.size()},
                           {"triangles", mesh.triangle_count()},
                           {"worst", worst}};
  std::string source;
  if (!exact)
    source = fmt::format(
        " (an estimate: {:.4g} from Antilock's own answer, whose error is at most {:.4g})",
        error.norm(), within);
  report.print(
      "  where{}: {:.3g} % of the squared error in the body, {:.3g} % in the layer; {:.3g} % in "
      "triangles "
      "at the contact boundary; half of it in {} of {} triangles, the worst around {}\n",
      source, 100 * (1 - places.layer), 100 * places.layer, 100 * places.contact,
      places.worst.size(), mesh.triangle_count(), list);
}

/// The share of the largest displacement on the contact boundary.
void add_kept(EstimateReport& report, const GivenSolution& given, const Result& certified) {
  if (!(given.scene.layer_depth() > 0) || !given.scene.contact()) return;
  const double whole = layer_displacement(certified.space, certified.solution.u);
  const double kept = whole > 0 ? layer_displacement(given.own.space, given.v.u) / whole : 1;
  report.found["kept"] = kept;
  report.print("  kept of the largest displacement on the contact boundary: {:.4g} %\n",
               100 * kept);
}

/// Whether it locks. Only of the discrete solution, `own`, is that known. The distance to it is
/// measured by the soft part of the norm, since the digits of a file are cut off.
void add_diagnosis(EstimateReport& report, const Scene& scene, Result own, const Solution& v) {
  constexpr double alike =
      1e-2;  // 1e-4 of the energy, beside the twentieth of its motion that is told of
  const auto norm = [&](const Eigen::VectorXd& w) { return std::sqrt(w.dot(own.problem.a1 * w)); };
  const double apart = norm(v.u - own.solution.u);
  const double size = norm(own.solution.u);
  if (apart > alike * size) {
    report.found["diagnosis"] = nullptr;
    report.print(
        "  layer: of locking nothing is said: this is not the discrete solution on its mesh, but "
        "{:.2g} of "
        "its norm away\n",
        size > 0 ? apart / size : apart);
    return;
  }
  own.solution = v;
  const auto layer = report_locking(scene, own);
  if (!layer) return;
  report.found["diagnosis"] = layer->text();
  report.print("  layer: {}\n", layer->text());
}

/// A row for the table of codes.
void add_row(EstimateReport& report, const std::string& name, const std::string& element,
             double bound) {
  std::string error = "not known";
  if (report.found.contains("errors"))
    error = fmt::format("{:.3g}", report.found["errors"]["max_at_unknowns"].get<double>());
  std::string kept;
  if (report.found.contains("kept"))
    kept = fmt::format("{:.1f} %", 100 * report.found["kept"].get<double>());
  report.print("| {} | {} | {} | {:.3g} | {} |\n", name, element, error, bound, kept);
}

void write_places(std::ostream& stream, const TriangleMesh& mesh, const Eigen::VectorXd& error) {
  stream << "triangle,region,x,y,error\n";
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector2d x = point_in(mesh, t, Eigen::Vector3d::Constant(1.0 / 3));
    const char* const region = mesh.region[t] == Region::layer ? "layer" : "body";
    stream << t << ',' << region << ',' << x(0) << ',' << x(1) << ',' << error(t) << '\n';
  }
}

/// Solves the scene on the mesh and to an accuracy, and compares. Returns the error by triangle.
Eigen::VectorXd add_comparison(EstimateReport& report, GivenSolution given,
                               const Request& request) {
  const Space space = given.own.space;
  const TriangleMesh& mesh = space.mesh();
  const std::optional<ExactSolution> exact =
      is_unit_square(mesh) ? exact_solution_of(given.scene) : std::nullopt;
  Eigen::VectorXd error;
  if (exact) error = add_exact_errors(report, given, *exact);
  given.own.solution = active_set(given.own.problem);
  const CertifiedSolution certified = solve_to(given.scene, mesh, AccuracyGoal{request.accuracy});
  const Bound bound = space.element().conforming()
                          ? conforming_bound(given.scene, space, given.own.problem, given.v.u,
                                             certified.certificate.energy_lower)
                          : nonconforming_bound(given.scene, given.own, given.v.u);
  add_bound(report, given, bound);
  if (!exact) {
    const PointValues at(certified.result.space);
    const double epsilon = given.scene.epsilon().value_or(1);
    error = measure_errors(space, given.v, epsilon, reference(certified.result, at)).by_triangle;
  }
  add_places(report, space, error, exact.has_value(), certified.certificate.gradient);
  add_kept(report, given, certified.result);
  add_diagnosis(report, given.scene, std::move(given.own), given.v);
  if (!request.row.empty()) add_row(report, request.row, space.element().name(), bound.value);
  return error;
}

}  // namespace

int estimate(int argc, char** argv) {
  CLI::App line(
      "Another program's answer to a scene, on its own mesh: its errors, a proved bound, what it "
      "keeps of the "
      "layer's displacement, and whether it locks.",
      "antilock estimate");
  Request request;
  add_arguments(line, request);
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;

  const SceneFile file = read_scene_file(request.scene);
  for (const std::filesystem::path& written : {request.out, request.where})
    check_not_an_input(written, {request.scene, request.mesh, request.answer});
  require_paper_problem(file, argv[0]);
  const TriangleMesh mesh = read_msh(request.mesh.string());
  require_triangles(mesh, request.mesh.c_str());
  const std::string answer = request.answer.string();
  const Eigen::MatrixXd rows = read_csv(answer, {"x", "y", "u"});
  ReadAnswer read;
  match(read, mesh, rows, answer, request.mesh.string());
  const Space& space = *read.space;
  GivenSolution given{
      file.scene, {.space = space, .problem = assemble(file.scene, space)}, {}, answer};
  const VariationalInequality& problem = given.own.problem;
  given.v.u = read.u;
  given.v.p = Eigen::VectorXd::Zero(problem.b.rows());
  if (problem.compliance > 0) given.v.p = problem.b * read.u / problem.compliance;

  EstimateReport report;
  const std::string element = space.element().name();
  report.found = {{"element", element}, {"unknowns", space.free_count()}, {"h", mesh.diameter()}};
  report.print("{}: {}, {} unknowns\n", answer, element, space.free_count());
  report.text += read.digits;
  const Eigen::VectorXd error = add_comparison(report, std::move(given), request);
  if (!request.where.empty())
    write_file(request.where, [&](std::ostream& stream) { write_places(stream, mesh, error); });
  if (!request.out.empty())
    write_file(request.out, [&](std::ostream& stream) { stream << report.found.dump(2) << '\n'; });
  fmt::print("{}", report.text);
  return 0;
}

}  // namespace antilock::subcommands
