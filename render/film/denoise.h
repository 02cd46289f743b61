// A picture with less noise beside the one that was sampled.
//
// Guided filter (He, Sun, Tang, "Guided image filtering", 2013) by the buffers of what is seen (Bauszat, Eisemann,
// Magnor, "Guided image filtering for interactive high-quality global illumination", 2011): within windows of 11 x 11
// pixels the colour is taken for a linear function of the guides g, which are normal, albedo and the logarithm of the
// depth,
//
//   q = a . g + b,   a = (Cov(g) + e I)^-1 Cov(g, colour),   b = mean(colour) - a . mean(g),
//
// and a pixel takes the mean of a and b over all windows that hold it. So edges of things and textures stay. What the
// guides do not know, shadows' edges, caustics and what mirrors show, would be smeared: where q is farther from the
// colour than the colour's own uncertainty, only a share of the way is gone,
//
//   colour + w (q - colour),   w = min(1, variance / (q - colour)^2),  both means over 5 x 5 pixels.
//
// Pixels in which an outline or the border of a texture may run keep their colour and count in no window: their guides
// are those of their centre, their colour is that of both sides, and most of their variance is none.
//
// The result is biased: fine detail of light that is weaker than the noise is gone, and noise that was mistaken for
// detail stays. The layers of samples keep the unbiased picture.
#pragma once

#include "render/image/image.h"

namespace lekalo::render {

// Writes denoised.R .G .B from R G B, N.*, albedo.*, Z and variance.*, all of which the picture has. The same bits for
// any number of threads.
void denoise(Image& image);

}  // namespace lekalo::render
