#include "scenes/runner.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

namespace antilock::test {

namespace {

Outcome run(const std::string& program, const std::string& arguments, const TemporaryFolder& log) {
  const std::string command = in_shell(program) + " " + arguments + " >" + in_shell(log / "out") +
                              " 2>" + in_shell(log / "err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(log / "out"),
          contents(log / "err")};
}

}  // namespace

Outcome run_scene(const std::string& arguments, const TemporaryFolder& log) {
  return run(RUN_SCENE, arguments, log);
}
Outcome run_antilock(const std::string& arguments, const TemporaryFolder& log) {
  return run(ANTILOCK_PROGRAM, arguments, log);
}

SceneRun::SceneRun(const std::string& scene, const std::string& file) {
  std::ofstream(input / file, std::ios::binary) << scene;
  scene_path = (input / file).string();
  results = output / "results";
  outcome = run_scene(in_shell(scene_path) + " --out " + in_shell(results.string()), log_);
}

nlohmann::json SceneRun::summary() const {
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(contents(results / "summary.json"));
}

void expect_no_answer(const SceneRun& run, const std::string& says, int status) {
  const std::string& err = run.outcome.err;
  EXPECT_EQ(run.outcome.status, status) << says;
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  EXPECT_TRUE(err.ends_with('\n')) << err;
  EXPECT_NE(err.find(says), err.npos) << says << ": " << err;
  EXPECT_TRUE(std::filesystem::is_empty(run.output.path())) << "something was written";
}

Csv read_csv(const std::filesystem::path& path) {
  std::istringstream text(contents(path));
  Csv csv;
  std::getline(text, csv.header);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      rows.back().push_back(std::stod(field));
  }
  const auto columns = rows.empty() ? 0 : rows.front().size();
  csv.rows.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].size(), columns) << path << " row " << i;
    for (std::size_t j = 0; j < columns; ++j) csv.rows(i, j) = rows[i][j];
  }
  return csv;
}

}  // namespace antilock::test
