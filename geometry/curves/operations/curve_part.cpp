#include "geometry/curves/operations/curve_part.h"

#include <stdexcept>

#include "geometry/curves/operations/curve_parts.h"

namespace lekalo::geometry {

CurvePart::CurvePart(CurvePtr of, const Interval& range) : of_(std::move(of)), range_(range) {
  if (!(range.width() > 0) || !of_->domain().contains(range))
    throw std::invalid_argument("the part lies outside of the curve");
}

std::vector<CurvePiece> CurvePart::pieces() const {
  if (const auto form = as_nurbs()) return bezier_pieces(*form, range_);
  std::vector<CurvePiece> result;
  for (const Interval& part : parts_of(*of_, range_)) {
    CurvePiece piece;
    piece.domain = part;
    piece.map = {ParameterMap::Kind::affine, part.lo, part.hi};
    result.push_back(piece);
  }
  return result;
}

}  // namespace lekalo::geometry
