#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <Eigen/Dense>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace antilock::test {

struct Outcome {
  int status;
  std::string out, err;
};

inline std::string in_shell(const std::string& text) { return "'" + text + "'"; }

/// Runs run_scene with the given arguments (already quoted), its output caught beside `folder`'s results.
inline Outcome run_scene(const std::string& arguments, const TemporaryFolder& log) {
  const std::string command =
      in_shell(RUN_SCENE) + " " + arguments + " >" + in_shell(log / "out") + " 2>" + in_shell(log / "err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(log / "out"), contents(log / "err")};
}

/// A scene text, run in a folder of its own: the scene file alone stands in `input`, the results go to `results`.
class SceneRun {
 public:
  explicit SceneRun(const std::string& scene, const std::string& file = "scene.toml") {
    std::ofstream(input / file, std::ios::binary) << scene;
    scene_path = (input / file).string();
    results = output / "results";
    outcome = run_scene(in_shell(scene_path) + " --out " + in_shell(results.string()), log_);
  }
  nlohmann::json summary() const { return nlohmann::json::parse(contents(results / "summary.json")); }

  TemporaryFolder input, output;
  std::string scene_path;
  std::filesystem::path results;
  Outcome outcome;

 private:
  TemporaryFolder log_;
};

struct Csv {
  std::string header;
  Eigen::MatrixXd rows;
};

inline Csv read_csv(const std::filesystem::path& path) {
  std::istringstream text(contents(path));
  Csv csv;
  std::getline(text, csv.header);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
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
