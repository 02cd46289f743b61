// The types of G2 curves of rational cubics: a chain through points with given tangent lines, and the segment that
// joins two curves (Korotkij, Studenova 2024, problems 1 and 2; geometry/curves/splines/g2_joint.h).
#include <fmt/format.h>

#include <algorithm>

#include "geometry/curves/splines/g2_joint.h"
#include "geometry/curves/splines/nurbs_operations.h"

namespace lekalo::geometry {

namespace {

FieldType weights_choice() { return choice({"standard", "inner_ones"}); }
constexpr const char* kWeightsMeaning =
    "of the new segments: standard (w0 = w3 = 1) or inner_ones (w1 = w2 = 1); the curve is the same, its parameter is "
    "not";

CubicWeights read_weights_choice(const Fields& f) {
  return f.text("weights_form") == "standard" ? CubicWeights::standard : CubicWeights::inner_ones;
}

RationalCubic first_segment(const Fields& f) {
  RationalCubic cubic;
  std::copy_n(f.points("points").begin(), 4, cubic.points.begin());
  if (f.has("weights")) std::copy_n(f.numbers("weights").begin(), 4, cubic.weights.begin());
  if (cubic.points[2] == cubic.points[3])
    throw FieldError("points", "the last two points coincide: there is no tangent",
                     "move one of points[2] and points[3]");
  return cubic;
}

G2Continuation read_continuation(const Fields& f, int number) {
  G2Continuation wish;
  wish.to = f.vec3("to");
  wish.line = f.vec3("tangent");
  wish.end_invariant = f.number("end_invariant");
  if (f.word("handle").empty()) wish.handle = f.number("handle");
  if (f.has("end_curvature")) wish.curvature = f.number("end_curvature");
  if (f.has("end_handle")) wish.end_handle = f.number("end_handle");
  if (wish.curvature && f.given("end_invariant"))
    throw FieldError("segments", fmt::format("segment {}: end_curvature and end_invariant say the same", number),
                     "leave one of them out");
  return wish;
}

std::vector<RationalCubic> chain(const Fields& f) {
  std::vector<RationalCubic> segments{first_segment(f)};
  for (const Fields& group : f.groups("segments")) {
    const int number = static_cast<int>(segments.size()) + 1;
    segments.push_back(
        g2_continuation(g2_end(segments.back()), read_continuation(group, number), read_weights_choice(f), number));
  }
  return segments;
}

// A curve run backwards turns its tangent round and, the normal being the same, its binormal.
G2End reached(const Fields& f, const std::string& field, bool at_end, bool backwards) {
  G2End end = g2_end(*f.curve(field), at_end, field);
  if (backwards) end.tangent = -end.tangent, end.curvature = -end.curvature;
  return end;
}

// Bezier pieces raised to the degree of the segment that joins them.
void add_pieces(const Curve& curve, const std::string& field, bool backwards, int degree,
                std::vector<BezierSegment>& segments) {
  const auto form = curve.as_nurbs();
  if (!form || form->degree > degree || !form->maps.empty())
    throw FieldError(field, "only splines of at most the third degree can be joined with the transition to one",
                     "leave `joined` out and draw the three curves");
  const NurbsCurveForm raised = elevate_degree(*form, degree - form->degree);
  const Interval domain = curve.domain();
  const double ends = raised.domain().lo + raised.domain().hi;
  for (const CurvePiece& piece : backwards ? bezier_pieces(reversed(raised), {ends - domain.hi, ends - domain.lo})
                                           : bezier_pieces(raised, domain))
    segments.push_back(piece.points);
}

BezierSegment transition_segment(const Fields& f, const G2End& from, const G2End& to) {
  std::optional<std::array<double, 2>> handles;
  if (f.has("handles")) handles = {f.numbers("handles")[0], f.numbers("handles")[1]};
  try {
    return g2_transition(from, to, handles, read_weights_choice(f)).bezier();
  } catch (const FieldError&) {
    if (f.text("fallback") == "none") throw;
    return g2_quintic(from, to);
  }
}

NurbsCurve transition(const Fields& f) {
  const bool from_end = f.text("from_at") == "end", to_end = f.text("to_at") == "end";
  const BezierSegment middle =
      transition_segment(f, reached(f, "from", from_end, !from_end), reached(f, "to", to_end, to_end));
  const int degree = static_cast<int>(middle.size()) - 1;
  std::vector<BezierSegment> segments;
  if (f.boolean("joined")) add_pieces(*f.curve("from"), "from", !from_end, degree, segments);
  segments.push_back(middle);
  if (f.boolean("joined")) add_pieces(*f.curve("to"), "to", to_end, degree, segments);
  return NurbsCurve(bezier_chain(segments));
}

}  // namespace

TypeDeclaration g2_curve_type() {
  return declare(Category::curve, "g2_curve",
                 "Chain of rational cubics through points with given tangent lines, tangent and curvature vector "
                 "continuous (G2); segment i has t in i..i + 1.")
      .example(
          "points: [[2, 3.5, 1], [3, 2.5, -0.5], [3.3, 4.7, 2.1], [5, 3.5, 2]], segments: [{ to: [8, 0, 3], tangent: z "
          "}]")
      .field("points", points().count(4, 4), "control points of the first segment")
      .optional("weights", numbers().positive().count(4, 4), "of the first segment; all 1 when left out")
      .field("segments",
             groups({{"to", point(), "end of the segment", true, ""},
                     {"tangent", direction(), "of the line that it touches there, of either sense", true, ""},
                     {"handle", length().positive().or_word({"auto"}),
                      "length of its tangent at the beginning; auto: the one that makes w0 w2 = w1^2", false, "auto"},
                     {"end_invariant", number().positive(), "w1 w3 / w2^2: shapes its end", false, "1"},
                     {"end_curvature", number().positive(), "curvature at its end instead, 1/length", false, ""},
                     {"end_handle", length().positive(),
                      "length of its tangent at the end, towards which the line then points; for plane curves, where "
                      "the line lies in the osculating plane; a third of the chord when left out",
                      false, ""}})
                 .count(1),
             "the segments after the first")
      .field("weights_form", weights_choice(), kWeightsMeaning, "standard")
      .field("knots", choice({"triple", "double"}),
             "at the joints: triple is always possible; double where the weights allow it, with knot intervals that "
             "follow from them",
             "triple")
      .shows({"control_polygon", "knots"})
      .built_by([](const Fields& f) {
        const std::vector<RationalCubic> segments = chain(f);
        if (f.text("knots") == "double") return NurbsCurve(g2_chain_with_double_knots(segments));
        std::vector<BezierSegment> beziers;
        for (const RationalCubic& segment : segments) beziers.push_back(segment.bezier());
        return NurbsCurve(bezier_chain(beziers));
      });
}

TypeDeclaration g2_transition_type() {
  return declare(Category::curve, "g2_transition",
                 "Rational cubic from an end of one curve to an end of another, with their tangents and curvature "
                 "vectors (G2); t runs in 0..1.")
      .example(
          "from: { type: bezier_curve, points: [[0, 65, 0], [80, 65, 0], [6, 49, 33], [20, 35, 10]] }, "
          "to: { type: bezier_curve, points: [[50, 35, 20], [62, 26, 19], [80, 0, 0], [80, 0, 30]] }")
      .field("from", reference({Category::curve}), "the curve where it begins")
      .field("from_at", choice({"end", "start"}), "at which end of that", "end")
      .field("to", reference({Category::curve}), "the curve where it ends")
      .field("to_at", choice({"start", "end"}), "at which end of that", "start")
      .optional("handles", numbers().positive().count(2, 2),
                "lengths of the tangents at its ends, for curves in one plane; in space they follow from the curves. "
                "Without them the cubic in a plane is polynomial")
      .field("fallback", choice({"none", "quintic"}),
             "where no such cubic is: an error that says why, or a polynomial of degree five, which always is", "none")
      .field("joined", boolean(), "gives all three as one curve; of splines of at most the third degree", "false")
      .field("weights_form", weights_choice(), kWeightsMeaning, "standard")
      .shows({"control_polygon", "knots"})
      .built_by(transition);
}

}  // namespace lekalo::geometry
