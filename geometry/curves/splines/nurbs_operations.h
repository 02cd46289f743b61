// Exact changes of the description of a NURBS curve: the curve stays the same, or changes its parameter only.
//
// All work in homogeneous coordinates on forms with affine maps (a transcendental parameter cannot be written in
// knots); others throw std::invalid_argument. Decomposition into Bezier pieces is bezier_pieces (geometry/curve.h).
#pragma once

#include <utility>

#include "geometry/curve.h"

namespace lekalo::geometry {

// Inserts a knot inside the domain `times` times (Boehm; Golovanov 2016, 2.11). Throws std::invalid_argument when t is
// not inside the domain or its multiplicity would exceed the degree.
NurbsCurveForm insert_knot(const NurbsCurveForm& form, double t, int times = 1);

// The same curve with a degree higher by `by` >= 0; every knot's multiplicity grows with it (Golovanov 2016, 2.6;
// Ramshaw 1989). Throws std::invalid_argument above kMaxDegree.
NurbsCurveForm elevate_degree(const NurbsCurveForm& form, int by = 1);

// Every knot inside the domain of multiplicity degree: the control points are the Bezier points of the pieces
// (Golovanov 2016, 2.13).
NurbsCurveForm in_bezier_form(const NurbsCurveForm& form);

// The part over a range inside the domain, clamped at its ends. Throws std::invalid_argument for a range that is not.
NurbsCurveForm clamped_part(const NurbsCurveForm& form, const Interval& part);

// The parts before and after t, inside the domain; clamped at t. Throws std::invalid_argument for t outside.
std::pair<NurbsCurveForm, NurbsCurveForm> split(const NurbsCurveForm& form, double t);

// The same points in the opposite direction over the same domain: r(lo + hi - t).
NurbsCurveForm reversed(const NurbsCurveForm& form);

// The same points over another domain (Golovanov 2016, 2.15.4).
NurbsCurveForm reparametrized(const NurbsCurveForm& form, const Interval& domain);

// The same Bezier curve by the points of a degree that is not lower (Golovanov 2016, 2.6).
std::vector<Vec4> elevated_bezier(std::vector<Vec4> points, int degree);

// One form of rational pieces that follow one another, each end being the next one's beginning: of their highest
// degree, with knots of that multiplicity at the joints. None if a piece is not rational or cut from the middle of a
// transcendental span.
std::optional<NurbsCurveForm> form_of_pieces(std::vector<CurvePiece> pieces);

}  // namespace lekalo::geometry
