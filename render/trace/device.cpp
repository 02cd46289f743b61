// The process's Embree device.
#include "render/trace/device.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>

#include "render/trace/hierarchy_parts.h"

namespace lekalo::render {

namespace {

DeviceOptions device_options;
bool device_exists = false;
std::atomic<ptrdiff_t> device_bytes = 0;

// What Embree compiles its kernels for.
bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
bool has_avx512() {
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
}

}  // namespace

RTCDevice device() {
  static const RTCDevice shared = [] {
    std::string configuration;
    if (device_options.threads > 0) configuration += "threads=" + std::to_string(device_options.threads);
    if (!device_options.instruction_set.empty())
      configuration += (configuration.empty() ? "isa=" : ",isa=") + device_options.instruction_set;
    const RTCDevice d = rtcNewDevice(configuration.empty() ? nullptr : configuration.c_str());
    if (!d) throw std::runtime_error("Embree cannot start: error " + std::to_string(rtcGetDeviceError(nullptr)));
    rtcSetDeviceMemoryMonitorFunction(
        d,
        [](void*, ssize_t bytes, bool) {
          device_bytes += bytes;
          return true;
        },
        nullptr);
    device_exists = true;
    return d;
  }();
  return shared;
}

size_t device_memory() { return static_cast<size_t>(std::max<ptrdiff_t>(device_bytes, 0)); }

void set_device_options(const DeviceOptions& options) {
  if (device_exists) throw std::logic_error("Embree runs already");
  const std::string& set = options.instruction_set;
  const bool known = set.empty() || set == "sse2" || set == "avx2" || set == "avx512";
  if (!known) throw std::invalid_argument("there is no instruction set '" + set + "'; take sse2, avx2 or avx512");
  if ((set == "avx2" && !has_avx2()) || (set == "avx512" && !has_avx512()))
    throw std::invalid_argument("this processor has no " + set + "; every one has sse2");
  device_options = options;
}

std::string instruction_set() {
  if (!device_options.instruction_set.empty()) return device_options.instruction_set;
  return has_avx512() ? "avx512" : has_avx2() ? "avx2" : "sse2";
}

void with_device_threads(const std::function<void()>& build) {
  if (device_options.threads == 0) return build();
  tbb::task_arena(device_options.threads).execute(build);
}

}  // namespace lekalo::render
