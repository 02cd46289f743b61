#include "render/image/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "render/image/image_error.h"

namespace lekalo::render {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

std::string remedy_for(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENOTDIR:
      return "make the folder first, or write elsewhere with -o";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    case ENOSPC:
    case EDQUOT:
      return "free some disk space";
    case EISDIR:
      return "name a file, not a folder";
    default:
      return "try another folder";
  }
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path), target_(path) {
  std::error_code ignored;
  // rename() would replace a link itself, not the file that it stands for.
  if (fs::is_symlink(target_, ignored)) {
    if (const fs::path resolved = fs::weakly_canonical(target_, ignored); !ignored) target_ = resolved;
  }
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::is_directory(status)) fail("cannot write", EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot write", errno);
    return;
  }
  if (fs::exists(status) && ::access(target_.c_str(), W_OK) != 0) fail("cannot replace", errno);
  // The process number keeps two runs apart, the counter two writers of one run.
  static std::atomic<unsigned> counter{0};
  do {
    std::string name(1, '.');
    name.append(target_.filename()).append(1, '.').append(std::to_string(::getpid()));
    name.append(1, '-').append(std::to_string(counter++)).append(".tmp");
    temporary_ = target_.parent_path() / name;
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) {
    const int error_number = errno;
    temporary_.clear();
    fail("cannot write", error_number);
  }
  struct stat old {};
  if (::stat(target_.c_str(), &old) == 0) (void)!::fchmod(descriptor_, old.st_mode & 07777);
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(const void* bytes, std::size_t count) {
  position_ += count;
  buffer_.append(static_cast<const char*>(bytes), count);
  if (buffer_.size() >= kBufferSize) flush();
}

void AtomicFile::seek(std::uint64_t position) {
  if (position == position_) return;
  flush();
  if (::lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0) fail("cannot write", errno);
  position_ = position;
}

void AtomicFile::commit() {
  // A library between us and the caller may have swallowed the exception (OpenEXR does when it closes a file).
  if (error_number_ != 0) fail("cannot write", error_number_);
  flush();
  // Else the new name may reach the disk before the bytes do: after a power cut it would stand for an empty file.
  // Some file systems have nothing to synchronise and say so.
  if (!temporary_.empty() && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
    fail("cannot write", errno);
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail("cannot write", errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot write", errno);
  temporary_.clear();
}

void AtomicFile::flush() {
  const char* next = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t written = ::write(descriptor_, next, left);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("cannot write", errno);
    }
    next += written;
    left -= static_cast<std::size_t>(written);
  }
  buffer_.clear();
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::fail(const std::string& what, int error_number) {
  discard();
  error_number_ = error_number;
  throw ImageError(path_, what + ": " + std::strerror(error_number), remedy_for(error_number));
}

fs::path resolved_path(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  fs::path resolved = fs::weakly_canonical(whole, error);
  if (error) resolved = whole.lexically_normal();
  return resolved.has_filename() ? resolved : resolved.parent_path();  // "folder/" and "folder" are one
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace lekalo::render
