// The surface that takes the place of an edge: a fillet or chamfer between the faces to the right and to the left of it
// (Golovanov 2016, 6.9, 6.11), seen from outside along the edge.
//
// q(s, z), s along the edge, z in 0..1 from the contact with the right face to that with the left one, so that q_s x
// q_z looks out of the body for convex and concave edges alike. Exact where the surface is a cylinder, torus, plane or
// cone; else rational patches fitted to 1e-13 of the size.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "geometry/bodies/blends/lines_on_surfaces.h"
#include "geometry/body.h"
#include "geometry/surfaces/blends/sections.h"

namespace lekalo::geometry {

// What becomes of a fillet whose border leaves a face over a sharp edge: the face beyond cuts it, or the ball rests on
// the edge.
enum class Overflow { cut, edge };

// What an edge is replaced by.
struct BlendRule {
  BlendKind kind = BlendKind::ball;
  // Radii or lengths on two faces, or a chord (the first).
  std::array<ScalarLaw, 2> sizes{ScalarLaw(1.0), ScalarLaw(1.0)};
  double weight = 0;  // of the section's middle: 0 as a circle has it
  std::string role;   // of the new faces: fillets.0
  std::string field;  // which messages name
  Overflow overflow = Overflow::cut;
  bool is_plain_ball() const {
    return kind == BlendKind::ball && weight == 0 && sizes[0].is_constant() && sizes[1].is_constant() &&
           sizes[0](0.0) == sizes[1](0.0);
  }
  bool is_constant() const { return sizes[0].is_constant() && sizes[1].is_constant(); }
};

// An edge and its faces, numbers in a body. The first size counts on the right face, or on the left one.
struct BlendEdge {
  int edge = -1;
  std::array<int, 2> faces{-1, -1};  // right, left
  bool convex = true;
  bool first_is_left = false;
  size_t rule = 0;
};

class BlendBand {
 public:
  // `reach`: how far the band goes beyond the edge's start and end, a length. Throws FieldError for sizes for which
  // there is none.
  BlendBand(const Body& body, const BlendEdge& edge, const BlendRule& rule, const std::array<double, 2>& reach);

  // The part of a fillet beside a rim (Beyond::roll: between the face beyond and the other one; Beyond::edge: between
  // the rim, a curve that runs with the edge, and the other face). `contacts`: on the right and left side at the start.
  BlendBand(const Body& body, const BlendEdge& edge, const BlendRule& rule, int side, const CurvePtr& rim,
            const std::array<Vec3, 2>& contacts);

  const SurfacePtr& surface() const { return surface_; }
  // s of the sections across the edge's start and end, and of the ends of the surface.
  const std::array<double, 2>& ends() const { return ends_; }
  Interval range() const;

  Vec2 place(double s, double z) const;
  double s_of(const Vec2& place) const;
  double z_of(const Vec2& place) const;
  // The point with derivatives by s and z.
  struct Local {
    Vec3 point, ds, dz;
  };
  Local at(double s, double z) const;
  // Out of the body, of unit length.
  Vec3 outward(double s, double z) const;
  // Of a ball of constant radius: its center, and the section in which that is a point.
  Vec3 center(double s) const;
  double section_at(const Vec3& center, double near) const;
  bool is_ball() const { return radius_ > 0; }
  double radius() const { return radius_; }

  // Of the section at s, and of the border z between two sections.
  LineOnSurface section(double s, bool from_right) const;
  LineOnSurface border(double z, double from, double to) const;

  // The surface over these sections alone, its parameters as before; whether the face's normal is its own.
  SurfacePtr cut(const Interval& s) const;
  BlendKind kind() const { return kind_; }
  bool is_closed() const { return is_closed_; }
  bool is_exact() const { return is_exact_; }

 private:
  void make(const BlendEdge& edge, const BlendRule& rule, const Contacts& contacts, const Interval& domain);
  bool make_exact_fillet(const Contacts& contacts);
  bool make_exact_chamfer(const Contacts& contacts);
  void make_fitted(const Contacts& contacts, const BlendRule& rule);
  double along_of(const Contact& contact, double near) const;

  SurfacePtr surface_;
  std::function<SurfacePtr(const Interval& along)> cut_;
  bool along_u_ = true;     // which parameter of the surface runs along the edge
  double sign_ = 1;         // it runs with the edge, or against it
  bool from_left_ = false;  // across it runs from the left to the right side
  Interval across_{0, 1};
  std::array<double, 2> ends_{0, 1};
  BlendKind kind_ = BlendKind::ball;
  double radius_ = 0;     // 0: no ball of constant radius
  double to_center_ = 0;  // the surface's normal times this leads to the ball's center
  bool is_closed_ = false, is_exact_ = false;
  double outward_ = 1;  // times r_u x r_v
};

}  // namespace lekalo::geometry
