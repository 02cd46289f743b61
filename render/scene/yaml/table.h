// Tables of numbers beside a scene: `points: { file: net.csv }`.
//
//   u, v, x, y, z        optional line of column names
//   0, 0, 1.5, 0, 2      cells separated by commas, or by spaces and tabs; '#' begins a comment
//
//   0, 1, 1.5, 1, 2      an empty line begins a new block: the next row of a net of points
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/scene/values/diagnostics.h"

namespace lekalo::render {

struct Table {
  std::shared_ptr<const SourceFile> file;
  std::vector<std::string> columns;  ///< names, empty if the file gives none
  std::size_t column_count = 0;
  std::vector<double> values;       ///< row by row
  std::vector<int> lines;           ///< of each row, its line in the file
  std::vector<std::size_t> blocks;  ///< index of the first row of each block

  std::size_t row_count() const { return lines.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * column_count + column]; }
  /// The place of a row, for errors about its numbers.
  Place place(std::size_t row) const;
};

constexpr std::size_t kTableBytes = 256'000'000;  ///< longest table file

/// Reads a table of at least one row, all rows of the same length, all numbers finite. Nothing if there were errors;
/// all of them are reported, each with its line and column.
std::optional<Table> read_table(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics);
/// The same from a file; if it cannot be read, the error is reported at `asked`, the place that names it.
std::optional<Table> read_table(const std::filesystem::path& path, const Place& asked, Diagnostics& diagnostics);

}  // namespace lekalo::render
