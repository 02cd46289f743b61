// Four doubles that are computed with together.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

#include "geometry/vectors.h"

namespace lekalo::geometry {

// A homogeneous point in one register, or two where registers are short: GCC's and Clang's vector extension.
using Lanes = double __attribute__((vector_size(32)));
inline void load(const Vec4& p, Lanes& lanes) { std::memcpy(&lanes, &p, sizeof lanes); }
inline void store(const Lanes& lanes, Vec4& p) { std::memcpy(&p, &lanes, sizeof lanes); }

// The absolute values; `result` may be `x`.
inline void absolute(const Lanes& x, Lanes& result) {
  using Bits = int64_t __attribute__((vector_size(32)));
  constexpr int64_t kAllButSign = std::numeric_limits<int64_t>::max();
  result = (Lanes)((Bits)x & Bits{kAllButSign, kAllButSign, kAllButSign, kAllButSign});
}

}  // namespace lekalo::geometry
