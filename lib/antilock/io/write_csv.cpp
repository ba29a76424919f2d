// The mesh as MSH 2.2 (gmsh and this library's reader) and in FreeFEM's own format, with one
// numbering; tables as CSV.
#include "antilock/io/write_csv.hpp"

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/text.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

void write_csv(const std::filesystem::path& path, const std::vector<std::string>& header,
               const Eigen::MatrixXd& rows) {
  if (header.empty() || static_cast<Eigen::Index>(header.size()) != rows.cols())
    throw Error(
        fmt::format("{}: {} names for {} columns; accepted: one name per column, at least one",
                    path.string(), header.size(), rows.cols()));
  for (const std::string& name : header)
    if (name.empty() || name.find_first_of(",\"\n\r") != std::string::npos)
      throw Error(
          fmt::format("{}: column name {:?} is empty or holds a comma, a quote or a line end",
                      path.string(), std::string_view(name)));
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("{}\n", fmt::join(header, ","));
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      for (Eigen::Index j = 0; j < rows.cols(); ++j)
        text.print(FMT_COMPILE("{}{}"), rows(i, j), j + 1 < rows.cols() ? ',' : '\n');
  });
}

void write_solution_csv(const std::filesystem::path& path, const Space& space,
                        const Eigen::VectorXd& u) {
  const bool two_components = u.size() == 2 * space.size() && space.element().nodal();
  if ((u.size() != space.size() && !two_components) || !u.allFinite())
    throw Error(
        fmt::format("{}: u must be {} finite values, one an unknown; it has {}, {} of them finite",
                    path.string(), space.size(), u.size(), u.array().isFinite().count()));
  std::vector<std::string> header{"x", "y"};
  if (space.mesh().dimension() == 3) header.emplace_back("z");
  const auto write = [&](const std::vector<std::string>& names, const Eigen::MatrixXd& values) {
    header.insert(header.end(), names.begin(), names.end());
    Eigen::MatrixXd rows(space.size(), static_cast<Eigen::Index>(header.size()));
    rows << space.dof_coordinates(), values;
    write_csv(path, header, rows);
  };
  if (!space.element().nodal()) {
    Eigen::MatrixXd values(space.size(), 2);
    values << values_at_dofs(space, u), u;
    return write({"u", "mean"}, values);
  }
  if (two_components) return write({"u_x", "u_y"}, u.reshaped(space.size(), 2));
  write({"u"}, u);
}

}  // namespace antilock
