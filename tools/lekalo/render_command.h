// What render and make are asked for; merge asks for the same with the parts that others have made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "engine.h"
#include "frames.h"
#include "render/film/render.h"

namespace lekalo::command {

struct RenderCommand {
  SceneOptions scene;
  EngineOptions engine;
  std::vector<std::string> outputs;
  std::string size, crop, frames, shutter;
  std::string only;  // numbers of frames, "9-16,20"; empty: all
  std::string tile;  // "3/8"; empty: the whole picture
  std::vector<std::string> resume;
  int samples = 0;
  std::string representation;
  std::vector<std::string> layers;
  bool make_drawings = false;  // make: the scene's drawings too
  bool skip_existing = false;
  bool half = false, watch = false, stamp = false, quiet = false, stats = false, progress = false;
};

// Makes the pictures; gives the exit code.
int make_pictures(const RenderCommand& command);

// "3/8": the part with index 2 of 8; nothing for an empty text. Throws UsageError.
std::optional<render::PicturePart> parse_part(const std::string& text);

// The name of a part's file: ring.png.3of8.partial.
std::string partial_of(const std::string& output, const std::optional<render::PicturePart>& part);

// How one picture was asked for, as its partial file keeps it, and back. `outputs` and `layers` are the picture's own:
// a frame's, and those that the outputs have room for. Throws std::invalid_argument for a text of another program.
std::string job_of(const RenderCommand& command, const Frame& frame, const std::vector<std::string>& outputs,
                   const std::vector<std::string>& layers);
RenderCommand command_of(const std::string& job);

}  // namespace lekalo::command
