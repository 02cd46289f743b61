// How far a rendering is: one line, rewritten on a terminal, printed now and then when not.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace lekalo::command {

class Progress {
 public:
  // `lines`: for programs that read along, a line "progress 42.5% NAME" a second, whether there is a terminal or not.
  explicit Progress(bool quiet, bool lines = false, std::string name = "");
  void operator()(double done, uint64_t rays);
  // Of work without rays.
  void operator()(double done);
  // Clears the line.
  void end() const;

 private:
  void show(double done, const std::string& speed);

  bool quiet_, lines_, terminal_, shown_ = false;
  std::string name_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), last_ = begin_;
};

}  // namespace lekalo::command
