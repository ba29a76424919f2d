// # Meshes that lock, and others
//
// Run: 02_meshes                  16 cells per unit side, as drawn; a moment
// Run: 02_meshes --cells 64
// Run: 02_meshes --exercise 1
// Run: 02_meshes --exercise 2
//
// **Afterwards you can** predict from the picture of a mesh whether P1 locks on it, and
// count the functions that are left in the limit.
//
// Needs: [01](../01_domain/01_domain.cpp) (problem (23), the stiff form $a_y^-$).
//
// :figure: figure7 figure8
//
// Problem (23) twice: the same load, the same $ε = 10^{-6}$, the same triangles, the same
// solver. On the right the layer rises to 0.0457 where the load lifts the body, as it
// should. On the left it does not rise at all. No program warned. What is wrong on the
// left? The equations are solved to the last digits. It is the mesh that forbids the layer
// to move, together with functions that are affine on each triangle (P1). This chapter
// shows it before anything is solved. (The right picture has other functions, those of
// chapter 08.)
//
// Here are two meshes of about the same size: squares cut by a diagonal, and an arbitrary
// triangulation by the mesh generator gmsh, the one of the pictures above. Both have
// triangles with good angles, none of them near 0 (such meshes are called *regular*), and
// edges along all of $Σ$.
// :figure: figure3 figure6
//
// **Predict.** In what follows the triangles of the layer fall into groups. The structured
// mesh has one group per column. (a) Shift every second row of its vertices by half a cell
// (*staggered*): how many groups? (b) Make the layer of columns, under a body of any
// triangles (*layered*): how many?
//
// ## What the layer may do
//
// First the limit $ε → 0$. Put $v = 0$ into (23). With $a$ for all three forms together,
// $a(u, u) ≤ (f, u)$. By the size of a function we mean the root of the integral of its
// square. The right side is at most the size of $f$ times the size of $u$. The size of $u$
// is at most $C a(u, u)^{1/2}$, because $u$ is 0 on $Γ_D$ and can be large only if its
// derivatives are. (This is the inequality of *Poincaré and Friedrichs*.) One $C$ serves
// all $ε ≤ 1$, since $a$ only grows when $ε$ falls. Divide by $a(u, u)^{1/2}$: what is left
// stays below a number that does not depend on $ε$, and so does $a(u, u)$. It contains
// $ε^{-2} a_y^-(u, u)$. Hence $a_y^-(u, u)$ is at most $ε^2$ times this number: in the
// limit only displacements with $∂_y u = 0$ in the layer are left.
//
// Now the same on a mesh. Let $V_h$ be the P1 functions: affine on each triangle,
// continuous, 0 on $Γ_D$. Those that the stiff form does not see are its *kernel*, and in
// the limit only they are left:
//
// $$ G_h = \{ v ∈ V_h : ∂_y v = 0 \text{ on every triangle of the layer} \}. $$
//
// On one triangle such a function is $v = a + b x$: two numbers. Let two triangles share an
// edge from $x = x_1$ to $x = x_2$. On it both functions agree, so
//
// $$ a + b x_1 = a' + b' x_1,   a + b x_2 = a' + b' x_2. $$
//
// If $x_1 ≠ x_2$, the edge is not vertical, and two affine functions that agree at two
// places are equal: $a = a'$ and $b = b'$. The triangles are *tied together*. If the edge
// is vertical, the two equations are one: the value there is shared, and the slope $b$ may
// change. Triangles that are tied to the same triangle are tied to each other. So the layer
// falls into groups, and there is one pair $(a, b)$ per group.
// :figure: tied_triangles
//
// **Structured.** Each column is a group, since its triangles share horizontal and diagonal
// edges. The function may bend at each vertical line. It is 0 at both ends, so $n$ columns
// leave $n - 1$ functions: the hat functions in $x$.
//
// **Unstructured.** Only vertical edges part two groups. Where such a line of edges reaches
// a vertex inside the layer it must go on, and only vertically. So a line that parts two
// groups runs all the way from $Σ$ to $Γ_C$. On this mesh some edges of the layer are
// exactly vertical, as the run counts: the generator likes to begin columns at the vertical
// sides. But no line goes all the way. Where a column breaks off, irregular triangles tie
// it to its neighbour. All triangles are in one group: one pair $(a, b)$, and $v = 0$ at
// $x = 0$ and at $x = 1$, so $a = b = 0$. Every function of $G_h$ vanishes on the layer. In
// the limit the discrete layer cannot move at all, whatever the load. That is *locking*,
// the left picture. (In the body the kernel asks nothing: every P1 function of the body
// that is 0 on $Σ$ is in $G_h$.)
//
// How little does it take? Move one vertex of the layer, first upwards, then to the side.
// :live: move

#include <numeric>

#include "antilock/analysis/kernel.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

struct Groups {
  std::vector<int>
      leader;  // one per triangle: equal where triangles are tied, -1 in the body
  int count = 0;
  double vertical = 0;  // the share of the layer's inner edges that are vertical
};

// ### Forms
// **The groups.** Each triangle names a leader, at first itself. Going from leader to
// leader one comes to a triangle that names itself: the last leader. An edge that ties two
// triangles makes the last leader of the one follow that of the other. In the end,
// triangles with the same last leader are one group.
Groups tied(const TriangleMesh& mesh) {
  std::vector<int> leader(mesh.triangle_count());
  std::iota(leader.begin(), leader.end(), 0);
  const auto last = [&](int t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  int inner = 0, vertical = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int one = mesh.edge_triangles(e, 0), two = mesh.edge_triangles(e, 1);
    if (two < 0 || mesh.region[one] != Region::layer || mesh.region[two] != Region::layer)
      continue;
    const double run =
        mesh.vertices(mesh.edges(e, 1), 0) - mesh.vertices(mesh.edges(e, 0), 0);
    ++inner;
    if (std::abs(run) > 1e-9)  // gmsh places the points of a vertical line to about 1e-12
      leader[last(one)] = last(two);
    else
      ++vertical;
  }
  Groups found{leader, 0, 1.0 * vertical / inner};
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    found.leader[t] = mesh.region[t] == Region::layer ? last(t) : -1;
    found.count += found.leader[t] == t;
  }
  return found;
}

// The same by other means. Let a matrix compute $∂_y v$, one row per triangle of the layer,
// one column per unknown. The dimension of $G_h$ on the layer is its number of columns less
// its rank (chapter 07). This count knows no groups.
int kernel_on_layer(const TriangleMesh& mesh) {
  return layer_kernel_dimension(assemble(
      Scene(Body{paper_load}, StiffLayer{0}, UnilateralContact{}), Space(mesh, p1())));
}

void meshes(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const int n = options.cells;
  std::vector<tutorial::TiedMesh> layers;
  Table table(
      {"mesh", "triangles", "smallest angle", "vertical edges", "groups", "kernel"});
  for (const std::string name : {"structured", "unstructured", "staggered", "layered"}) {
    const TriangleMesh mesh = mesh_family(name).mesh(n);
    // ### Solve
    const Groups groups = tied(mesh);
    table.add({name, mesh.triangle_count(), tutorial::smallest_angle(mesh), groups.vertical,
               groups.count, kernel_on_layer(mesh)});
    layers.push_back({name, mesh, groups.leader, groups.count});
  }
  // ### Output
  for (const tutorial::TiedMesh& layer : layers) {
    write_msh(options.out / (layer.name + ".msh"),
              layer.mesh);  // for this library and others
    write_freefem_mesh(options.out / (layer.name + ".freefem.msh"), layer.mesh);
  }
  table.print("four meshes of the same domain");
  table.write(options.out / "meshes.csv");
  tutorial::draw_ties(options.out / "ties.csv", layers);

  // atan(1/2) = 26.57 degrees: the corner of the staggered mesh, where half a cell meets a
  // cell
  report.claim(table.min("smallest angle") > 26.5,
               "all four are regular: no angle below {:.2f} degrees (observed)",
               table.min("smallest angle"));
  report.claim(table.numbers("groups") == std::vector<double>{1.0 * n, 1, 1, 1.0 * n},
               "groups: one per column where there are columns, else one in all (proved "
               "for this mesh by counting)");
  bool one_less = true;
  for (const Table& row : table.rows())
    one_less = one_less && row.number("kernel") == row.number("groups") - 1;
  report.claim(one_less,
               "the kernel on the layer, by its rank, has one function less than groups "
               "(proved, observed)");
}

// ## What came out
// :output: four meshes
// :figure: ties
//
// Each group has a colour. (a) One: no edge inside the staggered layer is vertical. This
// mesh has no angle below 26.57°, so it is regular, and P1 locks on it: regularity is not
// what decides. (b) One per column. The body's triangles do not matter. Of the inner edges
// of the unstructured layer a share of 0.075 is vertical, and yet it has one colour: no
// line of them goes all the way.
// :number: 26.57 = table "four meshes" "smallest angle" mesh=staggered
// :number: 0.075 = table "four meshes" "vertical edges" mesh=unstructured
//
// ## Exercises
//
// 1. All inner vertices of a structured mesh are moved a little, but for those on 3
//    vertical lines. Groups? Kernel?
// 2. Turn the diagonals of the structured mesh (left), or draw both (crossed). How many
//    groups?
// 3. On paper: let body and layer be free at both sides, so that only the top is clamped.
//    Which functions of $G_h$ are left on the layer of the unstructured mesh? And if the
//    layer alone is free at its sides?
// 4. On paper: quadratic functions with $∂_y v = 0$ on one group. How many are 0 at both
//    ends?
//
// ## Further reading
//
// - [Babuška and Suri 1992](../guides/bibliography.md#babuska-1992): the definition of
//   locking, with examples.
// - [Braess 2007](../guides/bibliography.md#braess-2007): locking in a first course on
//   finite elements.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "02_meshes", "Figures 3 and 6: the structured and the unstructured mesh",
      {.takes_epsilon = false, .cells = 16, .least_cells = 2, .exercises = exercises},
      meshes);
}
