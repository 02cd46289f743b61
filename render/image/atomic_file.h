// Writing a file so that its name never stands for half a file: the bytes go to a temporary file in the same folder,
// which takes the final name in one step (rename, POSIX.1) when all of them have been written. Used by every writer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lekalo::render {

// Without commit() (an exception, an early return) the temporary file vanishes and an older file of that name stays
// as it was. Symbolic links are followed; devices and pipes (/dev/stdout) are written directly.
// A new file has the usual permissions (0666 less umask), a replaced one keeps its own. The bytes are
// on the disk before the name is: after a power cut it stands for the old file or the new one.
class AtomicFile {
 public:
  // Throws ImageError if the folder does not exist or cannot be written to.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  // Throw ImageError (disk full, ...).
  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  // Position for the next write, from the beginning of the file; formats with tables of offsets need it.
  void seek(std::uint64_t position);
  std::uint64_t position() const { return position_; }

  // Gives the file its name. Throws ImageError; nothing is left behind then.
  void commit();

 private:
  void flush();
  void discard() noexcept;
  [[noreturn]] void fail(const std::string& what, int error_number);

  std::filesystem::path path_;       // as the user wrote it, for messages
  std::filesystem::path target_;     // links resolved
  std::filesystem::path temporary_;  // empty for devices and pipes, and after commit()
  int descriptor_ = -1;
  std::string buffer_;
  std::uint64_t position_ = 0;
  int error_number_ = 0;  // of the first failure
};

// Where `path` leads, whether it exists or not: absolute, links resolved. Two names of one file give the same.
std::filesystem::path resolved_path(const std::filesystem::path& path);

// The whole of `text` at once.
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace lekalo::render
