// Functions of parameters that code outside the program computes, as curves and surfaces ask them.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/curve.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// What the outside said instead of an answer, with the parameters that it was asked for.
class ExternalError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Points and derivatives at given parameters. Safe to use from many threads, whatever the code behind it is.
class ExternalFunction {
 public:
  virtual ~ExternalFunction() = default;

  // `places`: the parameters of all places, t each for a curve, u, v each for a surface. `values`: for each place the
  // point and its derivatives up to `order`, three numbers each, in the order of CurveJet or SurfaceJet. Nothing is
  // said about the numbers: they may be infinite or NaN. Throws ExternalError.
  virtual void evaluate(std::span<const double> places, int order, std::span<double> values) const = 0;
};

// The answers as jets. Throws ExternalError also for a number that is not finite.
std::vector<CurveJet> curve_jets(const ExternalFunction& function, std::span<const double> t, int order);
std::vector<SurfaceJet> surface_jets(const ExternalFunction& function, std::span<const Vec2> uv, int order);

// "t = 0.5"; "u = 0.5, v = 2".
std::string place_text(std::span<const double> place);

// "the point", "the derivative by u u": the vector with this index in the order of CurveJet (one parameter) or
// SurfaceJet (two).
std::string quantity_text(size_t parameters, size_t index);

}  // namespace lekalo::geometry
