// Processor time of work, the least of several runs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>

namespace lekalo::benchmarks {

inline double seconds(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Of one thread. The work returns a count, so that it cannot be left out.
class Timed {
 public:
  template <class Work>
  void run(const Work& work) {
    const double begin = seconds(CLOCK_THREAD_CPUTIME_ID);
    result_ = work();
    least_ = std::min(least_, seconds(CLOCK_THREAD_CPUTIME_ID) - begin);
  }
  double least() const { return least_; }
  size_t result() const { return result_; }

 private:
  double least_ = 1e300;
  size_t result_ = 0;
};

}  // namespace lekalo::benchmarks
