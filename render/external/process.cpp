#include "render/external/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

#include "geometry/describe.h"

namespace lekalo::render {

using geometry::ExternalError;
using geometry::FieldError;
using Clock = std::chrono::steady_clock;

namespace {

// How much of what a program writes to its standard error, or of a line that is no answer, is told.
constexpr size_t kToldBytes = 2000;
constexpr size_t kToldOfLine = 200;

// No answer is longer.
constexpr size_t kLongestLine = 1 << 16;

// With this many answers to come a program is left to itself for a while: woken for each line that it flushes, both
// would spend their time changing places. Its pipe holds what it writes meanwhile.
constexpr size_t kManyAnswers = 100;
constexpr auto kLull = std::chrono::microseconds(300);

// After the end of its input a program may take this long to end by itself.
constexpr auto kFarewell = std::chrono::seconds(1);

// A file of the system that closes itself.
class File {
 public:
  explicit File(int number = -1) : number_(number) {}
  File(File&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  File& operator=(File&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~File() { close(); }
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

FieldError not_started(const std::string& program, int error) {
  return FieldError("command", fmt::format("'{}' cannot be started: {}", program, std::strerror(error)),
                    program.find(' ') == std::string::npos ? "a program in PATH, or its path with a slash: ./evaluator"
                                                           : "write its words apart: [program, argument, ...]");
}

std::string shortened(std::string_view line) {
  return line.size() <= kToldOfLine ? std::string(line) : std::string(line.substr(0, kToldOfLine)) + "...";
}

class Evaluator final : public geometry::ExternalFunction {
 public:
  Evaluator(const std::vector<std::string>& command, int parameter_count, double timeout);
  ~Evaluator() override;
  void evaluate(std::span<const double> places, int order, std::span<double> values) const override;

 private:
  // Waits until the program takes input or gives output, moves both, and says whether there was an answer's line.
  void exchange(std::string_view requests, size_t& sent, Clock::time_point deadline,
                std::span<const double> waiting_for) const;
  bool read_from(File& file, std::string& text) const;
  void take_answer(std::string_view line, std::span<const double> place, std::span<double> values) const;
  // Throws ExternalError with what happened, the place and what the program said.
  [[noreturn]] void fail(const std::string& what, std::span<const double> place) const;
  [[noreturn]] void fail_ended(std::span<const double> place) const;
  // Waits for the program's end, at most so long; whether it has ended.
  bool ended_within(Clock::duration time) const;

  std::string name_;
  size_t parameter_count_;
  Clock::duration timeout_;
  mutable std::mutex mutex_;  // of all below
  mutable pid_t process_ = 0;
  mutable int status_ = 0;
  mutable bool ended_ = false;
  mutable File input_, output_, errors_;
  mutable std::string answers_, said_;
  mutable std::string broken_;  // why no more can be asked
};

Evaluator::Evaluator(const std::vector<std::string>& command, int parameter_count, double timeout)
    : name_(command.front()),
      parameter_count_(static_cast<size_t>(parameter_count)),
      timeout_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout))) {
  int requests[2], answers[2], errors[2];
  // A socket in place of a pipe for what is written: writing to a program that has ended is an error then, no signal.
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, requests) != 0) throw not_started(name_, errno);
  input_ = File(requests[0]);
  const File their_input(requests[1]);
  if (pipe2(answers, O_CLOEXEC) != 0) throw not_started(name_, errno);
  output_ = File(answers[0]);
  const File their_output(answers[1]);
  if (pipe2(errors, O_CLOEXEC) != 0) throw not_started(name_, errno);
  errors_ = File(errors[0]);
  const File their_errors(errors[1]);
  for (const File* file : {&input_, &output_, &errors_}) fcntl(file->number(), F_SETFL, O_NONBLOCK);

  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, their_input.number(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, their_output.number(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, their_errors.number(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A group of its own: Ctrl-C is for the renderer, which still needs its answers to end in order.
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGINT);
  sigaddset(&defaults, SIGTERM);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  const int error = posix_spawnp(&process_, words[0], &actions, &attributes, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw not_started(name_, error);
}

Evaluator::~Evaluator() {
  input_.close();
  output_.close();
  errors_.close();
  if (ended_within(kFarewell)) return;
  kill(-process_, SIGKILL);
  while (waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
  }
}

bool Evaluator::ended_within(Clock::duration time) const {
  const Clock::time_point deadline = Clock::now() + time;
  while (!ended_) {
    const pid_t found = waitpid(process_, &status_, WNOHANG);
    ended_ = found == process_ || (found < 0 && errno == ECHILD);
    if (ended_ || Clock::now() >= deadline) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return ended_;
}

void Evaluator::fail(const std::string& what, std::span<const double> place) const {
  broken_ = fmt::format("'{}' {}", name_, what);
  std::string message = fmt::format("{}; asked for {}", broken_, geometry::place_text(place));
  while (!said_.empty() && said_.back() == '\n') said_.pop_back();
  if (!said_.empty()) message += "\nit said: " + said_;
  throw ExternalError(message);
}

void Evaluator::fail_ended(std::span<const double> place) const {
  // What it said last may still be on its way.
  if (ended_within(kFarewell))
    while (errors_.is_open() && read_from(errors_, said_)) {
    }
  if (!ended_) fail("closed its output", place);
  if (WIFSIGNALED(status_)) fail(fmt::format("was ended by a signal: {}", strsignal(WTERMSIG(status_))), place);
  fail(fmt::format("ended with exit code {}", WEXITSTATUS(status_)), place);
}

// False when nothing can be read now; a file at its end is closed.
bool Evaluator::read_from(File& file, std::string& text) const {
  char buffer[1 << 16];
  const ssize_t count = read(file.number(), buffer, sizeof buffer);
  if (count > 0) {
    text.append(buffer, static_cast<size_t>(count));
    if (&text == &said_ && said_.size() > kToldBytes) said_.erase(0, said_.size() - kToldBytes);
    return true;
  }
  if (count < 0 && errno == EINTR) return true;
  if (count == 0 || errno != EAGAIN) file.close();
  return false;
}

void Evaluator::exchange(std::string_view requests, size_t& sent, Clock::time_point deadline,
                         std::span<const double> waiting_for) const {
  if (!output_.is_open()) fail_ended(waiting_for);
  std::vector<pollfd> files;
  const bool writing = sent < requests.size() && input_.is_open();
  files.push_back({output_.number(), POLLIN, 0});
  if (errors_.is_open()) files.push_back({errors_.number(), POLLIN, 0});
  if (writing) files.push_back({input_.number(), POLLOUT, 0});
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  if (left <= 0)
    fail(fmt::format("gave no answer for {:.9g} s (it must flush each line, or the system keeps it back)",
                     std::chrono::duration<double>(timeout_).count()),
         waiting_for);
  const int ready = poll(files.data(), files.size(), static_cast<int>(std::min<long>(left, 1000)));
  if (ready <= 0) return;
  for (const pollfd& file : files) {
    if (file.revents == 0) continue;
    if (writing && file.fd == input_.number()) {
      const ssize_t count = send(file.fd, requests.data() + sent, requests.size() - sent, MSG_NOSIGNAL);
      if (count > 0) sent += static_cast<size_t>(count);
      // Nobody reads any more: the end of its output will say so.
      if (count < 0 && errno != EAGAIN && errno != EINTR) input_.close();
    } else if (file.fd == output_.number()) {
      read_from(output_, answers_);
    } else {
      read_from(errors_, said_);
    }
  }
}

void Evaluator::take_answer(std::string_view line, std::span<const double> place, std::span<double> values) const {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; };
  size_t count = 0;
  const char *at = line.data(), *const end = at + line.size();
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) break;
    if (*at == '+') ++at;
    double number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (next != end && !is_blank(*next))) {
      if (line.starts_with("error")) fail(fmt::format("answered '{}'", shortened(line)), place);
      fail(fmt::format("answered '{}', where {} numbers are wanted", shortened(line), values.size()), place);
    }
    if (count < values.size()) values[count] = number;
    ++count;
    at = next;
  }
  if (count != values.size())
    fail(fmt::format("answered with {} numbers in place of {}: '{}'", count, values.size(), shortened(line)), place);
}

void Evaluator::evaluate(std::span<const double> places, int order, std::span<double> values) const {
  const size_t count = places.size() / parameter_count_;
  if (count == 0) return;
  const size_t each = values.size() / count;
  const auto place = [&](size_t i) { return places.subspan(i * parameter_count_, parameter_count_); };
  fmt::memory_buffer requests;
  for (size_t i = 0; i < count; ++i) {
    for (const double x : place(i)) fmt::format_to(std::back_inserter(requests), "{} ", x);
    fmt::format_to(std::back_inserter(requests), "{}\n", order);
  }
  const std::lock_guard lock(mutex_);
  if (!broken_.empty()) throw ExternalError(broken_);
  size_t sent = 0, answered = 0, begin = 0;
  Clock::time_point deadline = Clock::now() + timeout_;
  while (answered < count) {
    const size_t end = answers_.find('\n', begin);
    if (end == std::string::npos) {
      answers_.erase(0, begin);
      begin = 0;
      if (answers_.size() > kLongestLine) fail("writes a line without an end", place(answered));
      if (sent > 0 && count - answered > kManyAnswers) std::this_thread::sleep_for(kLull);
      exchange({requests.data(), requests.size()}, sent, deadline, place(answered));
      continue;
    }
    take_answer(std::string_view(answers_).substr(begin, end - begin), place(answered),
                values.subspan(answered * each, each));
    begin = end + 1;
    ++answered;
    deadline = Clock::now() + timeout_;
  }
  answers_.erase(0, begin);
  if (!answers_.empty())
    fail(fmt::format("wrote more than was asked for: '{}'", shortened(answers_)), place(count - 1));
}

}  // namespace

std::shared_ptr<const geometry::ExternalFunction> start_evaluator(const std::vector<std::string>& command,
                                                                  int parameter_count, double timeout) {
  return std::make_shared<Evaluator>(command, parameter_count, timeout);
}

}  // namespace lekalo::render
