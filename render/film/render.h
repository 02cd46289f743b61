// The picture loop: pixels to samples to film, in parallel, the same bits for any number of threads.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/image/image.h"
#include "render/trace/world.h"

namespace lekalo::render {

// What every partial file begins with, whatever its version.
inline constexpr std::string_view kPartialMagic = "lekalo partial ";

// Names of the layers that a film can keep: color (R G B A), direct, depth (Z), position (P), normal (N),
// geometric_normal (Ng), uv, id (id.object id.material), albedo, quantity (a channel called as the integrator's
// quantity, where it has one), samples. And what is kept only if it is asked for: the parts of light (LightParts) of
// integrators that tell them, indirect, emission, diffuse, specular, transmission, light_groups (group.NAME.R ..., and
// group.rest of lights in no group); variance; cryptomatte_object and cryptomatte_material (cryptomatte.h); denoised
// (denoise.h).
const std::vector<std::string>& film_layers();
bool keeps_layer(const Film& film, std::string_view layer);
// Whether the channel of that name holds light, or the alpha with it, so that its mean over pictures means something.
bool is_light_channel(std::string_view name);

// One of `count` parts of a picture, made by themselves: of the tiles every count-th, beginning with `index`.
struct PicturePart {
  int index = 0, count = 1;
};

// What a partial file says of itself.
struct PartialHeader {
  uint64_t identity = 0, settings = 0;
  PicturePart part;  // 0 of 1: the whole picture
  int tiles = 0;     // of the whole picture
  int done = 0;      // that are in the file
  std::string job;   // RenderOptions::job
  int tiles_of_part() const { return (tiles - part.index + part.count - 1) / part.count; }
};
// Throws ImageError for what is no partial file of this version.
PartialHeader read_partial_header(const std::string& file);

struct RenderOptions {
  int threads = 0;  // 0: all
  // Called now and then, never from two threads at once, with the share done (0..1) and all rays traced so far.
  std::function<void(double done, uint64_t rays)> progress;
  const std::atomic<bool>* stop = nullptr;  // set by Ctrl-C: tiles not yet done are left out
  std::vector<std::string> resume_files;    // OUTPUT.partial to continue from, or all parts of a picture
  std::optional<PicturePart> part;          // only this, kept in the partial file also when it is done
  std::string job;                          // how the picture was asked for, kept in the partial file
  std::string partial_file;   // where to keep the work done when stopped, and now and then; empty: nowhere
  double save_interval = 60;  // seconds
  // Called once if the partial file cannot be written on the way; the picture goes on.
  std::function<void(const std::string& reason)> warning;
  uint64_t identity = 0;   // of scene and build: a partial file is continued only with the same identity and film
  bool key_layer = false;  // add the layer id.key (see RaySample::key), folded to 32 bits
};

struct RenderResult {
  Image image;  // see below
  bool complete = true;
  bool part_complete = true;  // of the part that was asked for
  bool saved = false;         // not complete, or a part: kept in the partial file
  uint64_t camera_rays = 0;
  uint64_t shadow_rays = 0;
  uint64_t other_rays = 0;
  double seconds = 0;                 // of the trace stage
  std::vector<std::string> notes;     // of the integrator
  std::optional<PictureScale> scale;  // of its colours, where they tell a number
  uint64_t not_finite = 0;            // samples that were NaN or infinite and were left out
};

// Renders the model's film as its camera sees the world.
//
// With Film::contrast > 0 samples go where they are needed (Whitted 1980): each pixel takes one at its centre. Where
// that differs from a neighbour's by more than the contrast, as displayed (gamma 2, alpha as it is), the pixel takes a
// few of its stratified samples in place of it, and all of them if these differ; it also takes all where the neighbour
// met another object or face, where the edge of a line or mark may run through it, and within two pixels of a centre
// that lies in a penumbra or a soft light's highlight.
// The layer `samples` tells.
//
// With Film::noise > 0 blocks of 8 x 8 pixels take 16, 32, 64, ... samples, until the standard error of their pixels as
// displayed, in the root mean square, is no more, or they have them all. Asked after finished rounds alone, of the
// block alone. What stops by what it has seen is no longer unbiased: the samples that happened to agree end it earlier.
//
// The film keeps the layers that Film::layers asks for. Filtered layers: R G B A (background included, alpha 0 there),
// direct.R .G .B and the parts of light. Layers of the sample nearest the pixel's centre, 0 where it hits nothing: Z
// (distance from the eye, or from the picture plane of a parallel view), P.X .Y .Z, N.* (shading normal), Ng.*
// (geometric normal), uv.U uv.V, id.object (number of the object in the order of the model, groups before their
// members, from 1), id.material (in the order of first use, from 1), albedo.R .G .B, the integrator's quantity.
// `samples` counts the samples of the pixel, `variance` is that of their mean (PixelRecord::variance), Cryptomattes
// have their shares, whatever the filter. Pixels of an unfinished picture are 0 where no tile is done.
//
// A picture is the same bits for any number of threads and after any number of stops and resumes. A crop gives the same
// pixels as the full picture. Throws ImageError for an unreadable or foreign partial file and
// std::invalid_argument if the film asks for what there is not (filter, empty crop, camera of another size).
RenderResult render(const World& world, const RenderOptions& options);

}  // namespace lekalo::render
