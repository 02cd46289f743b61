#include "geometry/surfaces/derived/ribbon.h"

#include <fmt/format.h>

#include "geometry/composition.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

Ribbon::Ribbon(CurvePtr curve, double width, const FrameLaw& law) : curve_(std::move(curve)) {
  if (!(width > 0 && width < kInfinity)) throw FieldError("width", "the width of a ribbon must be positive");
  domain_ = {curve_->domain(), {-0.5 * width, 0.5 * width}};
  across_ = direction_across(*curve_, law);
}

template <class T>
Triple<T> Ribbon::at(const T& u, const T& v) const {
  return curve_at(*curve_, u) + v * curve_at(*across_, u);
}

SurfaceJet Ribbon::evaluate(double u, double v, int order) const {
  return evaluate_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, u, v, order);
}

SurfaceEnclosure Ribbon::enclose(const Rectangle& box, int order) const {
  return enclose_surface_formula([this](const auto& a, const auto& b) { return at(a, b); }, box, order);
}

std::vector<SurfacePiece> Ribbon::pieces() const {
  // The parts never reach beyond a piece of the curve.
  std::vector<SurfacePiece> pieces;
  for (const auto& part : across_->parts()) pieces.push_back(plain_piece({part.t, domain_.v}));
  return pieces;
}

TypeDeclaration ribbon_type() {
  return declare(Category::surface, "ribbon",
                 "Strip of constant width along a smooth curve, which is its middle line. Parameters: u is that of the "
                 "curve, v the distance from it; the normal is (tangent of the curve) x (direction across).")
      .example("of: round, width: 0.2")
      .field("of", reference({Category::curve}), "the curve in the middle")
      .field("width", length().positive(), "from border to border")
      .field("across", direction().or_word({"rotation_minimizing", "normal", "binormal"}),
             "direction of its width: one that turns about the curve no more than it must (and closes with a closed "
             "curve), the curve's normal or binormal, or what lies across the curve of a given direction",
             "rotation_minimizing")
      .optional("start", direction(), "of rotation_minimizing: the direction of its width where the curve begins")
      .optional("on", reference({Category::surface}), "a surface that the curve lies on: the ribbon lies flat on it")
      .field("twist", angle(),
             "of rotation_minimizing: turns by so much more from the beginning to the end; 180 makes a Moebius band",
             "0")
      .built_by([](const Fields& f) { return Ribbon(f.curve("of"), f.number("width"), read_frame_law(f)); });
}

}  // namespace lekalo::geometry
