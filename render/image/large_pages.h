// Memory in large pages: a picture of a million pixels is some ten thousand small pages, which the system would clear
// and map one by one, for as long as it takes to trace a tenth of its rays.
#pragma once

#include <cstddef>

namespace lekalo::render {

// Asks the system to back this memory, which nobody has touched yet, with large pages where it has them. It is only a
// wish: nothing depends on it but time.
void prefer_large_pages(void* memory, std::size_t bytes);

}  // namespace lekalo::render
