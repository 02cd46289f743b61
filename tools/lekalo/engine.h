// Options of every command that traces many rays: how many threads, which instruction set.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace lekalo::command {

struct EngineOptions {
  int threads = 0;  // 0: all cores
  std::string instruction_set = "native";

  void add_to(CLI::App& app);

  // Settles both for the process, before the first ray. With `sse2` the program starts itself again, once: the C
  // library chooses its sines and powers by the processor when it starts, and those with fused multiply-add round
  // differently. Throws UsageError if the processor lacks the instruction set.
  void apply() const;
};

}  // namespace lekalo::command
