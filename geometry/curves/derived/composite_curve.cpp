#include "geometry/curves/derived/composite_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/splines/nurbs_operations.h"
#include "geometry/describe.h"
#include "geometry/point_formulas.h"

namespace lekalo::geometry {

namespace {

double size_of(const std::vector<CurvePtr>& curves) {
  Box3 box;
  for (const CurvePtr& curve : curves) box.include(bounds(*curve));
  return box.diameter();
}

Vec3 first_point(const Curve& curve) { return curve.point(curve.domain().lo); }
Vec3 last_point(const Curve& curve) { return curve.point(curve.domain().hi); }

}  // namespace

CompositeCurve::CompositeCurve(std::vector<CurvePtr> segments, bool closed, double tolerance, double start)
    : segments_(std::move(segments)), starts_{start}, closed_(closed) {
  if (segments_.empty()) throw FieldError("of", "a composite curve needs at least one segment");
  for (size_t k = 0; k < segments_.size(); ++k) {
    const double width = segments_[k]->domain().width();
    if (!(width < kInfinity)) throw FieldError("of", fmt::format("segment {} is unbounded", k), "give it a domain");
    starts_.push_back(starts_.back() + width);
  }
  const double near = tolerance * size_of(segments_);
  for (size_t k = 0; k + 1 < segments_.size() + (closed ? 1 : 0); ++k) {
    const size_t next = (k + 1) % segments_.size();
    const double gap = glm::length(first_point(*segments_[next]) - last_point(*segments_[k]));
    if (!(gap <= near))
      throw FieldError("of", fmt::format("segment {} begins {:.6g} from the end of segment {}", next, gap, k),
                       closed && next == 0 ? "leave out 'closed', or add the segment that closes the contour"
                                           : "segments follow one another; a segment may run either way");
  }
}

size_t CompositeCurve::segment_at(double t) const {
  const auto after = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, t);
  return static_cast<size_t>(after - starts_.begin()) - 1;
}

double CompositeCurve::own(size_t k, double t) const { return segments_[k]->domain().lo + (t - starts_[k]); }

CurveJet CompositeCurve::evaluate(double t, int order) const {
  if (closed_) t = wrapped(t, domain());
  const double inside = domain().clamp(t);
  const size_t k = segment_at(inside);
  CurveJet jet =
      segments_[k]->evaluate(segments_[k]->domain().clamp(own(k, inside)), std::max(order, t == inside ? 0 : 1));
  if (t != inside) {
    jet.d[0] += (t - inside) * jet.d[1];
    for (int i = 2; i <= order; ++i) jet.d[i] = Vec3(0);
  }
  jet.order = order;
  return jet;
}

int CompositeCurve::max_order() const {
  int order = kMaxCurveOrder;
  for (const CurvePtr& segment : segments_) order = std::min(order, segment->max_order());
  return order;
}

int CompositeCurve::enclosure_order() const {
  int order = kMaxCurveEnclosureOrder;
  for (const CurvePtr& segment : segments_) order = std::min(order, segment->enclosure_order());
  return order;
}

double CompositeCurve::fit_distance() const {
  double distance = 0;
  for (const CurvePtr& segment : segments_) distance = std::max(distance, segment->fit_distance());
  return distance;
}

CurveEnclosure CompositeCurve::enclose(const Interval& t, int order) const {
  CurveEnclosure result;
  for (size_t k = 0; k < segments_.size(); ++k) {
    const Interval common = intersect({starts_[k], starts_[k + 1]}, t);
    if (common.empty() || (common.width() == 0 && t.width() > 0)) continue;
    // The sums of parameters are rounded.
    const Interval domain = segments_[k]->domain();
    const Interval w = common - Interval(starts_[k]) + Interval(domain.lo);
    const CurveEnclosure boxes = segments_[k]->enclose({domain.clamp(w.lo), domain.clamp(w.hi)}, order);
    for (int i = 0; i <= order; ++i) result.d[i].include(boxes.d[i]);
  }
  return result;
}

std::vector<CurvePiece> CompositeCurve::pieces() const {
  std::vector<CurvePiece> result;
  for (size_t k = 0; k < segments_.size(); ++k) {
    std::vector<CurvePiece> pieces = segments_[k]->pieces();
    const double shift = starts_[k] - segments_[k]->domain().lo;
    for (CurvePiece& piece : pieces) {
      piece.domain = {piece.domain.lo + shift, piece.domain.hi + shift};
      piece.map.lo += shift;
      piece.map.hi += shift;
    }
    pieces.front().domain.lo = starts_[k];
    pieces.back().domain.hi = starts_[k + 1];
    result.insert(result.end(), pieces.begin(), pieces.end());
  }
  return result;
}

std::optional<NurbsCurveForm> CompositeCurve::as_nurbs() const { return form_of_pieces(pieces()); }

std::vector<CurvePtr> turned_to_follow(std::vector<CurvePtr> segments, double tolerance) {
  const double near = tolerance * size_of(segments);
  const auto meets = [&](const Vec3& a, const Vec3& b) { return glm::length(a - b) <= near; };
  for (size_t k = 0; k < segments.size(); ++k) {
    const Curve& own = *segments[k];
    bool turn = false;
    if (k > 0) {
      const Vec3 from = last_point(*segments[k - 1]);
      turn = !meets(first_point(own), from) && meets(last_point(own), from);
    } else if (segments.size() > 1) {
      const Vec3 a = first_point(*segments[1]), b = last_point(*segments[1]), end = last_point(own),
                 begin = first_point(own);
      turn = !meets(end, a) && !meets(end, b) && (meets(begin, a) || meets(begin, b));
    }
    if (turn) segments[k] = reversed_curve(segments[k]);
  }
  return segments;
}

TypeDeclaration composite_curve_type() {
  return declare(Category::curve, "composite_curve",
                 "Curves that follow one another as one, or a closed contour. The parameter runs through those of the "
                 "segments, from 0; `measure --continuity` tells how smooth the joints are.")
      .example(
          "of: [{ type: segment, from: [0, 0], to: [1, 0] }, { type: circle, center: [1, 1], radius: 1, arc: [-90, 0] "
          "}]")
      .field("of", references({Category::curve}), "the segments in their order; one that runs the other way is turned")
      .field("closed", boolean(), "the last segment ends where the first begins, and the parameter wraps", "false")
      .field("tolerance", number().positive(), "gaps up to this part of the size are taken for none", "1e-7")
      .built_by([](const Fields& f) {
        std::vector<CurvePtr> segments;
        for (const std::any& one : f.references("of")) segments.push_back(std::any_cast<CurvePtr>(one));
        const double tolerance = f.number("tolerance");
        return CompositeCurve(turned_to_follow(std::move(segments), tolerance), f.boolean("closed"), tolerance);
      });
}

}  // namespace lekalo::geometry
