// The part of TBB that the program uses, on std::thread, for builds under the thread sanitizer: Debian's libtbb is not
// instrumented, so the sanitizer does not see how its tasks are ordered and would call every hand-over of work a race.
// What runs in parallel, and what it may touch, stays the program's own.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace tbb {

template <class T>
class blocked_range {
 public:
  blocked_range(T begin, T end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  T begin() const { return begin_; }
  T end() const { return end_; }
  std::size_t grainsize() const { return grain_; }

 private:
  T begin_, end_;
  std::size_t grain_;
};

struct simple_partitioner {};

// Threads of the arena that is being executed.
inline std::atomic<int> arena_threads{4};

class task_arena {
 public:
  static constexpr int automatic = -1;
  explicit task_arena(int threads = automatic) : threads_(threads == automatic ? 4 : threads) {}
  template <class Function>
  void execute(const Function& function) {
    const int before = arena_threads.exchange(threads_);
    function();
    arena_threads = before;
  }

 private:
  int threads_;
};

namespace this_task_arena {
inline int max_concurrency() { return arena_threads; }
}  // namespace this_task_arena

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t) {}
};

template <class T, class Body>
void parallel_for(const blocked_range<T>& range, const Body& body, const simple_partitioner& = {}) {
  std::atomic<T> next{range.begin()};
  const auto work = [&] {
    for (;;) {
      const T from = next.fetch_add(static_cast<T>(range.grainsize()));
      if (from >= range.end()) return;
      body(blocked_range<T>(from, std::min<T>(from + static_cast<T>(range.grainsize()), range.end())));
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < arena_threads; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
}

}  // namespace tbb
