// Reading tables of numbers.
#include "render/scene/yaml/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "render/scene/values/characters.h"
#include "render/scene/values/scalars.h"
#include "render/scene/yaml/include.h"

namespace lekalo::render {

namespace {

struct Cell {
  std::size_t offset;  // in the line
  std::string_view text;
};

std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t") == std::string_view::npos; }

// Cells of a line; with commas they may be empty.
void split(std::string_view line, std::vector<Cell>& cells) {
  cells.clear();
  const bool commas = line.find(',') != std::string_view::npos;
  const char* separators = commas ? "," : " \t";
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    std::string_view cell = line.substr(begin, end - begin);
    const std::size_t first = std::min(cell.find_first_not_of(" \t"), cell.size());
    cell = cell.substr(first, cell.find_last_not_of(" \t") + 1 - first);
    if (commas || !cell.empty()) cells.push_back({begin + first, cell});
    begin = end + 1;
  }
}

class TableReader {
 public:
  TableReader(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {
    table_.file = file;
  }

  std::optional<Table> read() {
    const std::size_t errors = diagnostics_.error_count();
    if (const auto bad = find_bad_character(file_->text)) {
      diagnostics_.error(PlaceFinder(file_).at(bad->offset, bad->length), bad->message, bad->hint);
      return std::nullopt;
    }
    for (int number = 1; number <= file_->line_count(); ++number) {
      const std::string_view line = without_comment(file_->line(number));
      if (!is_blank(line))
        read_line(line, number);
      else if (is_blank(file_->line(number)))
        new_block_ = true;  // a line that is only a comment ends no block
    }
    if (table_.lines.empty() && diagnostics_.error_count() == errors)
      diagnostics_.error({file_, 0, 0, 1}, "this table has no rows", "one row of numbers a line: 0.5, 1, 2");
    if (diagnostics_.error_count() > errors) return std::nullopt;
    return std::move(table_);
  }

 private:
  void error(int line, const Cell& cell, std::string message, std::string hint) {
    const std::string_view text = file_->line(line);
    const auto column = static_cast<int>(count_code_points(text.substr(0, cell.offset))) + 1;
    const auto length = std::max(1, static_cast<int>(count_code_points(cell.text)));
    diagnostics_.error({file_, line, column, length}, std::move(message), std::move(hint));
  }

  void read_line(std::string_view line, int number) {
    if (const std::size_t semicolon = line.find(';'); semicolon != std::string_view::npos) {
      error(number, {semicolon, line.substr(semicolon, 1)}, "a ';' in a table of numbers",
            "separate cells by commas or spaces, and write numbers with a decimal point");
      return;
    }
    split(line, cells_);
    if (table_.column_count == 0) {
      table_.column_count = cells_.size();
      if (header()) return;
    }
    if (cells_.size() != table_.column_count) {
      error(number, {0, line},
            fmt::format("this row has {} cells, the first has {}", cells_.size(), table_.column_count),
            "all rows of a table have the same number of cells");
      return;
    }
    if (new_block_ || table_.blocks.empty()) table_.blocks.push_back(table_.row_count());
    new_block_ = false;
    table_.lines.push_back(number);
    for (const Cell& cell : cells_) table_.values.push_back(value(cell, number));
  }

  // The first line holds names if none of its cells begins like a number.
  bool header() {
    for (const Cell& cell : cells_) {
      Value name;
      name.text = cell.text;
      if (!read_name(name)) return false;
    }
    for (const Cell& cell : cells_) table_.columns.emplace_back(cell.text);
    return true;
  }

  double value(const Cell& cell, int line) {
    double number = 0;
    const char* end = cell.text.data() + cell.text.size();
    // The usual case without any allocation; everything else is explained by the rules of scene files.
    const auto [stopped, problem] = std::from_chars(cell.text.data(), end, number);
    const bool plain = !cell.text.empty() && stopped == end && problem == std::errc{} &&
                       (cell.text.front() == '-' || cell.text.front() == '.' ||
                        (cell.text.front() >= '1' && cell.text.front() <= '9'));
    if (plain && cell.text.find_first_of("iInN") == std::string_view::npos) return number;
    if (cell.text.empty()) {
      error(line, cell, "an empty cell", "write a number between the commas");
      return 0;
    }
    const Reading<double> reading = read_number(cell.text);
    if (reading) return *reading;
    const std::string& hint = reading.slip().hint;
    error(line, cell, reading.slip().message,
          hint.empty() ? "below a first row of names all cells are numbers; comments begin with #" : hint);
    return 0;
  }

  std::shared_ptr<const SourceFile> file_;
  Diagnostics& diagnostics_;
  Table table_;
  std::vector<Cell> cells_;
  bool new_block_ = true;
};

}  // namespace

Place Table::place(std::size_t row) const {
  const std::string_view line = file->line(lines[row]);
  return {file, lines[row], 1, std::max(1, static_cast<int>(count_code_points(line)))};
}

std::optional<Table> read_table(const std::shared_ptr<const SourceFile>& file, Diagnostics& diagnostics) {
  return TableReader(file, diagnostics).read();
}

std::optional<Table> read_table(const std::filesystem::path& path, const Place& asked, Diagnostics& diagnostics) {
  std::string reason;
  std::optional<std::string> text = read_file(path, kTableBytes, true, reason);
  if (!text) {
    diagnostics.error(asked, fmt::format("the table '{}' cannot be read: {}", path.string(), reason));
    return std::nullopt;
  }
  return read_table(make_source(path.string(), std::move(*text), path, {}, asked), diagnostics);
}

}  // namespace lekalo::render
