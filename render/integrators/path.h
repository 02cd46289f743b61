// The integrator that follows paths of light (path_tracer.h) of any length.
#pragma once

#include "render/integrators/path_tracer.h"

namespace lekalo::render {

IntegratorPtr make_path_integrator(const PathOptions& options = {});

}  // namespace lekalo::render
