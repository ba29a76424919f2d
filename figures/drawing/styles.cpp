#include "drawing/styles.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "drawing/axis.hpp"

namespace antilock::figures {
namespace {

using namespace palette;
using enum Marker;

struct Row {
  const char *key, *name, *short_name;
  Look look;
};

/// Every meaning, in the order of panels and legends. Vermillion and red stand for what locks or is
/// nearly locked, and have the widest lines; exact values lie broad and grey below the others.
const Row rows[] = {
    {"exact", "exact", "", {grey, circle, 14}},
    // methods: an element, or an element and its mesh
    {"P1 structured", "$P_1$, structured mesh", "$P_1$ structured", {blue, circle, 6.5}},
    {"P1 unstructured", "$P_1$, unstructured mesh", "$P_1$ unstructured", {vermillion, square, 10}},
    {"P1 layered", "$P_1$, layered mesh", "$P_1$ layered", {olive, down_triangle, 6}},
    {"CR structured", "Crouzeix–Raviart, structured mesh", "CR structured", {green, diamond, 4.5}},
    {"CR unstructured",
     "Crouzeix–Raviart, unstructured mesh",
     "CR unstructured",
     {purple, triangle, 8.5}},
    {"CR layered", "Crouzeix–Raviart, layered mesh", "CR layered", {indigo, circle, 3}},
    {"P2 structured", "$P_2$, structured mesh", "$P_2$ structured", {indigo, down_triangle, 6}},
    {"P3 structured", "$P_3$, structured mesh", "$P_3$ structured", {olive, diamond, 6}},
    {"P4 structured", "$P_4$, structured mesh", "$P_4$ structured", {black, triangle, 6}},
    {"P2 unstructured", "$P_2$, unstructured mesh", "$P_2$ unstructured", {red, down_triangle, 6}},
    {"P3 unstructured", "$P_3$, unstructured mesh", "$P_3$ unstructured", {indigo, diamond, 6}},
    {"P4 unstructured", "$P_4$, unstructured mesh", "$P_4$ unstructured", {black, triangle, 6}},
    {"P1 jittered", "$P_1$, jittered mesh", "$P_1$ jittered", {red, down_triangle, 8}},
    {"CR jittered", "Crouzeix–Raviart, jittered mesh", "CR jittered", {olive, down_triangle, 6}},
    {"P1", "$P_1$", "", {blue, circle, 6.5}},
    {"CR", "Crouzeix–Raviart", "CR", {purple, triangle, 8.5}},
    {"P2", "$P_2$", "", {indigo, down_triangle, 6}},
    {"P3", "$P_3$", "", {olive, diamond, 6}},
    {"P4", "$P_4$", "", {black, triangle, 6}},
    {"hp", "$hp$", "", {green, square, 9}},
    {"hat means", "bounds on hat means", "hat means", {blue, circle, 6}},
    {"Gauss points", "bounds at Gauss points", "Gauss points", {vermillion, square, 6}},
    {"BDM1-hybrid", "hybrid BDM1", "", {green, diamond, 6}},
    {"Fortin-Soulie", "Fortin–Soulie", "", {black, circle, 2.5}},
    // methods of nearly incompressible elasticity
    {"P1 right diagonals", "$P_1$, right diagonals", "", {blue, circle, 9}},
    {"P1 crossed triangles", "$P_1$, crossed triangles", "", {indigo, down_triangle, 9}},
    {"Crouzeix-Raviart with jumps",
     "Crouzeix–Raviart with jumps",
     "CR with jumps",
     {green, diamond, 6.5}},
    {"Kouhia-Stenberg", "Kouhia–Stenberg", "", {black, triangle, 4}},
    {"friction bound", "$g$", "", {grey, circle, 11}},
    {"friction bound below", "$−g$", "", {grey, square, 11}},
    // means of the strain (what fails, what cures); mixed methods of rubber
    {"P1 as it is", "$P_1$ as it is", "", {vermillion, square, 11}},
    {"patches (half kept)", "patches, half kept", "", {red, down_triangle, 5}},
    {"columns (half kept)", "columns, half kept", "", {olive, triangle, 7}},
    {"boxes (nothing kept)", "boxes, nothing kept", "", {black, cross, 6}},
    {"boxes (half kept)", "boxes, half kept", "", {blue, circle, 8}},
    {"Crouzeix-Raviart", "Crouzeix–Raviart", "CR", {green, diamond, 4.5}},
    {"P1 (pressure per triangle)", "$P_1$, pressure per triangle", "", {vermillion, square, 9}},
    {"MINI", "MINI", "", {blue, circle, 8}},
    {"Taylor-Hood", "Taylor–Hood", "", {indigo, down_triangle, 6}},
    {"CR with jumps", "Crouzeix–Raviart with jumps", "CR", {green, diamond, 6}},
    {"CR with jumps, load on fluxes", "Crouzeix–Raviart, load on fluxes", "", {black, triangle, 6}},
    {"nothing", "nothing held", "", {grey, circle, 5}},
    {"contact set", "contact set held", "", {blue, circle, 5}},
    {"all of Gamma_C", "$Γ_C$ held", "", {blue, square, 5}},
    // the part of the jump that an interior penalty contains, and P1 beside it
    {"continuous P1", "continuous $P_1$", "", {vermillion, square, 10}},
    {"whole jump", "discontinuous $P_1$, whole jump", "whole jump", {indigo, down_triangle, 8}},
    {"mean of the jump",
     "discontinuous $P_1$, mean of the jump",
     "mean of the jump",
     {blue, circle, 9}},
    // Nitsche's contact condition
    {"Nitsche", "Nitsche", "", {blue, circle, 7}},
    {"Nitsche without the stiffness",
     "Nitsche, γ without the stiffness",
     "",
     {indigo, down_triangle, 4}},
    {"Nitsche below the bound", "Nitsche, γ below the bound", "", {vermillion, square, 4}},
    // elements of the plate
    {"P1 with exact shear", "$P_1$, exact shear", "", {vermillion, square, 10}},
    {"P1 with one-point shear", "$P_1$, shear at one point", "", {olive, down_triangle, 6}},
    {"Duran-Liberman", "Durán–Liberman", "", {blue, circle, 6}},
    {"Arnold-Falk", "Arnold–Falk", "", {purple, triangle, 8.5}},
    // switches of quadrilaterals: what locks at once, what hides it, what cures it
    {"full", "full", "", {vermillion, square, 10}},
    {"selective", "selective and B-bar", "", {blue, circle, 9}},
    {"reduced", "reduced", "", {sky, diamond, 5.5}},
    {"stabilised", "stabilised", "", {indigo, down_triangle, 3}},
    {"rotated", "rotated", "", {olive, triangle, 6}},
    {"rotated, means", "rotated, means", "", {green, diamond, 8}},
    // integration of the beam, the two strings
    {"full integration", "full integration", "", {vermillion, square, 8}},
    {"reduced integration", "reduced integration", "", {blue, circle, 6}},
    {"glue at every point", "glue at every point", "", {vermillion, square, 9}},
    {"glue against hat functions", "glue against hat functions", "", {blue, circle, 6}},
    {"upper string", "upper string", "", {blue, circle, 9}},
    {"lower string", "lower string", "", {vermillion, square, 5}},
    {"floor", "floor", "", {grey, circle, 2}},
    // two blocks whose meshes do not match, and the layer between two blocks
    {"mortar", "mortar", "", {blue, circle, 6}},
    {"node to segment", "node to segment", "", {indigo, square, 5}},
    {"P1 in rows", "$P_1$, layer in rows", "", {vermillion, square, 10}},
    {"CR in rows", "Crouzeix–Raviart, layer in rows", "", {purple, triangle, 8.5}},
    {"P1 in columns", "$P_1$, layer in columns", "", {olive, down_triangle, 6}},
    // solvers, and the two ways to hold the stiff form
    {"split form", "split form", "", {blue, circle, 10.5}},
    {"cure in 20 lines", "cure in 20 lines", "", {sky, square, 3.5}},
    {"sum: Cholesky", "sum: Cholesky", "", {vermillion, square, 8}},
    {"sum: LU", "sum: LU", "", {purple, triangle, 6.5}},
    {"sum: CG + ILUT", "sum: CG + ILUT", "", {olive, down_triangle, 5}},
    {"active set", "active set", "", {blue, circle, 9}},
    {"active set, nested", "active set, nested", "", {sky, circle, 5}},
    {"augmented Lagrangian", "augmented Lagrangian", "", {indigo, square, 5}},
    {"proximal Galerkin", "proximal Galerkin", "", {green, diamond, 6}},
    {"interior point", "interior point", "", {purple, triangle, 6}},
    {"Uzawa", "Uzawa", "", {vermillion, square, 6}},
    {"Uzawa, accelerated", "Uzawa, accelerated", "", {olive, down_triangle, 6}},
    {"MPRGP", "MPRGP", "", {black, diamond, 6}},
    {"Uzawa, Cholesky", "Uzawa, Cholesky", "", {vermillion, square, 6}},
    {"Uzawa, CG + ILUT", "Uzawa, CG + ILUT", "", {olive, down_triangle, 6}},
    {"FreeFEM", "FreeFEM", "", {black, diamond, 6}},
    {"error of the iterate", "error", "", {blue, circle, 6}},
    {"its algebraic part", "its algebraic part", "", {olive, diamond, 5}},
    {"accurate enough: stop", "Uzawa stops here", "", {vermillion, square, 9}},
    // (18), term by term; three models of the layer
    {"left side", "$‖u^ε − u_h^ε‖_h$", "", {grey, circle, 13}},
    {"first term", "$‖u^ε − u^0‖$", "", {blue, circle, 5}},
    {"second term", "$‖u^0 − u_h^0‖_h$", "", {vermillion, square, 7}},
    {"third term", "$‖u_h^0 − u_h^ε‖_h$", "", {green, diamond, 5}},
    // the interval from epsilon_0 to 1 over which the worst error is taken
    {"from 1", "$ε_0 = 1$", "", {grey, circle, 5}},
    {"from 0.1", "$ε_0 = 10^{−1}$", "", {sky, square, 13}},
    {"from 0.01", "$ε_0 = 10^{−2}$", "", {green, diamond, 7}},
    {"from 0.001", "$ε_0 = 10^{−3}$", "", {olive, down_triangle, 7.5}},
    {"from 0", "all $ε$", "", {vermillion, square, 10}},
    {"thin layer (22)", "thin layer (22)", "", {sky, circle, 10}},
    {"scaled layer (23)", "scaled layer (23)", "", {indigo, circle, 4}},
    {"no layer (25)", "no layer (25)", "", {vermillion, circle, 4}},
    // ways to an accuracy: the proved bound, and the true error below it
    {"uniform bound", "uniform: bound", "", {vermillion, square, 8}},
    {"uniform error", "uniform: error", "", {vermillion, square, 2.5}},
    {"bisected bound", "bisected: bound", "", {olive, down_triangle, 8}},
    {"bisected error", "bisected: error", "", {olive, down_triangle, 2.5}},
    {"extruded bound", "extruded: bound", "", {blue, circle, 8}},
    {"extruded error", "extruded: error", "", {blue, circle, 2.5}},
    {"midpoint bound", "midpoint: bound", "", {purple, triangle, 8}},
    {"midpoint error", "midpoint: error", "", {purple, triangle, 2.5}},
    {"P1 bisected", "$P_1$, everything bisected", "$P_1$ bisected", {vermillion, square, 10}},
    {"P1 extruded", "$P_1$, layer extruded in columns", "$P_1$ extruded", {blue, circle, 6.5}},
    {"bound", "proved bound", "", {blue, circle, 7}},
    {"error", "error", "", {grey, square, 5}},
    // many ranks
    {"strong scaling", "one mesh, more ranks", "", {blue, circle, 9}},
    {"weak scaling", "as many unknowns per rank", "", {green, diamond, 6}},
    {"columns cut", "one mesh, columns cut", "", {vermillion, square, 7}},
    // subdomains and coarse space of a preconditioner
    {"patches", "small patches", "", {vermillion, square, 10}},
    {"patches and hats", "small patches and hats", "", {olive, down_triangle, 6}},
    {"strips", "strips", "", {purple, triangle, 8}},
    {"strips and hats", "strips and hats", "", {blue, circle, 6}},
    // estimates and what they estimate
    {"estimate $h = 1/8$", "estimate, $h = 1/8$", "", {vermillion, square, 9}},
    {"estimate $h = 1/32$", "estimate, $h = 1/32$", "", {olive, down_triangle, 5}},
    {"error $h = 1/8$", "error, $h = 1/8$", "", {blue, circle, 9}},
    {"error $h = 1/32$", "error, $h = 1/32$", "", {indigo, diamond, 6}},
    {"$h = 1/8$", "$h = 1/8$", "", {sky, circle, 6}},
    {"$h = 1/16$", "$h = 1/16$", "", {blue, square, 7}},
    {"$h = 1/32$", "$h = 1/32$", "", {indigo, diamond, 9}},
    // epsilon: the smaller, the stronger
    {"epsilon 1", "$ε = 1$", "", {grey, circle, 5}},
    {"epsilon 0.1", "$ε = 10^{−1}$", "", {sky, square, 6}},
    {"epsilon 0.01", "$ε = 10^{−2}$", "", {green, diamond, 7}},
    {"epsilon 0.001", "$ε = 10^{−3}$", "", {olive, down_triangle, 7.5}},
    {"epsilon 0.0001", "$ε = 10^{−4}$", "", {purple, triangle, 8}},
    {"epsilon 1e-05", "$ε = 10^{−5}$", "", {indigo, circle, 9}},
    {"epsilon 1e-06", "$ε = 10^{−6}$", "", {red, square, 10}},
    {"epsilon 0", "$ε = 0$", "", {black, square, 10}},
    // panels alone
    {"delta 1", "$δ = 1$", "", {grey, circle, 5}},
    {"delta 0.01", "$δ = 10^{−2}$", "", {green, diamond, 7}},
    {"delta 0.0001", "$δ = 10^{−4}$", "", {purple, triangle, 8}},
    {"delta 1e-06", "$δ = 10^{−6}$", "", {red, square, 10}},
    {"structured", "structured mesh", "structured", {blue, circle, 6}},
    {"unstructured", "unstructured mesh", "unstructured", {vermillion, square, 6}},
    {"layered", "layered mesh", "layered", {olive, down_triangle, 6}},
    {"right diagonals", "right diagonals", "", {blue, circle, 6}},
    {"columns", "columns", "", {green, diamond, 7}},
    {"rows", "rows", "", {purple, triangle, 7}},
    {"Frontal-Delaunay", "Frontal-Delaunay", "", {blue, circle, 8}},
    {"Delaunay", "Delaunay", "", {vermillion, square, 8}},
    {"delaunay", "Delaunay mesh", "", {vermillion, square, 8}},
    {"MeshAdapt", "MeshAdapt", "", {green, diamond, 7}},
    {"jittered", "jittered", "", {sky, square, 6}},
    {"staggered", "staggered mesh", "", {olive, down_triangle, 6}},
    {"equal cells", "equal cells", "", {vermillion, square, 6}},
    {"graded", "graded toward the end of contact", "graded", {blue, circle, 6}},
    {"load paper", "load of every chapter", "smooth load", {blue, circle, 6}},
    {"load bump", "concentrated load", "", {vermillion, square, 6}},
    {"cells 16", "$h = 1/16$", "", {sky, circle, 6}},
    {"cells 32", "$h = 1/32$", "", {blue, square, 7}},
    {"cells 64", "$h = 1/64$", "", {indigo, diamond, 9}},
};

/// An entry as the table above writes it: numbers of epsilon and cells with the column, each in one
/// form.
std::string key_of(const std::string& column, const std::string& entry) {
  double number = 0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), number);
  if (error != std::errc{} || end != entry.data() + entry.size()) return entry;
  return fmt::format("{} {:g}", column, number);
}

std::optional<Meaning> find(const std::string& key) {
  for (int i = 0; const Row& row : rows) {
    const std::string name = row.name, short_name = row.short_name;
    if (row.key == key) return Meaning{name, short_name.empty() ? name : short_name, {i}, row.look};
    ++i;
  }
  return std::nullopt;
}

/// What the table does not have is drawn in a look of its own, after everything that it has.
Meaning unknown(const std::string& column, const std::string& entry) {
  double number = 0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), number);
  const bool numeric = error == std::errc{} && end == entry.data() + entry.size();
  const std::string name =
      numeric ? fmt::format("{} = {}", column == "epsilon" ? "$ε$" : column, number_markup(number))
              : entry;
  return {name, name, {static_cast<int>(std::size(rows))}, {black, cross, 5}, false};
}

}  // namespace

void tell_unknown(const Meaning& meaning) {
  if (!meaning.known && !meaning.name.empty())
    fmt::print(
        stderr,
        "render: \"{}\" is no key of a curve (--help lists them), and has a look of its own\n",
        meaning.name);
}

std::vector<std::string> known_keys() {
  std::vector<std::string> keys;
  for (const Row& row : rows) keys.emplace_back(row.key);
  return keys;
}

Look other_look(std::size_t n) {
  static const Look looks[] = {{blue, circle, 7},           {vermillion, square, 7},
                               {green, diamond, 6},         {purple, triangle, 6},
                               {olive, down_triangle, 5.5}, {indigo, circle, 5}};
  return looks[n % std::size(looks)];
}

Meaning meaning_of(const std::vector<std::string>& columns,
                   const std::vector<std::string>& entries) {
  std::string key;
  for (std::size_t i = 0; i < entries.size(); ++i)
    key.append(i == 0 ? 0 : 1, ' ').append(key_of(columns[i], entries[i]));
  if (auto meaning = find(key)) return *meaning;
  Meaning together;  // part by part; drawn like the first; of no parts: not in the table
  together.known = !entries.empty();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Meaning part =
        find(key_of(columns[i], entries[i])).value_or(unknown(columns[i], entries[i]));
    together.name.append(i == 0 ? "" : ", ").append(part.name);
    together.short_name.append(i == 0 ? 0 : 1, ' ').append(part.short_name);
    together.rank.insert(together.rank.end(), part.rank.begin(), part.rank.end());
    together.known = together.known && part.known;
    if (i == 0) together.look = part.look;
  }
  return together;
}

Meaning meaning_of(const std::string& key) {
  if (auto meaning = find(key)) return *meaning;
  if (const auto colon = key.find(": "); colon != std::string::npos)
    if (auto meaning = find(key.substr(0, colon))) {
      meaning->name += key.substr(colon);
      meaning->short_name += key.substr(colon);
      return *meaning;
    }
  return unknown("", key);
}

}  // namespace antilock::figures
