#include "render/external/library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <thread>
#include <utility>

#include "geometry/describe.h"
#include "include/lekalo/external.h"

namespace lekalo::render {

namespace fs = std::filesystem;
using geometry::ExternalError;
using geometry::FieldError;

namespace {

// What this thread runs of a library: a function, or nothing yet but what a library does when it is loaded (no place).
struct Running {
  const char* name;
  std::span<const double> place;
};
thread_local const Running* running = nullptr;

using Clock = std::chrono::steady_clock;

// What the watchdog sees of a thread that calls libraries.
struct WatchedThread {
  const pthread_t thread = pthread_self();
  std::atomic<uint64_t> count = 0;  // of beginnings and ends of calls: odd within one
  std::atomic<double> limit = 0;    // of the call, seconds
  uint64_t seen = 0;                // by the watchdog, since when
  Clock::time_point since;

  WatchedThread();
  ~WatchedThread();
  WatchedThread(const WatchedThread&) = delete;
  WatchedThread& operator=(const WatchedThread&) = delete;
};

// Never destroyed: the watchdog looks at them until the process ends.
struct WatchedThreads {
  std::mutex mutex;
  std::set<WatchedThread*> all;
};
WatchedThreads& watched_threads() {
  static WatchedThreads* const threads = new WatchedThreads;
  return *threads;
}
WatchedThread::WatchedThread() {
  const std::lock_guard lock(watched_threads().mutex);
  watched_threads().all.insert(this);
}
WatchedThread::~WatchedThread() {
  const std::lock_guard lock(watched_threads().mutex);
  watched_threads().all.erase(this);
}
thread_local WatchedThread watched_thread;

// Marks a call for as long as it lasts; it may take `limit` seconds.
class Call {
 public:
  Call(const char* name, std::span<const double> place, double limit) : running_{name, place} {
    running = &running_;
    watched_thread.limit.store(limit, std::memory_order_relaxed);
    count();
  }
  ~Call() {
    count();
    running = nullptr;
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

 private:
  static void count() {
    std::atomic<uint64_t>& count = watched_thread.count;
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  Running running_;
};

// How often the watchdog looks, and the signal by which it asks a thread to tell what it is stuck in. A function cannot
// be stopped, so the process ends.
constexpr auto kLook = std::chrono::milliseconds(50);
const int kStuck = SIGRTMAX;
constexpr int kFileError = 4;  // exit code of the command

void tell_and_end(int) {
  std::array<char, 100> what;
  *fmt::format_to_n(what.data(), what.size() - 1, "has not returned for {:.9g} s, its timeout",
                    watched_thread.limit.load(std::memory_order_relaxed))
       .out = 0;
  if (tell_library_call(what.data())) _exit(kFileError);
}

[[noreturn]] void watch() {
  for (;; std::this_thread::sleep_for(kLook)) {
    const std::lock_guard lock(watched_threads().mutex);
    for (WatchedThread* one : watched_threads().all) {
      const uint64_t count = one->count.load(std::memory_order_acquire);
      const Clock::time_point now = Clock::now();
      if (count != std::exchange(one->seen, count)) one->since = now;
      const bool running_long = count % 2 == 1 && std::chrono::duration<double>(now - one->since).count() >=
                                                      one->limit.load(std::memory_order_relaxed);
      if (running_long) pthread_kill(one->thread, kStuck);
    }
  }
}

// Signals by which faulty code ends a process, and what they did before.
constexpr std::array kDeadly{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
std::array<struct sigaction, kDeadly.size()> before;

// Tells who it was, then leaves the signal to whom it went before: by default that is the end of the process.
void tell_and_die(int signal) {
  std::array<char, 100> what;
  const char* description = sigdescr_np(signal);
  *fmt::format_to_n(what.data(), what.size() - 1, "was ended by a signal ({})", description ? description : "?").out =
      0;
  tell_library_call(what.data());
  for (size_t i = 0; i < kDeadly.size(); ++i)
    if (kDeadly[i] == signal) sigaction(signal, &before[i], nullptr);
  raise(signal);
}

void watch_signals() {
  struct sigaction action = {};
  action.sa_handler = tell_and_die;
  for (size_t i = 0; i < kDeadly.size(); ++i) sigaction(kDeadly[i], &action, &before[i]);
  action.sa_handler = tell_and_end;
  action.sa_flags = SA_RESTART;
  sigaction(kStuck, &action, nullptr);
  std::thread(watch).detach();
}

void* load(const fs::path& path, double timeout) {
  static const bool watched = (watch_signals(), true);
  (void)watched;
  const Call call(path.c_str(), {}, timeout);
  return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
}

struct Library {
  void* handle = nullptr;
  std::mutex one_at_a_time;

  Library(const fs::path& path, double timeout) : handle(load(path, timeout)) {
    if (handle) return;
    const char* reason = dlerror();
    throw FieldError("library", fmt::format("cannot be loaded: {}", reason ? reason : "no reason given"),
                     "a shared library for this machine, with all that it needs: cc -shared -fPIC -o NAME.so ...");
  }
  ~Library() { dlclose(handle); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

std::shared_ptr<Library> open_library(const fs::path& path, double timeout) {
  static std::mutex mutex;
  static std::map<fs::path, std::weak_ptr<Library>> opened;
  const fs::path full = fs::weakly_canonical(path);
  const std::lock_guard lock(mutex);
  std::weak_ptr<Library>& known = opened[full];
  std::shared_ptr<Library> library = known.lock();
  if (!library) known = library = std::make_shared<Library>(full, timeout);
  return library;
}

class LibraryFunction final : public geometry::ExternalFunction {
 public:
  LibraryFunction(std::shared_ptr<Library> library, void* symbol, std::string name, int parameter_count,
                  std::vector<double> numbers, bool concurrent, double timeout)
      : library_(std::move(library)),
        symbol_(symbol),
        name_(std::move(name)),
        parameter_count_(static_cast<size_t>(parameter_count)),
        numbers_(std::move(numbers)),
        concurrent_(concurrent),
        timeout_(timeout) {
    numbers_.push_back(std::numeric_limits<double>::quiet_NaN());
  }

  void evaluate(std::span<const double> places, int order, std::span<double> values) const override {
    std::unique_lock lock(library_->one_at_a_time, std::defer_lock);
    if (!concurrent_) lock.lock();
    const size_t count = places.size() / parameter_count_;
    const size_t each = count > 0 ? values.size() / count : 0;
    // What the function forgets to write must not be taken for numbers.
    std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
    for (size_t i = 0; i < count; ++i) {
      const std::span<const double> place = places.subspan(i * parameter_count_, parameter_count_);
      const int code = call(place, order, values.data() + i * each);
      if (code == 0) continue;
      throw ExternalError(
          fmt::format("'{}' returned {} at {}, order {}", name_, code, geometry::place_text(place), order));
    }
  }

 private:
  int call(std::span<const double> place, int order, double* out) const {
    const Call call(name_.c_str(), place, timeout_);
    try {
      if (parameter_count_ == 1) return reinterpret_cast<lekalo_curve*>(symbol_)(numbers_.data(), place[0], order, out);
      return reinterpret_cast<lekalo_surface*>(symbol_)(numbers_.data(), place[0], place[1], order, out);
    } catch (const std::exception& error) {
      throw ExternalError(
          fmt::format("'{}' threw an exception at {}: {}", name_, geometry::place_text(place), error.what()));
    } catch (...) {
      throw ExternalError(fmt::format("'{}' threw an exception at {}", name_, geometry::place_text(place)));
    }
  }

  std::shared_ptr<Library> library_;
  void* symbol_;
  std::string name_;
  size_t parameter_count_;
  std::vector<double> numbers_;
  bool concurrent_;
  double timeout_;
};

}  // namespace

std::shared_ptr<const geometry::ExternalFunction> load_function(const fs::path& path, const std::string& name,
                                                                int parameter_count, std::vector<double> numbers,
                                                                bool concurrent, double timeout) {
  std::shared_ptr<Library> library = open_library(path, timeout);
  void* symbol = dlsym(library->handle, name.c_str());
  if (!symbol)
    throw FieldError("function", fmt::format("there is no function '{}' in {}", name, path.filename().string()),
                     "'nm -D --defined-only' lists what a library offers; functions of C++ need extern \"C\"");
  return std::make_shared<LibraryFunction>(std::move(library), symbol, name, parameter_count, std::move(numbers),
                                           concurrent, timeout);
}

// The heap may be what a crash has spoilt: fmt writes numbers into the array and takes no memory and no locks.
bool tell_library_call(const char* what) {
  if (!running) return false;
  std::array<char, 1000> text;
  const auto [name, place] = *running;
  char* end = fmt::format_to_n(text.data(), 600, "lekalo: '{}' {}", name, what).out;
  if (place.size() == 1) end = fmt::format_to(end, " at t = {:.12g}", place[0]);
  if (place.size() == 2) end = fmt::format_to(end, " at u = {:.12g}, v = {:.12g}", place[0], place[1]);
  if (place.empty()) end = fmt::format_to(end, " while it was loaded");
  *end++ = '\n';
  return write(STDERR_FILENO, text.data(), static_cast<size_t>(end - text.data())) > 0;
}

}  // namespace lekalo::render
