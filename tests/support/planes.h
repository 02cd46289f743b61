// Numbers for the planes of small pictures.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "render/image/image.h"

namespace lekalo::render::checks {

// As many numbers as the channel has pixels.
inline void set(Channel& channel, std::initializer_list<float> values) {
  std::copy(values.begin(), values.end(), channel.values.begin());
}

inline void fill(Channel& channel, float value) { std::fill(channel.values.begin(), channel.values.end(), value); }

}  // namespace lekalo::render::checks
