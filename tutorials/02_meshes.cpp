// # Meshes that lock, and others
//
// Run: 02_meshes                  16 cells per unit side, as drawn; a moment
// Run: 02_meshes --cells 64
// Run: 02_meshes --exercise 1
// Run: 02_meshes --exercise 2
//
// Needs: [01](01_domain.cpp) (problem (23), the stiff form $a_y^-$).
//
// **The pictures.** Figure 3: squares cut by a diagonal. Figure 6: an arbitrary triangulation of about the same size,
// by gmsh. Both fit the interface `Σ`, both have good angles. The third picture shows four layers. Triangles that
// share an edge which is not vertical have the same colour. *On the structured mesh every column has a colour of its
// own. On the unstructured mesh there is one colour, and this is why P1 locks on it.*
//
// **Predict.** (a) Shift every second row of vertices of the structured mesh by half a cell (*staggered*): how many
// colours? (b) Make the layer of columns, under a body of any triangles (*layered*): how many?
//
// ## What the layer may do
//
// Put $v = 0$ into (23): the energy is at most $(f, u)$, which stays bounded as $ε → 0$. Its part
// $ε^{-2} a_y^-(u, u)$ is bounded too, so $a_y^-(u, u) → 0$: in the limit only displacements with $∂_y u = 0$ in the
// layer are left. Let $V_h$ be the P1 functions on a mesh, affine on each triangle, continuous, 0 on $Γ_D$.
// Those that the stiff form does not see are its *kernel*:
//
// $$ G_h = \{ v ∈ V_h : ∂_y v = 0 \text{ on every triangle of the layer} \}. $$
//
// On one triangle such a function is $v = a + b x$: two numbers. Let two triangles share an edge from $x = x_1$ to
// $x = x_2$. On it both functions agree, so $a + b x = a' + b' x$ at $x_1$ and at $x_2$. If $x_1 ≠ x_2$, the edge is
// not vertical, and $a = a'$, $b = b'$: the triangles are *tied together*. If the edge is vertical, only the value
// there is shared, and the slope $b$ may change. Hence one pair $(a, b)$ per group of tied triangles.
//
// **Structured.** Each column is a group, since its triangles share horizontal and diagonal edges. The function may
// bend at each vertical line: $n$ columns, 0 at both ends, leave $n - 1$ functions, the hat functions in $x$.
//
// **Unstructured.** Inside the layer almost no edge is exactly vertical, so all triangles are in one group. One pair
// $(a, b)$, and $v = 0$ at $x = 0$ and at $x = 1$: $a = b = 0$. Every function of $G_h$ vanishes on the layer. In the
// limit $ε = 0$ the discrete layer cannot move at all, whatever the load. That is *locking*, seen before anything is
// solved. (In the body the kernel asks nothing: every P1 function of the body that is 0 on $Σ$ is in $G_h$.)

#include "antilock/analysis/kernel.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/layered.hpp"
#include "common/course.hpp"
#include "common/ties.hpp"

using namespace antilock;

// The dimension of the kernel on the layer, by the rank of a matrix whose rows are $∂_y$ on each triangle
// (chapter 07).
int kernel_on_layer(const TriangleMesh& mesh) {
  return layer_kernel_dimension(
      assemble(Scene(Body{paper_load}, StiffLayer{0}, UnilateralContact{}), Space(mesh, p1())));
}

void meshes(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  const int n = options.cells;
  const std::vector<std::pair<std::string, TriangleMesh>> four{{"structured", structured_mesh(n)},
                                                               {"unstructured", unstructured_mesh(n)},
                                                               {"staggered", rows_mesh(n, n)},
                                                               {"layered", layered_mesh(n)}};
  // ### Solve
  Table table({"mesh", "triangles", "smallest angle", "groups", "kernel"});
  for (const auto& [name, mesh] : four)
    table.add({name, mesh.triangle_count(), tutorial::smallest_angle(mesh), tutorial::ties(mesh).groups,
               kernel_on_layer(mesh)});
  // ### Output
  table.print("four meshes of the same domain");
  table.write(options.out / "meshes.csv");
  tutorial::draw_ties(options.out / "ties.csv", four);
  for (const auto& [name, mesh] : four) {  // MSH for this library and others, FreeFEM's own format beside it
    write_msh(options.out / (name + ".msh"), mesh);
    write_freefem_mesh(options.out / (name + ".freefem.msh"), mesh);
  }

  report.claim(table.least("smallest angle") > 25, "all four are regular: no angle below 25 degrees");
  report.claim(table.numbers("groups") == std::vector<double>{1.0 * n, 1, 1, 1.0 * n},
               "groups: one per column where there are columns, one in all where there are none");
  bool one_less = true;
  for (const Table& row : table.rows()) one_less = one_less && row.number("kernel") == row.number("groups") - 1;
  report.claim(one_less, "the kernel on the layer has one function less than there are groups");
  const TriangleMesh again = unstructured_mesh(n);
  report.claim(four[1].second.vertices == again.vertices && four[1].second.triangles == again.triangles,
               "the unstructured mesh is the same at every run, to the last bit");
}

// ## What came out
//
// (a) One colour: no edge inside its layer is vertical. The mesh is as regular as a mesh can be, and P1 locks on it:
// regularity is not what decides. (b) One per column. The body's triangles do not matter.
//
// ## Exercises
//
// 1. All inner vertices of a structured mesh are moved a little, but for those on 3 vertical lines. Groups? Kernel?
// 2. Turn the diagonals of the structured mesh (left), or draw both (crossed). How many groups?
// 3. On paper: let body and layer be free at both sides, so that only the top is clamped. Which functions of $G_h$
//    are left on the layer of the unstructured mesh? ($1$ and $x$. With the layer alone free the answer is 0 again:
//    the corners $(0,0)$ and $(1,0)$ belong to the clamped sides of the body.)
// 4. On paper: quadratic functions with $∂_y v = 0$ on one group: how many are 0 at both ends? (One, $x(1 - x)$.)

#include "answers/02_meshes.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "02_meshes", "Figures 3 and 6: the structured and the unstructured mesh",
                       {.takes_epsilon = false, .cells = 16, .least_cells = 2, .exercises = exercises}, meshes);
}
