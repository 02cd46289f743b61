// Textures as plain values for C++ programs: fill in a struct, make_texture() it. Scene files build the same structs.
// Parameters u, v are the surface's natural ones (lengths on a plane, radians on a sphere).
#pragma once

#include "render/image/image.h"
#include "render/materials/textured_color.h"

namespace lekalo::render {

// Squares in alternate colours: cell (floor((u - offset) / spacing), the same in v), `color` where their sum is even.
struct Checker {
  Vec2 spacing{1};  // in u and v, > 0
  Vec2 offset{0};
  TexturedColor color = 0.0;
  TexturedColor background = 1.0;
};

// Lines u = offset + k spacing and v = offset + k spacing of a width in parameters.
struct GridLines {
  Vec2 spacing{1};  // in u and v, > 0; infinite: no lines in that direction
  Vec2 offset{0};
  Vec2 width{0.05};
  TexturedColor color = 0.0;
  TexturedColor background = 1.0;
};

// The same lines, of constant width in the picture.
struct ParameterLines {
  Vec2 spacing{1};  // in u and v, > 0; infinite: no lines in that direction
  Vec2 offset{0};
  double width = 1.5;  // pixels
  TexturedColor color = 0.0;
  TexturedColor background = 1.0;
};

enum class Wrap { repeat, mirror, clamp, background };

// A picture mapped through (u, v): its lower left corner at `offset`, its width and height `spacing` in u and v.
struct ImageTexture {
  Image image;  // with colour (has_color)
  Vec2 spacing{1};
  Vec2 offset{0};
  double rotation = 0;  // radians, of the picture about its lower left corner, from u towards v
  Wrap wrap = Wrap::repeat;
  bool smooth = true;              // bilinear between pixel centres; false: the nearest pixel
  bool filtered = false;           // the mean over what a pixel of the rendered picture covers of it
  TexturedColor background = 1.0;  // outside the picture with Wrap::background, and behind transparent pixels
};

TexturePtr make_texture(const Checker& checker);
TexturePtr make_texture(const GridLines& grid);
TexturePtr make_texture(const ParameterLines& lines);
// Throws std::invalid_argument for a picture without colour.
TexturePtr make_texture(const ImageTexture& image);

}  // namespace lekalo::render
