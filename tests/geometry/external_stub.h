// Functions from outside as tests write them: known curves and surfaces, or any code, that count their calls.
#pragma once

#include <functional>

#include "geometry/external/external_function.h"

namespace lekalo::geometry {

class CurveStub final : public ExternalFunction {
 public:
  explicit CurveStub(CurvePtr curve) : curve_(std::move(curve)) {}
  void evaluate(std::span<const double> places, int order, std::span<double> values) const override {
    ++calls;
    size_t at = 0;
    for (const double t : places) {
      const CurveJet jet = curve_->evaluate(t, order);
      for (int k = 0; k <= order; ++k)
        for (int c = 0; c < 3; ++c) values[at++] = jet.d[k][c];
    }
  }
  mutable int calls = 0;

 private:
  CurvePtr curve_;
};

class SurfaceStub final : public ExternalFunction {
 public:
  using Change = std::function<void(double u, double v, SurfaceJet& jet)>;
  explicit SurfaceStub(SurfacePtr surface, Change change = {})
      : surface_(std::move(surface)), change_(std::move(change)) {}
  void evaluate(std::span<const double> places, int order, std::span<double> values) const override {
    ++calls;
    size_t at = 0;
    for (size_t i = 0; i < places.size(); i += 2) {
      SurfaceJet jet = surface_->evaluate(places[i], places[i + 1], order);
      if (change_) change_(places[i], places[i + 1], jet);
      for (int k = 0; k < (order + 1) * (order + 2) / 2; ++k)
        for (int c = 0; c < 3; ++c) values[at++] = jet.values[k][c];
    }
  }
  mutable int calls = 0;

 private:
  SurfacePtr surface_;
  Change change_;
};

}  // namespace lekalo::geometry
