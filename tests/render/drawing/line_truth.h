// Asks an oracle about every line of a drawing: at random places of its pieces, and on both sides of every transition.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "render/drawing/random_views.h"
#include "render/drawing/visibility/hidden_lines.h"
#include "support/line_oracle.h"
#include "support/sight_oracle.h"
#include "support/tier.h"

namespace lekalo::render {

using namespace geometry;
using oracle::sight::SolidPtr;

inline constexpr double kBisected = 1e-7;   // of a line's domain
inline constexpr double kSpeck = 0.05;      // pixels: pieces that need not be right
inline constexpr double kInPicture = 0.01;  // pixels: else no piece is wrong for longer than that
// Pixels: as near as this to where a line goes round its surface no oracle can tell, as points of the line are rounded:
// one that is 4e-15 off a torus meets it again 5e-8 before, at up to 4e-4 pixels from the place.
inline constexpr double kRounded = 1e-3;
// Sheets nearer than this before a point are its own; where the two bounds tell apart, a nearly touching sheet is near,
// and the oracle does not know. Of outlines, where rounding of 1e-16 makes two crossings 1e-8
// apart of the one contact, also two so near as that; so an outline can be told from its surface only so far (part of
// the line) from a cusp.
inline constexpr double kOwn = 3e-9, kOwnToo = 3e-8, kContact = 3e-6, kContactToo = 3e-5, kFromCusp = 1e-4;

struct Found {
  int views = 0, lines = 0, places = 0, transitions = 0, incomplete = 0;
  int unclear = 0, unclear_outlines = 0, wrong_places = 0, wrong_transitions = 0;
  int rounded = 0, near = 0;  // transitions that are right beside kRounded, or kInPicture, alone
};

// How many sheets lie before a point as seen from another; -1: it is not clear. With `contact`, sheets as near together
// or to the point as that only touch the way.
using Sheets = std::function<int(const Vec3& from, const Vec3& point, double contact)>;

inline Sheets sheets_of(std::vector<SolidPtr> solids) {
  return [solids](const Vec3& from, const Vec3& point, double contact) {
    const int layers = oracle::sight::layers_before(solids, from, point, kOwn, contact);
    return layers == oracle::sight::layers_before(solids, from, point, kOwnToo, contact) ? layers : -1;
  };
}

// Of rational Bezier patches, by halving (support/line_oracle.h). `own`: nearer than this before a point a sheet passes
// through it; where `own_too` tells otherwise it is not clear.
inline Sheets sheets_of_patches(const SurfaceSet& surfaces, double own = kOwn, double own_too = kOwnToo) {
  std::vector<oracle::PatchOracle> patches;
  for (const SurfacePtr& surface : surfaces)
    for (const SurfacePiece& piece : surface->pieces())
      patches.emplace_back(piece.points, piece.degree_u, piece.degree_v);
  return [patches, own, own_too](const Vec3& from, const Vec3& point, double contact) {
    const double length = glm::length(point - from);
    const Line line{from, (point - from) / length};
    int layers = 0;
    for (const oracle::PatchOracle& patch : patches) {
      bool undecided = false;
      for (const oracle::Root& root : patch.roots(line, &undecided)) {
        const double before = length - root.t;
        if (root.t <= 0 || before < (contact > 0 ? contact : own)) continue;
        if (before < own_too) return -1;
        ++layers;
      }
      if (undecided) return -1;
    }
    return layers;
  };
}

class Truth {
 public:
  Truth(const World& world, Sheets sheets, Views& random, Found& found, int places = 12, double away = kBisected,
        double contact = kContact)
      : camera_(*world.model().camera),
        sheets_(std::move(sheets)),
        random_(random),
        found_(found),
        places_(places),
        away_(away),
        contact_(contact) {
    const VisibleLines drawing = visible_lines(world, drawing_work(world));
    ++found_.views;
    if (drawing.incomplete > 0) {
      if (++found_.incomplete <= 5) ADD_FAILURE() << "view " << found_.views << " is said to be incomplete";
      return;
    }
    for (const VisibleLine& line : drawing.lines) check(line);
  }

 private:
  // -1: it is not clear.
  int layers(const VisibleLine& line, double t) const {
    const Vec3 p = line.curve->tangent(t).origin;
    const PicturePoint at = camera_.project(p);
    const Ray ray = camera_.ray(at.x, at.y);
    const Vec3 from = camera_.is_parallel() ? p - (at.depth + 5) * ray.direction : ray.origin;
    if (line.stroke.kind != "silhouette") return sheets_(from, p, 0);
    // Where the surface hardly bends along the line of sight, as near cusps, crossings of one contact are farther
    // apart.
    const int layers = sheets_(from, p, contact_);
    return layers >= 0 && layers == sheets_(from, p, kContactToo / kContact * contact_) ? layers : -1;
  }

  void check(const VisibleLine& line) {
    ++found_.lines;
    const double width = line.stroke.curve->domain().width();
    for (size_t k = 0; k < line.pieces.size(); ++k) {
      const VisiblePiece& piece = line.pieces[k];
      const double margin = std::min(away_ * width, 0.25 * piece.t.width());
      for (int i = 0; i < places_; ++i) {
        const double t = random_.number(piece.t.lo + margin, piece.t.hi - margin);
        if (near_cusp(line, t) || !is_in_picture(line, t)) continue;
        ++found_.places;
        const int truth = layers(line, t);
        if (truth < 0) ++unclear_of(line);
        if (truth < 0 || truth == piece.layers || is_speck(line, piece) || is_at_end(line, piece, t)) continue;
        ++found_.wrong_places;
        if (found_.wrong_places <= 5) report(line, piece, t, "place");
      }
      if (k + 1 == line.pieces.size() || line.pieces[k + 1].t.lo != piece.t.hi) continue;
      if (!is_in_picture(line, piece.t.hi)) continue;
      ++found_.transitions;
      const VisiblePiece& next = line.pieces[k + 1];
      const double away = (near_cusp(line, piece.t.hi) ? 2 * kFromCusp : away_) * width;
      const int before = layers(line, piece.t.hi - std::min(away, 0.5 * piece.t.width())),
                behind = layers(line, next.t.lo + std::min(away, 0.5 * next.t.width()));
      if (before < 0 || behind < 0) ++unclear_of(line);
      if ((before < 0 || before == piece.layers) && (behind < 0 || behind == next.layers)) continue;
      if (int* beside = is_right_beside(line, piece, next, kRounded)     ? &found_.rounded
                        : is_right_beside(line, piece, next, kInPicture) ? &found_.near
                                                                         : nullptr) {
        ++*beside;
        continue;
      }
      ++found_.wrong_transitions;
      if (found_.wrong_transitions <= 5) report(line, piece, piece.t.hi, "transition");
    }
  }

  // Outside of it lines go on as they are at its border.
  bool is_in_picture(const VisibleLine& line, double t) const {
    const Vec2 place = line.curve->place(t).p;
    return place.x >= 0 && place.y >= 0 && place.x <= camera_.width() && place.y <= camera_.height();
  }

  static bool is_at_end(const VisibleLine& line, const VisiblePiece& piece, double t) {
    const auto from = [&](double end) { return glm::length(line.curve->place(end).p - line.curve->place(t).p); };
    return std::min(from(piece.t.lo), from(piece.t.hi)) < kInPicture;
  }

  // Shorter than a twentieth of a pixel.
  static bool is_speck(const VisibleLine& line, const VisiblePiece& piece) {
    return glm::length(line.curve->place(piece.t.hi).p - line.curve->place(piece.t.lo).p) < kSpeck;
  }

  int& unclear_of(const VisibleLine& line) const {
    return line.stroke.kind == "silhouette" ? found_.unclear_outlines : found_.unclear;
  }

  // Whether both pieces are right from so many pixels away on.
  bool is_right_beside(const VisibleLine& line, const VisiblePiece& piece, const VisiblePiece& next, double off) const {
    const Vec2 place = line.curve->place(piece.t.hi).p;
    const auto right = [&](const VisiblePiece& one, double other) {
      // Towards the piece's middle, to where the picture has moved on so far.
      double lo = 0, hi = 0.5;
      const auto at = [&](double x) { return piece.t.hi + x * (other - piece.t.hi); };
      if (glm::length(line.curve->place(at(hi)).p - place) < off) return true;  // shorter than that
      for (int k = 0; k < 60; ++k) {
        const double x = 0.5 * (lo + hi);
        (glm::length(line.curve->place(at(x)).p - place) < off ? lo : hi) = x;
      }
      const int truth = layers(line, at(hi));
      return truth < 0 || truth == one.layers;
    };
    return right(piece, piece.t.lo) && right(next, next.t.hi);
  }

  static bool near_cusp(const VisibleLine& line, double t) {
    for (const double cusp : line.stroke.cusps)
      if (std::abs(t - cusp) < kFromCusp * line.stroke.curve->domain().width()) return true;
    // Outlines of tubes end at them.
    const Interval domain = line.stroke.curve->domain();
    return line.stroke.outward_offset && std::min(t - domain.lo, domain.hi - t) < kFromCusp * domain.width();
  }

  void report(const VisibleLine& line, const VisiblePiece& piece, double t, const char* what) const {
    const double width = line.stroke.curve->domain().width();
    std::string pieces;
    for (const VisiblePiece& one : line.pieces)
      pieces += " [" + std::to_string(one.t.lo) + " " + std::to_string(one.t.hi) + "]:" + std::to_string(one.layers);
    ADD_FAILURE() << "view " << found_.views << (camera_.is_parallel() ? " parallel " : " central ") << what << " of a "
                  << line.stroke.kind << " at t = " << t << ", (" << line.curve->place(t).p.x << ", "
                  << line.curve->place(t).p.y << ") px: " << piece.layers << " layers found, there are "
                  << layers(line, t) << " (before " << layers(line, t - away_ * width) << ", behind "
                  << layers(line, t + away_ * width) << ", 1e-5 away " << layers(line, t - 1e-5 * width) << ", "
                  << layers(line, t + 1e-5 * width) << "); pieces" << pieces;
  }

  const Camera& camera_;
  Sheets sheets_;
  Views& random_;
  Found& found_;
  int places_;   // asked for on each piece
  double away_;  // from transitions, of a line's domain
  double contact_;
};

inline void expect_nothing_wrong(const Found& found) {
  EXPECT_EQ(found.wrong_places, 0);
  EXPECT_EQ(found.wrong_transitions, 0);
  EXPECT_EQ(found.incomplete, 0);
}

inline void expect_right(const Found& found, const char* name, bool by_halving = false) {
  expect_nothing_wrong(found);
  // Halving cannot tell where a way touches a sheet, as all to an outline do, and hardly where it nearly does.
  const int asked = found.places + found.transitions;
  EXPECT_LE(found.unclear + (by_halving ? 0 : found.unclear_outlines), 1 + asked / (by_halving ? 10 : 100));
  EXPECT_LE(found.near, 1 + found.transitions / (by_halving ? 30 : 100));
  tests::report_figure(std::string(name) + " right_within_a_thousandth_of_a_pixel", found.rounded);
  tests::report_figure(std::string(name) + " right_within_a_hundredth_of_a_pixel", found.near);
  tests::report_figure(std::string(name) + " unclear", found.unclear);
  tests::report_figure(std::string(name) + " unclear_on_outlines", found.unclear_outlines);
  tests::report_figure(std::string(name) + " views", found.views);
  tests::report_figure(std::string(name) + " lines", found.lines);
  tests::report_figure(std::string(name) + " places", found.places);
  tests::report_figure(std::string(name) + " transitions", found.transitions);
}

}  // namespace lekalo::render
