// The rational Bezier pieces of a NURBS curve (declared in geometry/curve.h).

#include "geometry/curve.h"
#include "geometry/curves/splines/blossom.h"
#include "geometry/curves/splines/knot_spans.h"
#include "geometry/curves/splines/weights.h"

namespace lekalo::geometry {

static void add_pieces(const NurbsCurveForm& form, const SpanPart& part, int halvings,
                       std::vector<CurvePiece>& pieces) {
  CurvePiece piece;
  piece.domain = part.natural;
  piece.map = part.map;
  piece.points.resize(form.degree + 1);
  bezier_points(form.degree, form.knots, part.span, form.points.data(), 1, part.rational.lo, part.rational.hi,
                piece.points.data(), 1);
  if (halvings == kMaxHalvingsForWeights || all_weights_positive(piece.points))
    pieces.push_back(std::move(piece));
  else
    for (const SpanPart& half : halves(part)) add_pieces(form, half, halvings + 1, pieces);
}

std::vector<CurvePiece> bezier_pieces(const NurbsCurveForm& form, const Interval& domain) {
  std::vector<CurvePiece> pieces;
  for (const SpanPart& part : span_parts(form.degree, form.knots, form.maps, domain)) add_pieces(form, part, 0, pieces);
  return pieces;
}

}  // namespace lekalo::geometry
