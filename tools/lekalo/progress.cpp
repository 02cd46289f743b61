#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace lekalo::command {

namespace {

constexpr double kForetells = 0.01;  // the part that says how long the rest will take: what has hardly begun does not

std::string duration(double seconds) {
  const int s = static_cast<int>(std::ceil(seconds));
  return s < 60     ? fmt::format("{} s", s)
         : s < 3600 ? fmt::format("{} min {} s", s / 60, s % 60)
                    : fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

}  // namespace

Progress::Progress(bool quiet, bool lines, std::string name)
    : quiet_(quiet), lines_(lines), terminal_(isatty(STDERR_FILENO) != 0), name_(std::move(name)) {}

void Progress::operator()(double done, uint64_t rays) {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  show(done, fmt::format("  {:.2f} Mrays/s", static_cast<double>(rays) / std::max(elapsed, 1e-9) / 1e6));
}

void Progress::operator()(double done) { show(done, {}); }

void Progress::show(double done, const std::string& speed) {
  // Of what has not begun nothing is known.
  if ((quiet_ && !lines_) || !(done > 0)) return;
  const auto now = std::chrono::steady_clock::now();
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const double since = std::chrono::duration<double>(now - last_).count();
  if (lines_) {
    if (since < 1 && done < 1) return;
    last_ = now;
    fmt::print(stderr, "progress {:.1f}%{}{}\n", 100 * done, name_.empty() ? "" : " ", name_);
    return;
  }
  if (since < (terminal_ ? 0.2 : 10.0)) return;
  last_ = now;
  const std::string left = done < kForetells ? "" : fmt::format("  {} left", duration(elapsed * (1 - done) / done));
  fmt::print(stderr, "{}{:3.0f}%{}{}{}", terminal_ ? "\r" : "", 100 * done, speed, left, terminal_ ? "   " : "\n");
  std::fflush(stderr);
  shown_ = true;
}

void Progress::end() const {
  if (shown_ && terminal_) fmt::print(stderr, "\r{:60}\r", "");
}

}  // namespace lekalo::command
