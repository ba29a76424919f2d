#include "programs/subcommands/matrix_market.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/core/input_file.hpp"
#include "antilock/core/plain_text.hpp"

namespace antilock::subcommands {
namespace {

/// The lines of a file that are no comments, and where they stand.
class Lines {
 public:
  explicit Lines(const std::string& path)
      : path_(path), in_(open_file(path, path, "a Matrix Market file")) {}
  bool next(std::istringstream& words) {
    for (std::string line; std::getline(*in_, line);) {
      if (++number_ == 1) line = plain_text(line, path_);
      if (line.empty() || (number_ > 1 && line[0] == '%') ||
          line.find_first_not_of(" \t\r") == std::string::npos)
        continue;
      words = std::istringstream(line);
      return true;
    }
    ++number_;
    return false;
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& accepted) const {
    throw Error(fmt::format("{}: line {}: {}; accepted: {}", path_, number_, what, accepted));
  }

 private:
  std::string path_;
  std::unique_ptr<std::istream> in_;
  int number_ = 0;
};

}  // namespace

SparseMatrix read_matrix(const std::string& path) {
  Lines lines(path);
  std::istringstream words;
  std::string banner, object, format, field, symmetry;
  if (!lines.next(words) || !(words >> banner >> object >> format >> field >> symmetry) ||
      banner != "%%MatrixMarket")
    lines.refuse("no Matrix Market header", "%%MatrixMarket matrix coordinate real general");
  for (std::string* word : {&object, &format, &field, &symmetry})
    std::transform(word->begin(), word->end(), word->begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool coordinate = format == "coordinate", symmetric = symmetry == "symmetric";
  if (object != "matrix" || (!coordinate && format != "array") ||
      (field != "real" && field != "integer") || (!symmetric && symmetry != "general"))
    lines.refuse(fmt::format("\"{} {} {} {}\"", object, format, field, symmetry),
                 "matrix, coordinate or array, real or integer, general or symmetric");
  long rows = 0, columns = 0, entries = 0;
  if (!lines.next(words) || !(words >> rows >> columns) || (coordinate && !(words >> entries)) ||
      rows < 0 || columns < 0 || entries < 0 || rows > 50'000'000 || columns > 50'000'000 ||
      entries > 2'000'000'000)
    lines.refuse("no sizes", coordinate ? "ROWS COLUMNS ENTRIES" : "ROWS COLUMNS");
  if (symmetric && rows != columns)
    lines.refuse(fmt::format("symmetric, and {} x {}", rows, columns), "a square matrix");
  if (!coordinate) entries = symmetric ? rows * (rows + 1) / 2 : rows * columns;
  std::vector<Eigen::Triplet<double>> triplets;
  bool below = false, above = false;  // the diagonal, entries of a symmetric matrix
  long i = 0, j = 0;                  // of the next entry of an array, column by column
  for (long k = 0; k < entries; ++k) {
    double value = 0;
    long row = i + 1, column = j + 1;
    std::string number;
    if (!lines.next(words))
      lines.refuse(fmt::format("the file ends after {} entries of {}", k, entries), "all of them");
    if ((coordinate && !(words >> row >> column)) || !(words >> number))
      lines.refuse("no entry", coordinate ? "ROW COLUMN VALUE" : "VALUE");
    if (std::string more; words >> more)
      lines.refuse(fmt::format("\"{:.40}\" behind the entry", more),
                   coordinate ? "ROW COLUMN VALUE" : "VALUE");
    char* end = nullptr;
    value = std::strtod(number.c_str(), &end);
    if (*end != '\0' || !std::isfinite(value))
      lines.refuse(fmt::format("\"{:.40}\"", number), "a finite number");
    if (row < 1 || row > rows || column < 1 || column > columns)
      lines.refuse(
          fmt::format("the entry ({}, {}) of a matrix {} x {}", row, column, rows, columns),
          "indices from 1");
    below = below || row > column;
    above = above || row < column;
    if (symmetric && below && above)  // an entry and its mirror image would be added up
      lines.refuse("symmetric, and with entries above the diagonal and below",
                   "those of one triangle");
    triplets.emplace_back(int(row - 1), int(column - 1), value);
    if (symmetric && row != column) triplets.emplace_back(int(column - 1), int(row - 1), value);
    if (++i == rows) i = symmetric ? ++j : (++j, 0);
  }
  if (lines.next(words))
    lines.refuse(fmt::format("more than {} entries", entries), "as many as the sizes say");
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

Eigen::VectorXd read_vector(const std::string& path) {
  const SparseMatrix matrix = read_matrix(path);
  if (matrix.cols() == 1) return Eigen::MatrixXd(matrix).col(0);
  if (matrix.rows() == 1) return Eigen::MatrixXd(matrix).row(0).transpose();
  SparseMatrix rest = matrix;
  rest.prune([](Eigen::Index row, Eigen::Index column, double value) {
    return row != column && value != 0;
  });
  if (matrix.rows() != matrix.cols() || rest.nonZeros() > 0)
    throw Error(
        fmt::format("{}: a matrix {} x {}; accepted: one column, one row, or a diagonal matrix",
                    path, matrix.rows(), matrix.cols()));
  return matrix.diagonal();
}

}  // namespace antilock::subcommands
