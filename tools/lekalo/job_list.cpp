#include "job_list.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>
#include <vector>

#include "command.h"
#include "render/image/image_error.h"

extern char** environ;

namespace lekalo::command {

namespace {

struct Job {
  std::string line;
  std::vector<std::string> words, outputs;
};

// As a POSIX shell reads them, without variables: blanks part words, between ' ' all characters are plain.
std::vector<std::string> words_of(const std::string& line, const std::string& place) {
  std::vector<std::string> words;
  bool quoted = false, inside = false;
  for (const char c : line) {
    if (c == '\'') {
      quoted = !quoted;
      if (!inside) words.emplace_back();
      inside = true;
    } else if (!quoted && (c == ' ' || c == '\t' || c == '\r')) {
      inside = false;
    } else {
      if (!inside) words.emplace_back();
      inside = true;
      words.back() += c;
    }
  }
  if (quoted) throw UsageError(fmt::format("{}: a ' is not closed", place));
  return words;
}

Job job_of(const std::string& line, const std::string& place) {
  Job job{line, words_of(line, place), {}};
  const std::string& command = job.words.front();
  if (command != "draw" && command != "render" && command != "make")
    throw UsageError(fmt::format("{}: expected draw, render or make, found '{}'", place, command));
  for (const std::string& word : job.words)
    if (word == "--list" || word.starts_with("--list="))
      throw UsageError(fmt::format("{}: a list makes no other list: put its lines here", place));
  for (size_t i = 0; i + 1 < job.words.size(); ++i)
    if (job.words[i] == "-o" || job.words[i] == "--output") job.outputs.push_back(job.words[i + 1]);
  if (job.outputs.empty()) throw UsageError(fmt::format("{}: the command has no -o FILE", place));
  return job;
}

bool is_missing(const Job& job) {
  std::error_code ignored;
  return std::any_of(job.outputs.begin(), job.outputs.end(),
                     [&](const std::string& file) { return !std::filesystem::exists(file, ignored); });
}

std::vector<Job> missing_jobs(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw render::ImageError(file, std::strerror(errno), "name a list of commands");
  std::vector<Job> jobs;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    Job job = job_of(line, fmt::format("{}:{}", file, number));
    const auto same = [&](const Job& other) { return other.outputs == job.outputs; };
    if (is_missing(job) && std::none_of(jobs.begin(), jobs.end(), same)) jobs.push_back(std::move(job));
  }
  return jobs;
}

// The exit code; of a command that was killed or cannot be run that of a file error.
int run(const Job& job) {
  for (const std::string& output : job.outputs) {
    std::error_code ignored;  // the command itself says what cannot be written
    const std::filesystem::path folder = std::filesystem::path(output).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  }
  std::vector<std::string> words = job.words;
  words.insert(words.begin(), "lekalo");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  if (posix_spawn(&process, "/proc/self/exe", nullptr, nullptr, arguments.data(), environ) != 0) return kFileError;
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return kFileError;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kFileError;
}

}  // namespace

int make_listed(const std::string& file, bool quiet) {
  const std::vector<Job> jobs = missing_jobs(file);
  std::atomic<size_t> next{0};
  std::mutex mutex;
  int worst = kDone;
  const auto work = [&] {
    for (size_t i = next++; i < jobs.size(); i = next++) {
      const int code = run(jobs[i]);
      std::lock_guard lock(mutex);
      worst = std::max(worst, code);
      if (code != kDone)
        fmt::print(stderr, "lekalo: failed with exit code {}: lekalo {}\n", code, jobs[i].line);
      else if (!quiet)
        for (const std::string& output : jobs[i].outputs) fmt::print(stderr, "{}\n", output);
    }
  };
  std::vector<std::jthread> workers;
  for (size_t i = 0; i < std::clamp<size_t>(std::thread::hardware_concurrency(), 1, std::max<size_t>(jobs.size(), 1));
       ++i)
    workers.emplace_back(work);
  workers.clear();
  return worst;
}

}  // namespace lekalo::command
