#include "geometry/machining/tool_path.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/composition.h"
#include "geometry/curves/derived/composite_curve.h"
#include "geometry/describe.h"

namespace lekalo::geometry {

namespace {

constexpr int kTried = 1024;       // places of a path
constexpr double kBeside = 1e-10;  // of the domain: how far from a break both sides are looked at
constexpr double kJump = 1e-6;     // of the curve's size: places so near to each other are the same
// Steps back below this part of the way are rounding: of a cutter that fits the hollow, which stands still.
constexpr double kBack = 1e-9;

CurvePtr joined(const std::vector<ToolMove>& moves) {
  if (moves.size() == 1) return moves.front().curve;
  std::vector<CurvePtr> curves;
  for (const ToolMove& move : moves) curves.push_back(move.curve);
  return std::make_shared<CompositeCurve>(std::move(curves), false, kMovesMeet);
}

}  // namespace

Frame frame_of(const CutterPose& pose) {
  if (pose.contact) {
    const Vec3 to = pose.contact->point - pose.reference, across = to - glm::dot(to, pose.axis) * pose.axis;
    if (glm::length(across) > 1e-9 * glm::length(to)) return frame_from(pose.reference, pose.axis, across);
  }
  return frame_about(pose.reference, pose.axis);
}

std::string_view name(ToolMove::Kind kind) {
  switch (kind) {
    case ToolMove::Kind::cut:
      return "cut";
    case ToolMove::Kind::link:
      return "link";
    case ToolMove::Kind::approach:
      return "approach";
    case ToolMove::Kind::exit:
      return "exit";
    case ToolMove::Kind::rapid:
      break;
  }
  return "rapid";
}

double Feeds::of(ToolMove::Kind kind) const {
  if (kind == ToolMove::Kind::approach) return approach;
  const bool is_free = kind == ToolMove::Kind::rapid || kind == ToolMove::Kind::exit;
  return is_free ? rapid : cut;
}

ToolPath::ToolPath(Cutter cutter, std::vector<ToolMove> moves, std::optional<Feeds> feeds, ToolPathFacts facts)
    : cutter_(cutter), moves_(std::move(moves)), feeds_(feeds), facts_(facts), curve_(joined(moves_)) {
  double start = curve_->domain().lo;
  for (const ToolMove& move : moves_) {
    starts_.push_back(start);
    start += move.curve->domain().width();
  }
}

std::optional<double> ToolPath::feed_of(const ToolMove& move) const {
  if (move.feed) return move.feed;
  return feeds_ ? std::optional(feeds_->of(move.kind)) : std::nullopt;
}

CutterPose ToolPath::pose(double t) const {
  const double inside = domain().clamp(t);
  const auto after = std::upper_bound(starts_.begin() + 1, starts_.end(), inside);
  const size_t k = static_cast<size_t>(after - starts_.begin()) - 1;
  const Interval own = moves_[k].curve->domain();
  return moves_[k].pose(own.clamp(own.lo + (inside - starts_[k])));
}

void check_jumps(const Curve& curve, const std::vector<double>& breaks, const std::function<Vec3(double)>& place) {
  const Interval domain = curve.domain();
  const double room = kBeside * domain.width(), same = kJump * sampled_size(curve, domain);
  for (const double t : breaks) {
    if (t <= domain.lo || t >= domain.hi) continue;
    if (glm::length(place(domain.clamp(t + room)) - place(domain.clamp(t - room))) <= same) continue;
    throw FieldError("of", fmt::format("the path jumps at the corner at t = {:.6g}", t), "round the corner");
  }
}

bool is_closed_path(const Curve& curve, const std::function<Vec3(double)>& place) {
  const Interval domain = curve.domain();
  return glm::length(place(domain.hi) - place(domain.lo)) <= kJump * sampled_size(curve, domain);
}

std::optional<double> where_it_runs_back(const Curve& path, const std::function<Vec3(double)>& way) {
  const Interval domain = path.domain();
  for (int k = 0; k <= kTried; ++k) {
    const double t = domain.clamp(domain.lo + domain.width() * k / kTried);
    const Vec3 along = way(t);
    if (glm::dot(path.evaluate(t, 1).d[1], along) < -kBack * glm::dot(along, along)) return t;
  }
  return std::nullopt;
}

}  // namespace lekalo::geometry
