// A program of moves of a cutter, one after another: to points, by increments, along paths (the milling operators of
// Zavyalov, Leus, Skorospelov 1985, VII.2).
#include <fmt/format.h>

#include "geometry/curves/analytic/segment.h"
#include "geometry/machining/contact_fields.h"

namespace lekalo::geometry {

namespace {

class Program {
 public:
  Program(const Cutter& cutter, const Vec3& start, const Vec3& axis) : cutter_(cutter), at_{start, axis, std::nullopt} {
    box_.include(start);
  }

  void move_to(const Vec3& point, ToolMove::Kind kind, std::optional<double> feed, const std::string& field) {
    if (!(glm::length(point - at_.reference) > 0)) throw FieldError(field, "the move leads nowhere", "leave it out");
    const auto pose = [from = at_.reference, to = point, axis = at_.axis](double t) {
      return CutterPose{(1 - t) * from + t * to, axis, std::nullopt};
    };
    moves_.push_back({kind, std::make_shared<Segment>(at_.reference, point), pose, feed});
    box_.include(point);
    at_.reference = point;
  }

  void follow(const ToolPath& path, std::optional<double> feed, const std::string& field) {
    if (path.cutter() != cutter_) throw FieldError(field, "the path is one of another cutter", "the same cutter");
    const Vec3 begin = path.point(path.domain().lo);
    box_.include(bounds(path));
    const double near = kMovesMeet * box_.diameter();
    if (!(glm::length(path.pose(path.domain().lo).reference - begin) <= near))
      throw FieldError(field, "the path is not that of the middle of the cutter's end", "point: reference");
    const double gap = glm::length(begin - at_.reference);
    if (!(gap <= near))
      throw FieldError(
          field,
          fmt::format("the path begins at ({:.6g}, {:.6g}, {:.6g}), {:.6g} from the end of the move before", begin.x,
                      begin.y, begin.z, gap),
          "a move there first");
    for (ToolMove move : path.moves()) {
      const auto own = path.feed_of(move);
      move.feed = own ? own : feed;
      moves_.push_back(std::move(move));
    }
    at_ = path.pose(path.domain().hi);
    at_.reference = path.point(path.domain().hi);
  }

  const Vec3& place() const { return at_.reference; }
  ToolPath finish() { return ToolPath(cutter_, std::move(moves_), std::nullopt, {}); }

 private:
  Cutter cutter_;
  CutterPose at_;
  Box3 box_;  // of all moves
  std::vector<ToolMove> moves_;
};

ToolPath tool_program(const Fields& f) {
  Program program(read_cutter(f.group("cutter"), "cutter."), f.vec3("start"), f.vec3("axis"));
  int index = 0;
  for (const Fields& move : f.groups("moves")) {
    const std::string field = fmt::format("moves.{}", index++);
    if (move.has("to") + move.has("by") + move.has("path") != 1)
      throw FieldError(field, "a move says one thing of three", "'to', 'by' or 'path'");
    std::optional<double> feed;
    if (move.has("feed")) feed = move.number("feed");
    const auto kind = move.boolean("rapid") ? ToolMove::Kind::rapid : ToolMove::Kind::cut;
    if (!move.has("path")) {
      program.move_to(move.has("to") ? move.vec3("to") : program.place() + move.vec3("by"), kind, feed, field);
      continue;
    }
    const auto* path = dynamic_cast<const ToolPath*>(move.curve("path").get());
    if (kind == ToolMove::Kind::rapid)
      throw FieldError(field, "a path says itself which of its moves are in the air", "leave out 'rapid'");
    if (!path) throw FieldError(field, "the curve is no path of a cutter, or one that was moved", "a tool_path");
    program.follow(*path, feed, field);
  }
  return program.finish();
}

}  // namespace

TypeDeclaration tool_program_type() {
  return declare(Category::curve, "tool_program",
                 "Moves of a milling cutter, one after another: to points, by increments, along paths. For the time, "
                 "which 'lekalo measure' tells, each move has a feed.")
      .example(
          "cutter: { radius: 0.5, length: 2 }, start: [3, 0, 4], moves: [{ by: [0, 0, -4], rapid: true, feed: 1000 }, "
          "{ "
          "to: [3, 2, 0], feed: 100 }]")
      .field("cutter", cutter_field(), "the milling cutter: radius, corner_radius, length, angle")
      .field("start", point(), "where the middle of its end is at the beginning")
      .field("axis", direction(), "of the cutter in straight moves, until a path turns it", "z")
      .field("moves",
             groups({{"to", point(), "to a point", false, ""},
                     {"by", vector(), "by an increment", false, ""},
                     {"path", reference({Category::curve}),
                      "along a path of the same cutter, with its reference point: tool_path, cutter_path, flank_path",
                      false, ""},
                     {"rapid", boolean(), "of a straight move: in the air", false, "false"},
                     {"feed", number().positive(), "speed; of a path, where it has none of its own", false, ""}})
                 .count(1),
             "in their order")
      .shows({"cutters", "tool_axes", "contacts", "tool_moves"})
      .built_by(tool_program);
}

}  // namespace lekalo::geometry
