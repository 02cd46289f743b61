// Noticing that files change, for --watch: by looking at them five times a second, which works on every file system and
// for editors that replace a file as well as for those that write into it.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <vector>

namespace lekalo::command {

class FileWatch {
 public:
  // Further files, from now on; those known already keep the state that they were seen in.
  void include(const std::vector<std::filesystem::path>& files);
  // Sees all files as they are now: call before they are read.
  void refresh();
  // Whether a file differs from what was seen. Looks at most five times a second, else repeats its last answer.
  bool changed();
  // Returns when a file has changed and has been at rest for a moment, or when `stop` is set (then false).
  bool wait(const std::atomic<bool>& stop);
  size_t count() const { return seen_.size(); }

 private:
  struct State {
    bool exists = false;
    timespec time{};
    off_t size = 0;
    ino_t number = 0;
    bool operator==(const State& other) const;
  };
  static State look_at(const std::filesystem::path& file);
  bool differs() const;

  std::map<std::filesystem::path, State> seen_;
  std::chrono::steady_clock::time_point last_look_{};
  bool last_answer_ = false;
};

}  // namespace lekalo::command
