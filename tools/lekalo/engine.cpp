#include "engine.h"

#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "command.h"
#include "render/trace/device.h"

namespace lekalo::command {

namespace {

// What glibc's mathematical functions are chosen by (glibc 2.36, sysdeps/x86_64/fpu/multiarch).
constexpr const char* kPlainFunctions = "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4";

void start_again_with_plain_functions() {
  const char* given = std::getenv("GLIBC_TUNABLES");
  const std::string tunables = given ? given : "";
  if (tunables.find(kPlainFunctions) != std::string::npos) return;
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string line((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::vector<std::string> words;
  for (size_t begin = 0; begin < line.size(); begin += words.back().size() + 1)
    words.emplace_back(line.c_str() + begin);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  setenv("GLIBC_TUNABLES", (tunables.empty() ? kPlainFunctions : tunables + ":" + kPlainFunctions).c_str(), 1);
  execv("/proc/self/exe", arguments.data());
  throw std::runtime_error("--isa sse2: the program cannot start itself again; is /proc missing?");
}

}  // namespace

void EngineOptions::add_to(CLI::App& app) {
  app.add_option("--threads", threads, "threads; all cores by default")->check(CLI::Range(1, 1024));
  app.add_option("--isa", instruction_set,
                 "instruction set: sse2 gives the same bits on every machine; avx2, avx512, native [native]")
      ->type_name("NAME")
      ->check(CLI::IsMember({"sse2", "avx2", "avx512", "native"}));
}

void EngineOptions::apply() const {
  try {
    render::set_device_options({threads, instruction_set == "native" ? "" : instruction_set});
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--isa {}: {}", instruction_set, error.what()));
  }
  if (instruction_set == "sse2") start_again_with_plain_functions();
}

}  // namespace lekalo::command
