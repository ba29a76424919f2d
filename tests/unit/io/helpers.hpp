#pragma once
#include <Eigen/Core>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace antilock::test::io_test {

namespace fs = std::filesystem;

using Rows =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// The numbers of a file, which holds nothing else but white space; of a table below `header`,
/// commas.
inline std::vector<double> numbers(const fs::path& path, const std::string& header = "") {
  std::string text = contents(path);
  EXPECT_EQ(text.substr(0, header.size()), header);
  if (!header.empty()) std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<double> found;
  std::istringstream in(text.substr(header.size()));
  for (std::string word; in >> word;) {
    const auto [end, error] =
        std::from_chars(word.data(), word.data() + word.size(), found.emplace_back());
    EXPECT_TRUE(error == std::errc{} && end == word.data() + word.size()) << word;
  }
  return found;
}

}  // namespace antilock::test::io_test
