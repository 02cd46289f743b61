// The integrator that follows paths of light (path_tracer.h) of any length.
#pragma once

#include "render/integrators/path_tracer.h"
#include "render/model/model.h"

namespace lekalo::render {

IntegratorPtr make_path_integrator(const PathOptions& options = {});

// True if some of the model's light is of the kind that paths leave out: from a point or in parallel, where there are
// mirrors or bodies that refract.
bool misses_light(const Model& model);

}  // namespace lekalo::render
