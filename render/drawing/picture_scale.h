// The colour bars of a rendered picture, drawn over it.
#pragma once

#include "render/image/png.h"
#include "render/model/model.h"

namespace lekalo::render {

// Whether a picture of the model has any: those that tell the scale of its integrator, in a picture that is not
// cropped.
bool has_color_bars(const Model& model);

// The picture, which is that of the model's film, with these over it; its texts are kept.
DisplayImage with_color_bars(const DisplayImage& picture, const Model& model, const PictureScale& scale);

}  // namespace lekalo::render
