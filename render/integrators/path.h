// The integrator that follows paths of light (path_tracer.h) of any length.
#pragma once

#include <string>

#include "render/integrators/path_tracer.h"
#include "render/model/model.h"

namespace lekalo::render {

// Of the field `spectral`.
inline constexpr const char* kSpectralText =
    "true: light of wavelengths in place of red, green and blue: measured metals, films, glass (which parts colours) "
    "and the spectra of lamps count as they are, colours as smooth spectra of that look under white light D65";

IntegratorPtr make_path_integrator(const PathOptions& options = {});

// True if some of the model's light is of the kind that paths leave out: from a point or in parallel, where there are
// mirrors or bodies that refract.
bool misses_light(const Model& model);
// The first object that mirrors or refracts and has no bounds, "object 2" without a name; empty where there is none.
// With one no photons are sent (caustics.h).
std::string without_photons(const Model& model);

}  // namespace lekalo::render
