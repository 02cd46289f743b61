#include "geometry/curves/parameter_line.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lekalo::geometry {

ParameterLine::ParameterLine(SurfacePtr surface, HeldParameter held, double at)
    : surface_(std::move(surface)), held_(held), at_(at) {
  const Rectangle domain = surface_->domain();
  domain_ = holds_u() ? domain.v : domain.u;
  if (!(domain_.width() < kInfinity)) throw std::invalid_argument("a parameter line of an unbounded surface");
  if (!(holds_u() ? domain.u : domain.v).contains(at))
    throw std::invalid_argument("the parameter lies outside of the surface's domain");
}

double ParameterLine::period() const { return holds_u() ? surface_->periods().v : surface_->periods().u; }

CurveJet ParameterLine::evaluate(double t, int order) const {
  if (order > kMaxSurfaceOrder) throw std::invalid_argument("derivatives beyond the fourth of a parameter line");
  const SurfaceJet at = holds_u() ? surface_->evaluate(at_, t, order) : surface_->evaluate(t, at_, order);
  CurveJet jet;
  jet.order = order;
  for (int k = 0; k <= order; ++k) jet.d[k] = holds_u() ? at.d(0, k) : at.d(k, 0);
  return jet;
}

CurveEnclosure ParameterLine::enclose(const Interval& t, int order) const {
  const SurfaceEnclosure over = surface_->enclose(holds_u() ? Rectangle{at_, t} : Rectangle{t, at_}, order);
  CurveEnclosure boxes;
  for (int k = 0; k <= order; ++k) boxes.d[k] = holds_u() ? over.d(0, k) : over.d(k, 0);
  return boxes;
}

// Smooth where the surface is: between the borders of its pieces along the line.
std::vector<CurvePiece> ParameterLine::pieces() const {
  std::vector<double> ends;
  for (const SurfacePiece& piece : surface_->pieces()) {
    const Interval& across = holds_u() ? piece.domain.u : piece.domain.v;
    const Interval& along = holds_u() ? piece.domain.v : piece.domain.u;
    if (!across.contains(at_)) continue;
    ends.push_back(along.lo);
    ends.push_back(along.hi);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<CurvePiece> pieces;
  for (size_t i = 0; i + 1 < ends.size(); ++i) {
    CurvePiece piece;
    piece.domain = {ends[i], ends[i + 1]};
    piece.map = {ParameterMap::Kind::affine, ends[i], ends[i + 1]};
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace lekalo::geometry
