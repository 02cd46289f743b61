// libFuzzer target: no text crashes, hangs or confuses the scene reader.
//
//   cmake -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DLEKALO_FUZZ=ON && ninja -C build/fuzz reader_fuzzer
//   build/fuzz/bin/reader_fuzzer -timeout=5 -max_total_time=600 NEW_CORPUS tests/fuzz/corpus/reader
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fuzz/reader_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = lekalo::render::check_reader(std::string(reinterpret_cast<const char*>(data), size));
  if (!wrong.empty()) {
    std::fprintf(stderr, "%s\n", wrong.c_str());
    std::abort();
  }
  return 0;
}
