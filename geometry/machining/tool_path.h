// The path of a cutter: moves that follow one another, with the place of the cutter at each parameter and what is known
// of the whole (Zavyalov, Leus, Skorospelov 1985, V.1, VII.2).
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/curve.h"
#include "geometry/machining/cutter.h"
#include "geometry/surface.h"

namespace lekalo::geometry {

// Where the cutter is: P, q, and where it cuts the contact with the normal.
struct CutterPose {
  Vec3 reference{0}, axis{0, 0, 1};
  struct Contact {
    Vec3 point{0}, normal{0, 0, 1};
  };
  std::optional<Contact> contact;
};

// The frame of the cutter: origin P, z the axis, x towards the contact where that lies beside the axis.
Frame frame_of(const CutterPose& pose);

struct ToolMove {
  enum class Kind { cut, link, approach, exit, rapid };
  Kind kind = Kind::cut;
  CurvePtr curve;                             // in space, over a finite domain
  std::function<CutterPose(double)> pose;     // by the curve's parameter
  std::optional<double> feed = std::nullopt;  // its own, in place of that of its kind
};
std::string_view name(ToolMove::Kind kind);

// Speeds in lengths by unit of time.
struct Feeds {
  double cut = 1, approach = 1, rapid = 1;
  double of(ToolMove::Kind kind) const;
};

// What is known of a path; `u`, `v` where the least difference is.
struct ToolPathFacts {
  int rows = 0;  // 0: it is no path of rows
  std::optional<double> scallop_height;
  struct Bend {
    double min_difference, u, v;
  };
  std::optional<Bend> bend;  // curvature of the cutter above that of the part: negative where it cuts into it
  struct Strip {
    double height, min_width, max_width, min_band, max_band;
  };
  std::optional<Strip> strip;
  SurfacePtr part;  // that it cuts; null of a path along a curve
};

// Where the strip within a height lies in the parameter plane of the surface: circles of the diameter d(t) about a
// curve, d the length of the change of (u, v) over the strip's width.
struct CoverageBand {
  CurvePtr image;
  std::function<double(double)> diameter;
};

// Moves meet to rounding: this part of the size of the path.
inline constexpr double kMovesMeet = 1e-9;

class ToolPath final : public Curve {
 public:
  // Each move begins where the one before ends. The parameter is that of the only move, or grows by that of each from
  // 0.
  ToolPath(Cutter cutter, std::vector<ToolMove> moves, std::optional<Feeds> feeds, ToolPathFacts facts);

  const Cutter& cutter() const { return cutter_; }
  const std::vector<ToolMove>& moves() const { return moves_; }
  const ToolPathFacts& facts() const { return facts_; }
  // Speed of a move, if it is known.
  std::optional<double> feed_of(const ToolMove& move) const;
  // Of each row; none without a height.
  const std::vector<CoverageBand>& bands() const { return bands_; }
  void set_bands(std::vector<CoverageBand> bands) { bands_ = std::move(bands); }
  // The cutter at a parameter of the domain.
  CutterPose pose(double t) const;

  Interval domain() const override { return curve_->domain(); }
  double period() const override { return curve_->period(); }
  bool is_closed() const override { return curve_->is_closed(); }
  CurveJet evaluate(double t, int order) const override { return curve_->evaluate(t, order); }
  int max_order() const override { return curve_->max_order(); }
  double fit_distance() const override { return curve_->fit_distance(); }
  CurveEnclosure enclose(const Interval& t, int order) const override { return curve_->enclose(t, order); }
  int enclosure_order() const override { return curve_->enclosure_order(); }
  std::vector<CurvePiece> pieces() const override { return curve_->pieces(); }
  std::optional<NurbsCurveForm> as_nurbs() const override { return curve_->as_nurbs(); }

 private:
  Cutter cutter_;
  std::vector<ToolMove> moves_;
  std::optional<Feeds> feeds_;
  ToolPathFacts facts_;
  std::vector<CoverageBand> bands_;
  CurvePtr curve_;
  std::vector<double> starts_;  // parameters at which the moves begin
};

// Throws FieldError (field of) where a place that belongs to the curve's parameter jumps at one of the breaks in
// smoothness: the tool stands across the curve's direction, which is another one on the other side of a corner.
void check_jumps(const Curve& curve, const std::vector<double>& breaks, const std::function<Vec3(double)>& place);

// Whether the place at the domain's end is that at its beginning.
bool is_closed_path(const Curve& curve, const std::function<Vec3(double)>& place);

// The first parameter, among some places, where the path runs against the way along the curve: the curve is hollower
// than the tool there, and the path has a swallow-tail.
std::optional<double> where_it_runs_back(const Curve& path, const std::function<Vec3(double)>& way);

}  // namespace lekalo::geometry
