#include "programs/petsc/atomic_files.hpp"

#include <fmt/format.h>

#include <array>
#include <exception>
#include <fstream>
#include <numeric>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/mesh/labelled_edges.hpp"

namespace antilock::distributed {

namespace fs = std::filesystem;

void write_folder_together(const fs::path& folder,
                           const std::function<void(const fs::path&)>& write,
                           const std::vector<std::string>& known) {
  std::exception_ptr failure;
  bool begun = false;
  try {
    if (rank() > 0) {
      const std::string draft = broadcast({});
      if (!draft.empty()) write(draft);
    } else {
      write_folder(
          folder,
          [&](const fs::path& draft) {
            begun = true;
            broadcast(draft.string());
            write(draft);
          },
          known);
    }
  } catch (const Error&) {  // on every rank, or on rank 0 before or after the others wrote
    failure = std::current_exception();
  }
  if (rank() == 0 && !begun) broadcast({});
  collectively([&] {
    if (failure) std::rethrow_exception(failure);
  });
}

void write_in_turns(const fs::path& path, const std::string& head,
                    const std::function<void(Text&)>& part) {
  for (int r = 0; r < ranks(); ++r)
    collectively([&] {
      if (r != rank()) return;
      std::ofstream out(
          path, std::ios::binary | (r == 0 && !head.empty() ? std::ios::trunc : std::ios::app));
      {
        Text text(out);
        if (r == 0) text.print("{}", head);
        part(text);
      }
      out.close();
      if (!out)
        throw Error(path.string() +
                    ": cannot be written; accepted: a folder with room for the results");
    });
}

void write_solution_csv_together(const fs::path& path, const NestedLevel& level) {
  const Points& points = level.space.dof_coordinates();
  const DofMap& rows = level.problem.rows();
  write_in_turns(path, "x,y,u\n", [&](Text& text) {
    for (int place = 0; place < rows.owned(); ++place) {
      const int i = rows.unknown(place);
      text.print("{},{},{}\n", points(i, 0), points(i, 1), level.state.u(i));
    }
  });
}

void write_msh_together(const fs::path& path, const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  const DofMap nodes(Space(space, p1()));
  // an edge of the boundary has one triangle, an edge of Sigma has one in the layer: its rank
  // writes the edge
  std::vector<int> labelled;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (const int e : mesh.triangle_edges.row(t)) {
      const EdgeTag tag = mesh.edge_tag[e];
      if (tag != EdgeTag::interior && (tag != EdgeTag::sigma || mesh.region[t] == Region::layer))
        labelled.push_back(e);
    }
  const auto before = [](long long count) {  // what the ranks before this one have
    const std::vector<long long> all = all_gather(count);
    return std::accumulate(all.begin(), all.begin() + rank(), 0LL);
  };
  const auto lines = static_cast<long long>(labelled.size()),
             triangles = static_cast<long long>(mesh.triangle_count());
  const long long all_lines = sum(lines), elements = all_lines + sum(triangles);
  long long line = before(lines), triangle = all_lines + before(triangles);
  const bool layer = sum(static_cast<long long>(
                         std::count(mesh.region.begin(), mesh.region.end(), Region::layer))) > 0;

  const std::string names =
      layer ? "5\n2 1 \"body\"\n2 2 \"layer\"\n1 3 \"sigma\"\n1 4 \"clamped\"\n1 5 \"contact\"\n"
            : "3\n2 1 \"body\"\n1 4 \"clamped\"\n1 5 \"contact\"\n";
  write_in_turns(
      path,
      fmt::format(
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}$EndPhysicalNames\n$Nodes\n{}\n",
          names, sum(static_cast<long long>(nodes.owned()))),
      [&](Text& text) {
        for (int place = 0; place < nodes.owned(); ++place) {
          const int v = nodes.unknown(place);
          text.print("{} {} {} 0\n", nodes.row()[v] + 1, mesh.vertices(v, 0), mesh.vertices(v, 1));
        }
        if (rank() == ranks() - 1) text.print("$EndNodes\n$Elements\n{}\n", elements);
      });
  write_in_turns(path, {}, [&](Text& text) {
    for (const int e : labelled) {
      const int group = physical_number(mesh.edge_tag[e]);
      text.print("{} 1 2 {} {} {} {}\n", ++line, group, group, nodes.row()[mesh.edges(e, 0)] + 1,
                 nodes.row()[mesh.edges(e, 1)] + 1);
    }
  });
  write_in_turns(path, {}, [&](Text& text) {
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const int group = static_cast<int>(mesh.region[t]);
      text.print("{} 2 2 {} {} {} {} {}\n", ++triangle, group, group,
                 nodes.row()[mesh.triangles(t, 0)] + 1, nodes.row()[mesh.triangles(t, 1)] + 1,
                 nodes.row()[mesh.triangles(t, 2)] + 1);
    }
    if (rank() == ranks() - 1) text.print("$EndElements\n");
  });
}

}  // namespace antilock::distributed
