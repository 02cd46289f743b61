// How Embree is to run, said once for the process before the first World is made.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace lekalo::render {

struct DeviceOptions {
  int threads = 0;              // that build Worlds; 0: all cores
  std::string instruction_set;  // sse2, avx2 or avx512; empty: the best that the processor has
};

// Throws std::invalid_argument for an instruction set that is unknown or that this processor lacks, and
// std::logic_error once a World has been made.
void set_device_options(const DeviceOptions& options);

// What this process runs with: sse2, avx2 or avx512. Pictures of two instruction sets may differ in last bits.
std::string instruction_set();

// Runs the work of building a World with the threads it may have.
void with_device_threads(const std::function<void()>& build);

// Bytes that Embree holds now, in the whole process.
size_t device_memory();

}  // namespace lekalo::render
