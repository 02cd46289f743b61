// A surface of the completeness suite with an oracle that shares nothing with the product's solvers.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "render/model/model.h"
#include "support/line_oracle.h"
#include "support/sign_oracle.h"
#include "support/solid_oracle.h"

namespace lekalo::render::completeness {

using namespace geometry;
using Random = std::mt19937_64;

// Where a line of unit direction meets a subject, in order, one number for each crossing. `undecided`: the oracle
// cannot tell.
using Truth = std::function<std::vector<double>(const Line& line, bool& undecided)>;

struct Subject {
  Entity entity;
  Affine transform;  // of the object that shows it
  Box3 box;          // as shown
  Truth truth;       // of it as shown
  // A place on a seam, pole, edge or border between pieces, and another on the same one; empty: there is none.
  std::function<std::pair<Vec3, Vec3>(Random&)> special;
  // Differences from the oracle's t up to this share of the size count as none: what the oracle's own arithmetic
  // allows.
  double same = 1e-9;
  double band = 1e-9;  // half its width, of the size
};

// Makes a subject that lies near the origin, or moved by the offset.
using Maker = std::function<Subject(const Vec3& offset)>;
struct Entry {
  std::string name;
  Maker make;
  bool closed = false;  // a line from outside crosses it an even number of times
};

inline double unit(Random& random) { return std::uniform_real_distribution<double>(0, 1)(random); }
inline Vec3 any_direction(Random& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random);
  return glm::normalize(Vec3(x, y, normal(random)));
}
inline Vec3 any_point(Random& random, const Box3& box) {
  const double x = unit(random), y = unit(random);
  return box.lo + Vec3(x, y, unit(random)) * box.size();
}

// The line with its origin where it passes the point, in coordinates relative to the point, and how far that is, in
// long double: what is far away loses no digits here.
inline Line moved_near(const Line& line, const Vec3& point, double& by) {
  long double along = 0, square = 0;
  for (int k = 0; k < 3; ++k) {
    along += (static_cast<long double>(point[k]) - line.origin[k]) * line.direction[k];
    square += static_cast<long double>(line.direction[k]) * line.direction[k];
  }
  by = static_cast<double>(along / square);
  Line result = line;
  for (int k = 0; k < 3; ++k)
    result.origin[k] = static_cast<double>(line.origin[k] + static_cast<long double>(by) * line.direction[k] -
                                           static_cast<long double>(point[k]));
  return result;
}

// From an oracle for lines that begin near the origin to one for a subject moved by the offset.
inline Truth moved(const Vec3& offset, const Truth& truth) {
  return [=](const Line& line, bool& undecided) {
    double by = 0;
    std::vector<double> t = truth(moved_near(line, offset, by), undecided);
    for (double& x : t) x += by;
    return t;
  };
}

// -------------------------------------------------------------------------------- rational pieces

// A corner of the dyadic net of a piece, or a place on its lines; half of them on the border of the piece.
inline std::function<std::pair<Vec3, Vec3>(Random&)> borders_of(const SurfaceSet& surfaces) {
  struct Place {
    SurfacePtr surface;
    Rectangle domain;
  };
  std::vector<Place> places;
  for (const SurfacePtr& surface : surfaces)
    for (const SurfacePiece& piece : surface->pieces()) places.push_back({surface, piece.domain});
  return [=](Random& random) {
    const Place& place = places[static_cast<size_t>(unit(random) * places.size())];
    const Interval &u = place.domain.u, &v = place.domain.v;
    const auto dyadic = [&](const Interval& range) {
      const int parts = 1 << static_cast<int>(unit(random) < 0.5 ? 0 : 10 * unit(random));
      return range.lo + range.width() * std::floor(unit(random) * (parts + 1)) / parts;
    };
    const auto any = [&](const Interval& range) {
      return unit(random) < 0.25 ? dyadic(range) : range.lo + unit(random) * range.width();
    };
    if (unit(random) < 0.5) {
      const double at = dyadic(u), first = any(v);
      return std::pair(place.surface->point(at, first), place.surface->point(at, any(v)));
    }
    const double at = dyadic(v), first = any(u);
    return std::pair(place.surface->point(first, at), place.surface->point(any(u), at));
  };
}

// The halving oracle over all pieces. A root on the border of two pieces is found by both; two that are as near without
// being the same to the oracle's own rounding may be two.
inline Truth truth_of(const SurfaceSet& surfaces, double size) {
  std::vector<oracle::PatchOracle> patches;
  for (const SurfacePtr& surface : surfaces)
    for (const SurfacePiece& piece : surface->pieces())
      patches.emplace_back(piece.points, piece.degree_u, piece.degree_v);
  return [patches = std::make_shared<std::vector<oracle::PatchOracle>>(std::move(patches)), size](const Line& line,
                                                                                                  bool& undecided) {
    struct Found {
      double t;
      size_t patch;
    };
    std::vector<Found> found;
    for (size_t k = 0; k < patches->size(); ++k) {
      bool full = false;
      for (const oracle::Root& root : (*patches)[k].roots(line, &full)) found.push_back({root.t, k});
      undecided = undecided || full;
    }
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.t < b.t; });
    std::vector<double> t;
    for (size_t k = 0; k < found.size(); ++k) {
      const double apart = k == 0 ? kInfinity : found[k].t - found[k - 1].t;
      if (apart > 1e-9 * size || found[k].patch == found[k - 1].patch)
        t.push_back(found[k].t);
      else
        undecided = undecided || apart > 1e-11 * size;
    }
    return t;
  };
}

inline Subject subject_of(const SurfaceSet& surfaces) {
  Subject subject;
  subject.entity = surfaces.size() == 1 ? Entity(surfaces[0]) : Entity(surfaces);
  for (const SurfacePtr& surface : surfaces) subject.box.include(bounds(*surface));
  subject.truth = truth_of(surfaces, subject.box.diameter());
  subject.special = borders_of(surfaces);
  return subject;
}

// -------------------------------------------------------------------------------- other subjects

// A shape that lies near the origin, moved by its object's transform.
inline Subject subject_of(const ShapePtr& shape, const Vec3& offset, const Truth& truth) {
  Subject subject;
  subject.entity = shape;
  subject.transform = Affine::translation(offset);
  subject.box = transformed(shape->bounds(), subject.transform);
  subject.truth = moved(offset, truth);
  return subject;
}

// What a line has inside a box.
inline Interval inside(const Line& line, const Box3& box) {
  Interval t{-kInfinity, kInfinity};
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lo[k] - line.origin[k]) / line.direction[k],
                 b = (box.hi[k] - line.origin[k]) / line.direction[k];
    t = intersect(t, {std::min(a, b), std::max(a, b)});
  }
  return t;
}

// F = 0 inside a box by halving and signs. `closed`: the border of F <= 0 there.
template <class F>
Truth truth_of_signs(const Box3& box, bool closed) {
  return [=](const Line& line, bool& undecided) {
    const Interval t = inside(line, box);
    if (!(t.width() > 0)) return std::vector<double>();
    if (t.width() < 1e-6 * box.diameter()) undecided = true;
    oracle::SignOracle<F> oracle;
    typename oracle::SignOracle<F>::Answer answer = oracle.ask(line, t.lo, t.hi);
    undecided = undecided || answer.doubtful;
    if (!closed) return answer.t;
    std::vector<double> result;
    const auto inside_at = [&](double at) {
      const Vec3 p = line.at(at);
      return F()(Quad(p.x), Quad(p.y), Quad(p.z)) < Quad(0);
    };
    if (inside_at(t.lo)) result.push_back(t.lo);
    result.insert(result.end(), answer.t.begin(), answer.t.end());
    if (inside_at(t.hi)) result.push_back(t.hi);
    return result;
  };
}

}  // namespace lekalo::render::completeness
