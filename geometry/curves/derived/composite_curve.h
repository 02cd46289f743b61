// Curves made of others that follow one another (Golovanov 2016, 2.16.1):
//
//   r(t) = r_k(w_k),   w_k = w_k,min + t - (t_min + lengths of the parameter ranges before k)
//
// The derivatives are those of the segment; their lengths and directions may jump at joints.
#pragma once

#include "geometry/curve.h"

namespace lekalo::geometry {

class CompositeCurve final : public Curve {
 public:
  // Segments over finite domains, each beginning where the one before ends, to `tolerance` of the size of all; at least
  // one. `closed`: the last ends where the first begins, and the parameter wraps. The parameter begins at `start`.
  // Throws FieldError (field of) that names the segments apart.
  CompositeCurve(std::vector<CurvePtr> segments, bool closed, double tolerance, double start = 0);

  const std::vector<CurvePtr>& segments() const { return segments_; }

  Interval domain() const override { return {starts_.front(), starts_.back()}; }
  double period() const override { return closed_ ? domain().width() : 0; }
  CurveJet evaluate(double t, int order) const override;
  int max_order() const override;
  double fit_distance() const override;
  CurveEnclosure enclose(const Interval& t, int order) const override;
  int enclosure_order() const override;
  std::vector<CurvePiece> pieces() const override;
  // Where all segments have one and none is cut from the middle of a transcendental span.
  std::optional<NurbsCurveForm> as_nurbs() const override;

 private:
  size_t segment_at(double t) const;
  double own(size_t k, double t) const;  // w_k

  std::vector<CurvePtr> segments_;
  std::vector<double> starts_;  // of the segments, and the end
  bool closed_ = false;
};

// The segments, those that begin where they should end turned round (Golovanov 2016, 2.15.3 with the sign -1). The
// first is turned if its beginning, not its end, is where the second begins or ends.
std::vector<CurvePtr> turned_to_follow(std::vector<CurvePtr> segments, double tolerance);

}  // namespace lekalo::geometry
