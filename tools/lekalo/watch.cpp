#include "watch.h"

#include <sys/stat.h>

#include <algorithm>
#include <thread>

namespace lekalo::command {

using namespace std::chrono_literals;

namespace {

constexpr auto kInterval = 200ms;
constexpr auto kRest = 100ms;  // an editor may still be writing

}  // namespace

bool FileWatch::State::operator==(const State& other) const {
  return exists == other.exists && time.tv_sec == other.time.tv_sec && time.tv_nsec == other.time.tv_nsec &&
         size == other.size && number == other.number;
}

FileWatch::State FileWatch::look_at(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return {};
  return {true, status.st_mtim, status.st_size, status.st_ino};
}

bool FileWatch::differs() const {
  return std::any_of(seen_.begin(), seen_.end(), [](const auto& one) { return !(look_at(one.first) == one.second); });
}

void FileWatch::include(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    const auto [known, is_new] = seen_.try_emplace(file);
    if (is_new) known->second = look_at(file);
  }
}

void FileWatch::refresh() {
  for (auto& [file, state] : seen_) state = look_at(file);
  last_answer_ = false;
}

bool FileWatch::changed() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_look_ >= kInterval) {
    last_look_ = now;
    last_answer_ = differs();
  }
  return last_answer_;
}

bool FileWatch::wait(const std::atomic<bool>& stop) {
  while (!differs()) {
    if (stop) return false;
    std::this_thread::sleep_for(kInterval);
  }
  do {
    refresh();
    std::this_thread::sleep_for(kRest);
  } while (differs() && !stop);
  return !stop;
}

}  // namespace lekalo::command
