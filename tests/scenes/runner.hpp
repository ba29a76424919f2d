#pragma once
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "support/temporary_folder.hpp"

namespace antilock::test {

struct Outcome {
  int status;
  std::string out, err;
};

inline std::string in_shell(const std::string& text) { return "'" + text + "'"; }

/// Runs run_scene with the given arguments (already quoted), its output caught beside `folder`'s
/// results.
Outcome run_scene(const std::string& arguments, const TemporaryFolder& log);
/// The same of antilock, the program with subcommands.
Outcome run_antilock(const std::string& arguments, const TemporaryFolder& log);

/// A scene text, run in a folder of its own: the scene file alone stands in `input`, the results go
/// to `results`.
class SceneRun {
 public:
  explicit SceneRun(const std::string& scene, const std::string& file = "scene.toml");
  nlohmann::json summary()
      const;  ///< of a run that ended well; who reads it includes nlohmann/json.hpp

  TemporaryFolder input, output;
  std::string scene_path;
  std::filesystem::path results;
  Outcome outcome;

 private:
  TemporaryFolder log_;
};

/// No answer: the status, one line on standard error that holds `says`, and nothing written.
void expect_no_answer(const SceneRun& run, const std::string& says, int status = 2);

struct Csv {
  std::string header;
  Eigen::MatrixXd rows;
};
Csv read_csv(const std::filesystem::path& path);

}  // namespace antilock::test
