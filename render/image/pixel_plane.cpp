#include "render/image/pixel_plane.h"

#include <cstdint>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace lekalo::render {

namespace {

// Asks the system to back this memory, which nobody has touched yet, with large pages where it has them. It is only a
// wish: nothing depends on it but time.
void prefer_large_pages(void* memory, std::size_t bytes) {
#if defined(__linux__)
  constexpr std::uintptr_t kLarge = std::uintptr_t{1} << 21;  // the same on all 64-bit x86 and most 64-bit ARM systems
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (address + kLarge - 1) / kLarge * kLarge, last = (address + bytes) / kLarge * kLarge;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#else
  static_cast<void>(memory), static_cast<void>(bytes);
#endif
}

}  // namespace

void* allocate_zeros(std::size_t bytes) {
  // Large blocks come fresh from the system, which clears a page when it is first touched.
  void* memory = std::calloc(std::max<std::size_t>(bytes, 1), 1);
  if (!memory) throw std::bad_alloc();
  prefer_large_pages(memory, bytes);
  return memory;
}

}  // namespace lekalo::render
