// What every surface is: a smooth map from a rectangle of parameters to space (Golovanov 2016, 3.1).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/curve.h"

namespace lekalo::geometry {

inline constexpr int kMaxSurfaceOrder = 4;

struct Rectangle {
  Interval u;
  Interval v;
  bool contains(double a, double b) const { return u.contains(a) && v.contains(b); }
};

// Period in each direction; 0 where the surface is not periodic.
struct Periods {
  double u = 0;
  double v = 0;
};

// Point and partial derivatives at one place: d(i, j) is the derivative i times by u and j times by v, i + j <= order;
// values beyond the order mean nothing.
struct SurfaceJet {
  int order = 0;
  std::array<Vec3, (kMaxSurfaceOrder + 1) * (kMaxSurfaceOrder + 2) / 2> values;

  SurfaceJet() : values{} {}
  // Zeros up to the order.
  explicit SurfaceJet(int order) : order(order) {
    for (int i = 0; i < (order + 1) * (order + 2) / 2; ++i) values[i] = Vec3(0);
  }

  static constexpr int index(int i, int j) { return (i + j) * (i + j + 1) / 2 + j; }
  Vec3& d(int i, int j) { return values[index(i, j)]; }
  const Vec3& d(int i, int j) const { return values[index(i, j)]; }
  const Vec3& point() const { return values[0]; }
  const Vec3& du() const { return values[1]; }
  const Vec3& dv() const { return values[2]; }
  const Vec3& duu() const { return values[3]; }
  const Vec3& duv() const { return values[4]; }
  const Vec3& dvv() const { return values[5]; }
};

// Boxes that contain the point and derivatives for every parameter of a rectangle; the same indexing.
struct SurfaceEnclosure {
  std::array<Box3, (kMaxSurfaceOrder + 1) * (kMaxSurfaceOrder + 2) / 2> values{};
  const Box3& d(int i, int j) const { return values[SurfaceJet::index(i, j)]; }
};

// A smooth part of a surface. Where `points` is not empty it is exactly the rational Bezier patch with these
// homogeneous control points; point (i, j) stands at points[i * (degree_v + 1) + j], i runs with u.
struct SurfacePiece {
  Rectangle domain;  // in the surface's own (natural) parameters
  ParameterMap map_u;
  ParameterMap map_v;
  int degree_u = 0;
  int degree_v = 0;
  std::vector<Vec4> points;
  bool is_rational() const { return !points.empty(); }
};

// A piece without a rational form.
inline SurfacePiece plain_piece(const Rectangle& domain) {
  SurfacePiece piece;
  piece.domain = domain;
  piece.map_u = {ParameterMap::Kind::affine, domain.u.lo, domain.u.hi};
  piece.map_v = {ParameterMap::Kind::affine, domain.v.lo, domain.v.hi};
  return piece;
}

// An exact NURBS form with maps to the natural parameters, one for each non-empty knot span of the form's domain in
// each direction, or none at all where a direction is affine throughout. The form covers at least the surface's domain.
struct NurbsSurfaceForm {
  int degree_u = 1;
  int degree_v = 1;
  std::vector<double> knots_u;
  std::vector<double> knots_v;
  std::vector<Vec4> points;  // point (i, j) at points[i * count_v + j]
  std::vector<ParameterMap> maps_u;
  std::vector<ParameterMap> maps_v;
  int count_u() const { return static_cast<int>(knots_u.size()) - degree_u - 1; }
  int count_v() const { return static_cast<int>(knots_v.size()) - degree_v - 1; }
  Rectangle domain() const {
    return {{knots_u[degree_u], knots_u[count_u()]}, {knots_v[degree_v], knots_v[count_v()]}};
  }
};

// The nearest point of a surface, and the unit normal there. (Aligned: read in the pairs of numbers that it was written
// in. Of two that were written one at a time, and are read as one, a processor waits for both.)
struct FootPoint {
  alignas(16) Vec3 point;
  alignas(16) Vec3 normal;
};

// Which edges of the domain shrink to a point (poles, apexes, collapsed Bezier edges).
struct DegenerateEdges {
  bool u_min = false, u_max = false, v_min = false, v_max = false;
};

// Sides of a surface: where r_u x r_v points to, and the other.
struct Sides {
  bool front = false, back = false;
  Sides turned() const { return {back, front}; }
};

// One intersection of a line with a surface.
struct LineHit {
  double t;  // along the line, in units of its direction
  double u;
  double v;
};

// Hits found so far, in any order; fixed room first so that tracing does not allocate.
class LineHits {
 public:
  LineHits() = default;
  // `first_is_enough`: a surface that finds its hits in the order of t may stop after the first. Without `parameters`
  // only t is asked for, and it may leave u and v zero.
  LineHits(bool first_is_enough, bool parameters) : first_is_enough_(first_is_enough), parameters_(parameters) {}
  bool is_enough() const { return first_is_enough_ && count_ > 0; }
  bool wants_parameters() const { return parameters_; }

  void add(const LineHit& hit) {
    if (count_ < kInline)
      few_[count_++] = hit;
    else
      add_to_more(hit.t, hit.u, hit.v);
  }
  int size() const { return count_; }
  LineHit& operator[](int i) { return i < kInline ? few_[i] : (*more_)[i - kInline]; }
  const LineHit& operator[](int i) const { return i < kInline ? few_[i] : (*more_)[i - kInline]; }
  void clear() {
    count_ = 0;
    more_.reset();
  }

 private:
  static constexpr int kInline = 16;
  void add_to_more(double t, double u, double v);  // by value, so that a hit need not be in memory before it is added
  bool first_is_enough_ = false, parameters_ = true;
  int count_ = 0;
  std::array<LineHit, kInline> few_;  // not initialised: one of these is made for each candidate of each ray
  std::unique_ptr<std::vector<LineHit>> more_;
};

// A parametric surface r(u, v). Immutable; safe to use from many threads.
// Outside the domain the same rules hold as for curves, per direction.
class Surface {
 public:
  virtual ~Surface() = default;

  virtual Rectangle domain() const = 0;
  virtual Periods periods() const { return {}; }

  // Point and partial derivatives up to total `order` (0..kMaxSurfaceOrder); those beyond max_order() are NaN.
  virtual SurfaceJet evaluate(double u, double v, int order) const = 0;
  // Less than kMaxSurfaceOrder of a surface that is made of the derivatives of others.
  virtual int max_order() const { return kMaxSurfaceOrder; }
  virtual void evaluate_many(std::span<const Vec2> uv, int order, std::span<SurfaceJet> result) const;
  // As for curves: how far the fit whose first derivatives these are was seen to be from the points, or 0.
  virtual double fit_distance() const { return 0; }
  // The same but for rounding where the point is known to lie at `near`, as that of a hit is: what a formula would find
  // anew from the parameters (cosines and sines of angles) a surface may take from there.
  virtual SurfaceJet evaluate_near(const Vec3& /*near*/, double u, double v, int order) const {
    return evaluate(u, v, order);
  }

  // Where nothing shows parameters, a hit on a surface that knows its foot points needs none: line_hits finds the same
  // hits without, and convex_sides does not look at them. `near` is a point of the surface but for rounding.
  virtual bool has_closest_point() const { return false; }
  virtual FootPoint foot_point(const Vec3& near) const;

  // Certified enclosure of point and derivatives up to `order` (0..enclosure_order()) over a rectangle inside the
  // domain.
  virtual SurfaceEnclosure enclose(const Rectangle& box, int order) const = 0;
  // 2, or up to kMaxSurfaceOrder of a surface that encloses more derivatives.
  virtual int enclosure_order() const { return 2; }

  // Made of the evaluations of curves and surfaces: boxes of it are wide and dear, and lines meet polynomials that
  // agree with it to kFitDistance of its size (geometry/queries/rays/fitted_pieces.h).
  virtual bool is_composed() const { return false; }

  // Smooth pieces that cover the domain without gaps or overlap; rational where an exact form exists.
  // An unbounded surface (bounded() false) has none.
  virtual std::vector<SurfacePiece> pieces() const;
  virtual std::optional<NurbsSurfaceForm> as_nurbs() const { return std::nullopt; }
  virtual DegenerateEdges degenerate_edges() const { return {}; }
  virtual bool bounded() const { return true; }
  // The sides of the tangent plane at a point on which there is nothing of the surface: a ray that leaves the point to
  // such a side does not meet the surface again. A plane has both, a convex surface one; a surface that does not know
  // has none.
  virtual Sides convex_sides(double /*u*/, double /*v*/) const { return {}; }

  // A surface with a closed form for lines says so and adds all hits with t in the interval and (u, v) in the domain
  // (natural parameters); a tangent hit counts twice or not at all, so that crossings of closed surfaces stay even.
  virtual bool has_line_formula() const { return false; }
  virtual void line_hits(const Line& line, const Interval& t, LineHits& hits) const;

  // Unit normal r_u x r_v / |r_u x r_v|, the limit from inside the domain at poles and collapsed edges
  // (Golovanov 2016, 3.1), turned round for a reversed surface.
  virtual Vec3 normal(double u, double v) const;

  // The same where the point's jet of order 1 or more is at hand.
  virtual Vec3 normal(double u, double v, const SurfaceJet& jet) const;

  // A reversed surface keeps its parameters and has the opposite normal.
  bool reversed() const { return reversed_; }
  double normal_sign() const { return reversed_ ? -1.0 : 1.0; }
  void set_reversed(bool reversed) { reversed_ = reversed; }

  Vec3 point(double u, double v) const { return evaluate(u, v, 0).values[0]; }

 private:
  bool reversed_ = false;
};

using SurfacePtr = std::shared_ptr<const Surface>;

// A box around the surface from its pieces' control points or enclosures; everything() where it is unbounded.
Box3 bounds(const Surface& surface);

// Box of one piece: convex hull of its control points, or the enclosure over its domain.
Box3 bounds(const Surface& surface, const SurfacePiece& piece);

// Normal from a jet of order >= 1, or by the limit rules where r_u x r_v vanishes (order >= 2 is then evaluated).
// Does not look at reversed().
Vec3 parametric_normal(const Surface& surface, double u, double v, const SurfaceJet& jet);

// Splits the part of a NURBS form over `domain` into rational Bezier patches, u outer, v inner; as for curves.
std::vector<SurfacePiece> bezier_pieces(const NurbsSurfaceForm& form, const Rectangle& domain);

}  // namespace lekalo::geometry
