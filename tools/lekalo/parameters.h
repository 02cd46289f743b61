// Over which parameters a curve or surface runs: domain, period, closure; and what lies outside of it.
#pragma once

#include "geometry/curve.h"
#include "geometry/surface.h"
#include "json.h"

namespace lekalo::command {

// One entry for t, or for u and v: name, domain (null for an infinite end), period (null where there is none), closed.
ordered_json parameters_of(const geometry::Curve& curve);
ordered_json parameters_of(const geometry::Surface& surface);

// One line for each parameter.
void print_parameters(const ordered_json& parameters);

// Outside its domain a curve or surface goes on by a rule: a note on stderr says by which. A domain of a whole period
// has no outside.
void note_outside(const char* name, double x, const geometry::Interval& domain, double period);

}  // namespace lekalo::command
