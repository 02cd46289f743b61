// Running a suite: every test in a child process, as many at a time as asked for. A test that hangs is ended at its
// time limit and one that crashes takes no other with it. The children are forks: this process has no threads before
// the last of them has ended (nothing here renders or compares), which is what makes a fork without exec safe.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "suite.h"

namespace lekalo::command {

namespace fs = std::filesystem;
using nlohmann::json;
using render::Suite;
using render::SuiteTest;
using Clock = std::chrono::steady_clock;

namespace {

std::atomic<bool> interrupted{false};

void interrupt(int) { interrupted = true; }

std::string packed(const TestResult& result) {
  return json{static_cast<int>(result.verdict), result.figures, result.messages, result.has_picture}.dump(
      -1, ' ', false, json::error_handler_t::replace);
}

// False if the text is not what packed() writes: the child did not come to its end.
bool unpack(const std::string& text, TestResult& result) {
  const json values = json::parse(text, nullptr, false);
  if (!values.is_array() || values.size() != 4) return false;
  result.verdict = static_cast<Verdict>(values[0].get<int>());
  result.figures = values[1].get<std::string>();
  result.messages = values[2].get<std::vector<std::string>>();
  result.has_picture = values[3].get<bool>();
  return true;
}

void write_all(int file, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) return;  // the parent sees that something is missing
    if (count > 0) done += static_cast<size_t>(count);
  }
}

struct Child {
  pid_t process = 0;
  int pipe = -1;
  size_t test = 0;
  Clock::time_point begin, deadline;
  std::string text;
};

class SuiteRun {
 public:
  SuiteRun(const Suite& suite, const RunOptions& options);
  ~SuiteRun();
  std::optional<std::vector<TestResult>> run();

 private:
  enum class State { unwanted, waiting, running, done };

  void start_ready();
  bool is_ready(size_t test);
  void start(size_t test);
  void wait_for_children();
  void read_from(Child& child);
  void end(Child& child, bool too_slow);
  void finish(size_t test, TestResult result);
  size_t index_of(const std::string& name) const;

  const Suite& suite_;
  const RunOptions& options_;
  std::vector<State> states_;
  std::vector<TestResult> results_;
  std::set<std::string> selected_;
  std::vector<Child> children_;
  struct sigaction before_int_ = {}, before_term_ = {};
};

SuiteRun::SuiteRun(const Suite& suite, const RunOptions& options)
    : suite_(suite),
      options_(options),
      states_(suite.tests.size(), State::unwanted),
      results_(suite.tests.size()),
      selected_(options.selected.begin(), options.selected.end()) {
  for (const std::string& name : selected_)
    for (const SuiteTest* test = suite.find(name); test; test = suite.find(test->against)) {
      State& state = states_[index_of(test->name)];
      if (state == State::waiting) break;
      state = State::waiting;
    }
  struct sigaction action = {};
  action.sa_handler = interrupt;
  sigaction(SIGINT, &action, &before_int_);
  sigaction(SIGTERM, &action, &before_term_);
}

SuiteRun::~SuiteRun() {
  for (const Child& child : children_) {
    kill(child.process, SIGKILL);
    waitpid(child.process, nullptr, 0);
    close(child.pipe);
  }
  sigaction(SIGINT, &before_int_, nullptr);
  sigaction(SIGTERM, &before_term_, nullptr);
}

size_t SuiteRun::index_of(const std::string& name) const {
  return static_cast<size_t>(suite_.find(name) - suite_.tests.data());
}

// A test waits for the one that it is compared with.
bool SuiteRun::is_ready(size_t test) {
  if (states_[test] != State::waiting) return false;
  const std::string& against = suite_.tests[test].against;
  if (against.empty() || !selected_.count(suite_.tests[test].name)) return true;
  const size_t other = index_of(against);
  if (states_[other] != State::done) return false;
  if (results_[other].has_picture) return true;
  TestResult result;
  result.name = suite_.tests[test].name;
  result.verdict = Verdict::failed;
  result.messages = {fmt::format("'{}', which it is compared with, made no picture", against)};
  finish(test, std::move(result));
  return false;
}

void SuiteRun::start(size_t test) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(fmt::format("cannot start a test: {}", std::strerror(errno)));
  std::error_code ignored;
  // What an earlier run left must not be taken for the picture of this one.
  fs::remove(result_file(suite_, suite_.tests[test].name), ignored);
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error(fmt::format("cannot start a test: {}", std::strerror(errno)));
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    close(ends[0]);
    const SuiteTest& own = suite_.tests[test];
    write_all(ends[1],
              packed(run_test(suite_, own, options_.threads, selected_.count(own.name) > 0, options_.allow_external)));
    _exit(0);
  }
  close(ends[1]);
  states_[test] = State::running;
  const Clock::time_point now = Clock::now();
  const auto limit =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(suite_.tests[test].time_limit));
  children_.push_back({process, ends[0], test, now, now + limit, {}});
}

void SuiteRun::start_ready() {
  for (size_t test = 0; test < states_.size(); ++test)
    if (static_cast<int>(children_.size()) < options_.jobs && is_ready(test)) start(test);
}

void SuiteRun::finish(size_t test, TestResult result) {
  states_[test] = State::done;
  results_[test] = std::move(result);
  if (options_.finished && selected_.count(suite_.tests[test].name)) options_.finished(results_[test]);
}

void SuiteRun::end(Child& child, bool too_slow) {
  const SuiteTest& test = suite_.tests[child.test];
  if (too_slow) kill(child.process, SIGKILL);
  int status = 0;
  while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
  }
  close(child.pipe);
  child.pipe = -1;
  TestResult result;
  result.name = test.name;
  result.seconds = std::chrono::duration<double>(Clock::now() - child.begin).count();
  if (too_slow) {
    result.verdict = Verdict::failed;
    result.messages = {fmt::format("not done after {:.4g} s, its time_limit", test.time_limit)};
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !unpack(child.text, result)) {
    result.verdict = Verdict::failed;
    result.messages = {WIFSIGNALED(status) ? fmt::format("crashed: {}", strsignal(WTERMSIG(status)))
                                           : std::string("ended without a result")};
  }
  finish(child.test, std::move(result));
}

void SuiteRun::read_from(Child& child) {
  char buffer[4096];
  const ssize_t count = read(child.pipe, buffer, sizeof buffer);
  if (count > 0)
    child.text.append(buffer, static_cast<size_t>(count));
  else if (count == 0 || (errno != EINTR && errno != EAGAIN))
    end(child, false);
}

void SuiteRun::wait_for_children() {
  std::vector<pollfd> files;
  Clock::time_point first = Clock::time_point::max();
  for (const Child& child : children_) {
    files.push_back({child.pipe, POLLIN, 0});
    first = std::min(first, child.deadline);
  }
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(first - Clock::now()).count() + 1;
  const int ready = poll(files.data(), files.size(), static_cast<int>(std::clamp<long>(left, 0, 1000)));
  for (size_t i = 0; i < children_.size(); ++i) {
    if (ready > 0 && files[i].revents != 0)
      read_from(children_[i]);
    else if (Clock::now() >= children_[i].deadline)
      end(children_[i], true);
  }
  std::erase_if(children_, [](const Child& child) { return child.pipe < 0; });
}

std::optional<std::vector<TestResult>> SuiteRun::run() {
  for (;;) {
    if (interrupted) return std::nullopt;
    start_ready();
    // A test that cannot be compared is done without having run; others may have waited for it.
    if (children_.empty() && std::none_of(states_.begin(), states_.end(), [](State s) { return s == State::waiting; }))
      break;
    if (!children_.empty()) wait_for_children();
  }
  std::vector<TestResult> results;
  for (size_t test = 0; test < states_.size(); ++test)
    if (selected_.count(suite_.tests[test].name)) results.push_back(std::move(results_[test]));
  return results;
}

}  // namespace

std::optional<std::vector<TestResult>> run_suite(const Suite& suite, const RunOptions& options) {
  RunOptions settled = options;
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (settled.threads == 0) settled.threads = std::max(1, cores / settled.jobs);
  return SuiteRun(suite, settled).run();
}

}  // namespace lekalo::command
