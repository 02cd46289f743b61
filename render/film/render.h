// The picture loop: pixels to samples to film, in parallel, the same bits for any number of threads.
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "render/image/image.h"
#include "render/trace/world.h"

namespace lekalo::render {

struct RenderOptions {
  int threads = 0;  // 0: all
  // Called now and then from one thread with the share done (0..1).
  std::function<void(double done, uint64_t rays)> progress;
  const std::atomic<bool>* stop = nullptr;  // set by Ctrl-C: rows not yet begun are left out
  std::string resume_file;                  // OUTPUT.partial to continue from, empty: none
  std::string partial_file;                 // where to keep sums when stopped
};

struct RenderResult {
  Image image;  // the layers R G B A, Z, P, N, Ng, uv, id, albedo, samples, direct
  bool complete = true;
  uint64_t camera_rays = 0;
  uint64_t shadow_rays = 0;
  uint64_t other_rays = 0;
  double seconds = 0;       // of the trace stage
  uint64_t not_finite = 0;  // samples that were NaN or infinite and were left out
};

RenderResult render(const World& world, const RenderOptions& options);

}  // namespace lekalo::render
