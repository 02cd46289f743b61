// `--frames tube=0.1..0.5:12`: a sequence of pictures over a parameter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/scene/yaml/include.h"

namespace lekalo::command {

struct Frame {
  std::optional<render::ParameterSetting> setting;  // none: the scene as it is
  std::string suffix;                               // of the file's name: _0001, _0002, ...; empty without a sequence
};

// The frames of NAME=A..B:N, N values from A to B, both included; A and B are formulas and may be angles. Without a
// text the one frame of the scene as it is. `option` is what it was given to. Throws UsageError.
std::vector<Frame> parse_frames(const std::string& text, const std::string& option);

// Those that "9-16,20" names by their numbers, from 1; all for an empty text. Throws UsageError.
std::vector<Frame> chosen_frames(const std::vector<Frame>& frames, const std::string& numbers);

// The name of a frame's file: ring.png is ring_0001.png.
std::string numbered(const std::string& path, const Frame& frame);

}  // namespace lekalo::command
