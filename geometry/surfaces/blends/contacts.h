// Where a ball, or a chamfer, touches two surfaces r and s as it goes along a guide g (Golovanov 2016, 4.9 and 4.10).
// With the unit normals m_r, m_s towards the ball and the plane across the guide at g(t), the parameters obey
//
//   ball      r + p_r m_r = s + p_s m_s = c,  (c - g) . g' = 0      p_r, p_s: its radius; two that differ: an ellipse
//   chord     the same with one radius, which is unknown, and |r - s| = h
//   edge      |r + p m_r - g| = p,  (r + p m_r - g) . g' = 0        g is an edge of s, which the ball touches
//   chamfer   r + d_r t_r = s + d_s t_s = c,  (c - g) . g' = 0      t_r = (m_r (m_r . m_s) - m_s)/|m_r x m_s|
//
// They are solved by Newton's iteration where they are asked for, from places that a march along the guide has found.
#pragma once

#include <array>
#include <vector>

#include "geometry/curve.h"
#include "geometry/curves/operations/arc_fraction.h"
#include "geometry/expression/scalar_law.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

enum class BlendKind { ball, chord, edge, chamfer };

struct BlendLaw {
  BlendKind kind = BlendKind::ball;
  std::array<SurfacePtr, 2> of;
  std::array<double, 2> sides{1, 1};  // towards r_u x r_v, or against it
  CurvePtr guide;
  double period = 0;  // of the guide, 0 where it is not closed
  // Radii, legs, or the chord (the first), as formulas of the fraction s of the length of the guide, or of `measured`,
  // a part of it with its parameter, beyond whose ends they stay as they are there.
  CurvePtr measured;
  std::array<ScalarLaw, 2> sizes{ScalarLaw(1.0), ScalarLaw(1.0)};
  const char* size_field = "radius";  // which errors name
};

struct Contact {
  std::array<Vec2, 2> places{Vec2(0), Vec2(0)};  // u, v on both surfaces; the second of an edge means nothing
  std::array<Vec3, 2> points{Vec3(0), Vec3(0)};
  std::array<Vec3, 2> normals{Vec3(0), Vec3(0)};  // of length 1, towards the ball; at an edge towards its center
  Vec3 center{0};                                 // c
  double radius = 0;                              // of a ball, on the first surface
};

class Contacts {
 public:
  // `starts`: parameters on both surfaces near to the guide's point at `start_t`, or on both where the guide is their
  // intersection; with `known` they are contacts already. Throws FieldError where there are no such contacts, the ball
  // does not fit into a surface, or a size is not positive.
  Contacts(BlendLaw law, double start_t, const std::array<Vec2, 2>& starts, bool known = false);

  const BlendLaw& law() const { return law_; }
  // The part of the guide's domain in which both contacts lie in the domains of their surfaces, the longest of several.
  const Interval& domain() const { return domain_; }
  // Where a contact passes over a line of its surface at which derivatives jump, or its seam, inside the domain.
  const std::vector<double>& breaks() const { return breaks_; }
  // By which distances are judged.
  double size() const { return size_; }
  Contact at(double t) const;

 private:
  static constexpr int kMaxUnknowns = 5;  // u, v, u, v, radius
  using Unknowns = std::array<double, kMaxUnknowns>;
  struct Place {
    double t = 0;
    Vec3 guide{0}, along{0};  // its point, its direction of length 1
    std::array<double, 2> sizes{0, 0};
  };
  struct Node {
    double t;
    Unknowns x;
  };
  struct Solution {
    Unknowns x{};
    bool found = false;
  };

  int count() const;
  const Curve& measured() const { return law_.measured ? *law_.measured : *law_.guide; }
  Place place_at(double t) const;
  Solution solve(const Place& place, Unknowns x) const;
  Solution enlarged(Place place, Unknowns x) const;
  Solution first_solution(double t, const std::array<Vec2, 2>& starts) const;
  Unknowns edge_start(const Place& place, const std::array<Vec2, 2>& starts) const;
  bool march(const Node& from, double direction, std::vector<Node>& nodes) const;
  bool is_inside(const Unknowns& x, double slack_share) const;
  void check_fit(const Node& node) const;
  void cut(const std::vector<Node>& nodes);
  double border_between(Node inside, const Node& outside) const;
  void find_breaks();
  Contact contact(const Place& place, const Unknowns& x) const;

  BlendLaw law_;
  ArcFraction fraction_;
  double size_ = 1;
  std::vector<Node> nodes_;
  Interval domain_;
  std::vector<double> breaks_;
};

}  // namespace lekalo::geometry
