// Tables.
#include <Eigen/Core>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "antilock/io/write_csv.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"
#include "unit/io/helpers.hpp"

namespace antilock::test::io_test::write_csv_test {

using Rows =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

TEST(WriteCsv, EveryDoubleReadsBackBitEqual) {
  const TemporaryFolder folder;
  constexpr int rows = 2000;
  Eigen::MatrixXd table = Eigen::MatrixXd::Random(rows, 3);
  for (int i = 0; i < rows; ++i) table(i, 0) *= std::pow(10.0, i % 600 - 300);
  table.row(0) << std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(),
      -0.0;
  write_csv(folder / "t.csv", {"a", "b", "c"}, table);
  const std::vector<double> back = numbers(folder / "t.csv", "a,b,c\n");
  ASSERT_EQ(back.size(), 3U * rows);
  EXPECT_EQ(Rows(back.data(), rows, 3), table);
  EXPECT_TRUE(std::signbit(back[2])) << "of -0.0";
}

TEST(WriteCsv, HeadersThatDoNotFitAreRefused) {
  const TemporaryFolder folder;
  const Eigen::MatrixXd table = Eigen::MatrixXd::Zero(2, 2);
  const std::vector<std::vector<std::string>> bad = {{},           {"x"},         {"x", "y", "z"},
                                                     {"x", "y,z"}, {"x", "a\nb"}, {"x", ""}};
  for (const auto& header : bad) {
    const std::string message = refusal([&] { write_csv(folder / "t.csv", header, table); });
    EXPECT_NE(message.find("t.csv: "), message.npos);
    EXPECT_EQ(message.find('\n'), message.npos);
  }
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(WriteSolutionCsv, HoldsOneRowAnUnknownAtItsPlace) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = structured_mesh(3);
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const Eigen::VectorXd u = Eigen::VectorXd::Random(space.size());
    write_solution_csv(folder / "solution.csv", space, u);
    const std::vector<double> n = numbers(folder / "solution.csv", "x,y,u\n");
    ASSERT_EQ(n.size(), 3U * space.size());
    const Rows rows(n.data(), space.size(), 3);
    EXPECT_EQ(rows.leftCols(2), space.dof_coordinates());
    EXPECT_EQ(rows.col(2), u);
  }
}

TEST(Writers, ASolutionOfTheWrongSizeOrNotFiniteIsNeverWritten) {
  const TemporaryFolder folder;
  const Space space(structured_mesh(2), p1());
  Eigen::VectorXd nan = Eigen::VectorXd::Zero(space.size());
  nan(1) = std::nan("");
  for (const Eigen::VectorXd& u : {nan, Eigen::VectorXd(Eigen::VectorXd::Zero(space.size() - 1))}) {
    EXPECT_NE(refusal([&] { write_solution_csv(folder / "u.csv", space, u); }), "");
    EXPECT_NE(refusal([&] { write_vtu(folder / "u.vtu", space, u); }), "");
  }
  EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace antilock::test::io_test::write_csv_test
