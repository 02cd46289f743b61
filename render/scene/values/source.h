// Source texts of scene files and places in them: what every error message points at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::render {

struct SourceFile;

/// A stretch of one line of a source file. Without a file it is no place at all; with line 0 it is the file as a whole.
struct Place {
  std::shared_ptr<const SourceFile> file;
  int line = 0;    ///< from 1
  int column = 0;  ///< from 1, in code points
  int length = 1;  ///< in code points, at least 1; may reach beyond the line, the display cuts it
};

/// File and line, for messages that show no text: "ring.yaml:5".
std::string where(const Place& place);

/// One text that scene values come from. The same file included twice is two SourceFiles: they differ in `scope`.
struct SourceFile {
  std::string name;            ///< as messages show it
  std::filesystem::path path;  ///< where it was read from; empty for texts that are no files
  std::string text;            ///< without byte order mark, every line ends in '\n' alone
  std::string scope;           ///< prefix of the names that this text defines ("bolt", "bolt.head"), empty at the top
  Place included_from;         ///< the `include` entry that brought it in; no file for the main one
  std::vector<std::uint32_t> line_starts;  ///< byte offset of each line

  int line_count() const { return static_cast<int>(line_starts.size()); }
  /// Line `number` (from 1) without its line break; empty outside the text.
  std::string_view line(int number) const;
};

/// Makes a source of `text`, which may carry a byte order mark and any kind of line break. At most 2^32 - 1 bytes.
std::shared_ptr<const SourceFile> make_source(std::string name, std::string text, std::filesystem::path path = {},
                                              std::string scope = {}, Place included_from = {});

/// Turns byte offsets of one source into places. Offsets that do not decrease cost time linear in the text together,
/// which matters for files that are one line of a hundred megabytes.
class PlaceFinder {
 public:
  explicit PlaceFinder(std::shared_ptr<const SourceFile> file) : file_(std::move(file)) {}
  /// The place of `length` bytes from byte `offset`, cut at the end of the line.
  Place at(std::size_t offset, std::size_t length = 1);

 private:
  std::shared_ptr<const SourceFile> file_;
  std::size_t line_ = 0;    // index of the line of the last answer
  std::size_t offset_ = 0;  // byte offset of the last answer
  int column_ = 1;          // its column
};

}  // namespace lekalo::render
