// Paths of a cutter in rows over a surface (Zavyalov, Leus, Skorospelov 1985, V.1, figure 48, and the operator of VII.2
// for surfaces): all in one direction, the cutter lifted along its axis between them, or to and fro.
//
// To and fro with a fixed axis the cutter stays on the surface on its way to the next row, along the border of the
// rows; with an axis that leans by the direction of the row, and between sections, it goes straight.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/curves/analytic/segment.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/surface_curve.h"
#include "geometry/machining/contact_fields.h"
#include "geometry/machining/rows.h"

namespace lekalo::geometry {

namespace {

using Kind = ToolMove::Kind;

// Ways shorter than this part of the cutter are none.
constexpr double kNoWay = 1e-12;

struct Joining {
  bool to_and_fro = true;
  bool on_surface = false;  // links along the border
  std::optional<double> approach, exit;
};

class PathOfRows {
 public:
  PathOfRows(const Joining& joining, double size) : joining_(joining), size_(size) {}

  // Rows in order; those of one place follow one another.
  void add(PathRow row, bool turned) {
    CurvePtr& image = row.contact.line.image;
    if (turned) image = reversed_curve(image);
    const ToolMove move =
        contact_move(row.contact, SurfaceCurve(row.contact.line.of, image), Kind::cut, PathPoint::reference);
    const CutterPose start = move.pose(move.curve->domain().lo);
    if (rows_.empty())
      lower(start);
    else if (joining_.to_and_fro)
      link(row, start);
    else
      lift_over(start);
    moves_.push_back(move);
    rows_.push_back(std::move(row));
  }

  // The moves, the last lift among them.
  std::vector<ToolMove> finish() {
    if (joining_.exit && !moves_.empty()) lift();
    return std::move(moves_);
  }

  CutterPose last_pose() const { return moves_.back().pose(moves_.back().curve->domain().hi); }
  const std::vector<PathRow>& rows() const { return rows_; }

 private:
  void straight(Kind kind, const CutterPose& from, const CutterPose& to) {
    if (glm::length(to.reference - from.reference) <= kNoWay * size_) return;
    const auto pose = [a = from, b = to](double t) {
      const Vec3 axis = (1 - t) * a.axis + t * b.axis;
      return CutterPose{(1 - t) * a.reference + t * b.reference, glm::normalize(axis), std::nullopt};
    };
    moves_.push_back({kind, std::make_shared<Segment>(from.reference, to.reference), pose});
  }
  static CutterPose above(const CutterPose& pose, double length) {
    return {pose.reference + length * pose.axis, pose.axis, std::nullopt};
  }
  void lower(const CutterPose& start) {
    if (joining_.approach) straight(Kind::approach, above(start, *joining_.approach), start);
  }
  void lift() {
    const CutterPose end = last_pose();
    straight(Kind::exit, end, above(end, *joining_.exit));
  }
  void lift_over(const CutterPose& start) {
    lift();
    straight(Kind::rapid, last_pose(), above(start, *joining_.approach));
    lower(start);
  }
  void link(const PathRow& row, const CutterPose& start) {
    if (!joining_.on_surface) return straight(Kind::link, last_pose(), start);
    const auto end_of = [](const PathRow& one, bool last) {
      const CurvePtr& image = one.contact.line.image;
      return image->point(last ? image->domain().hi : image->domain().lo);
    };
    SurfaceContact contact = row.contact;
    contact.line.image = std::make_shared<Segment>(end_of(rows_.back(), true), end_of(row, false));
    moves_.push_back(
        contact_move(contact, SurfaceCurve(contact.line.of, contact.line.image), Kind::link, PathPoint::reference));
  }

  Joining joining_;
  double size_;
  std::vector<ToolMove> moves_;
  std::vector<PathRow> rows_;
};

RowFamily read_family(const Fields& f, const SurfaceContact& contact) {
  if (f.has("planes")) {
    for (const char* field : {"along", "part"})
      if (f.given(field)) throw FieldError(field, "rows in planes run where these cut the surface", "leave it out");
    return RowFamily::of_planes(contact, f.group("planes").vec3("through"), f.group("planes").vec3("normal"));
  }
  const Rectangle domain = contact.line.of->domain(), part = f.has("part") ? f.rectangle("part") : domain;
  if (!domain.u.contains(part.u) || !domain.v.contains(part.v))
    throw FieldError("part", fmt::format("the surface's domain is u [{:.6g}, {:.6g}], v [{:.6g}, {:.6g}]", domain.u.lo,
                                         domain.u.hi, domain.v.lo, domain.v.hi));
  return RowFamily::of_parameter(contact, f.text("along") == "u", part);
}

RowSpacing read_spacing(const Fields& f) {
  RowSpacing spacing;
  if (f.has("count")) spacing.count = f.integer("count");
  if (f.has("spacing")) spacing.distance = f.number("spacing");
  if (f.has("scallop")) spacing.height = f.number("scallop");
  if (spacing.count.has_value() + spacing.distance.has_value() + spacing.height.has_value() != 1)
    throw FieldError(f.has("count") ? "count" : "of", "the rows are spread by one of three",
                     "'count', 'spacing' or 'scallop'");
  return spacing;
}

Joining read_joining(const Fields& f, const SurfaceContact& contact) {
  Joining joining;
  joining.to_and_fro = f.text("pattern") == "zigzag";
  joining.on_surface = contact.axis.kind == ToolAxis::Kind::fixed && !f.has("planes");
  if (!joining.to_and_fro) joining.approach = joining.exit = contact.cutter.radius;
  if (f.has("approach")) joining.approach = f.number("approach");
  if (f.has("exit")) joining.exit = f.number("exit");
  return joining;
}

std::optional<Feeds> read_feeds(const Fields& f) {
  if (!f.has("feed")) {
    for (const char* field : {"approach_feed", "rapid_feed"})
      if (f.has(field)) throw FieldError(field, "the feed of the cutting moves is missing", "feed");
    return std::nullopt;
  }
  Feeds feeds;
  feeds.cut = feeds.approach = feeds.rapid = f.number("feed");
  if (f.has("approach_feed")) feeds.approach = f.number("approach_feed");
  if (f.has("rapid_feed")) feeds.rapid = f.number("rapid_feed");
  return feeds;
}

// The way of a row agrees with that of the row before it.
bool runs_back(const PathRow& row, const Vec3& way) {
  const CurvePtr& image = row.contact.line.image;
  const auto at = [&](double t) { return row.contact.at(t).contact; };
  const Triple<double> own = at(image->domain().hi) - at(image->domain().lo);
  return dot(own, triple(way)) < 0;
}

Vec3 way_of(const PathRow& row) {
  const CurvePtr& image = row.contact.line.image;
  return vec(row.contact.at(image->domain().hi).contact - row.contact.at(image->domain().lo).contact);
}

// The nearest places of rows before and after that of a row: several rows may lie at one place. Rows are in order.
std::vector<double> places_beside(const std::vector<PathRow>& rows, double place) {
  const auto lies_before = [](const PathRow& row, double at) { return row.at < at; };
  const auto lies_after = [](double at, const PathRow& row) { return at < row.at; };
  const auto first = std::lower_bound(rows.begin(), rows.end(), place, lies_before);
  const auto next = std::upper_bound(rows.begin(), rows.end(), place, lies_after);
  std::vector<double> places;
  if (first != rows.begin()) places.push_back((first - 1)->at);
  if (next != rows.end()) places.push_back(next->at);
  return places;
}

ToolPathFacts facts_of(const RowFamily& family, const std::vector<PathRow>& rows) {
  ToolPathFacts facts;
  facts.rows = static_cast<int>(rows.size());
  facts.part = rows.front().contact.line.of;
  facts.bend = {kInfinity, 0, 0};
  double greatest = 0;
  for (const PathRow& row : rows) {
    const StripReport report = strip_report(row.contact, row.contact.line.image->domain(), 0);
    if (report.min_difference < facts.bend->min_difference) facts.bend = {report.min_difference, report.u, report.v};
    for (const double other : places_beside(rows, row.at))
      greatest = std::max(greatest, family.scallop(row, std::abs(row.at - other)));
  }
  if (std::isfinite(greatest) && rows.front().at < rows.back().at) facts.scallop_height = greatest;
  return facts;
}

std::vector<CoverageBand> bands_of(const std::vector<PathRow>& rows, double height) {
  std::vector<CoverageBand> bands;
  for (const PathRow& row : rows) bands.push_back(band_of(row.contact, row.contact.line.image, height));
  return bands;
}

ToolPath tool_path(const Fields& f) {
  if (!f.surface("of")->bounded()) throw FieldError("of", "the surface is unbounded", "give it a domain");
  const SurfaceContact contact = read_contact(f);
  const RowFamily family = read_family(f, contact);
  const Joining joining = read_joining(f, contact);
  PathOfRows path(joining, contact.cutter.radius);
  Vec3 way(0);
  int index = 0;
  for (const double place : row_places(family, read_spacing(f))) {
    const std::vector<PathRow> rows = family.at(place);
    if (joining.to_and_fro && rows.size() > 1)
      throw FieldError("pattern", fmt::format("the plane at {:.6g} cuts the surface in {} lines", place, rows.size()),
                       "one_way");
    for (const PathRow& row : rows) {
      const bool runs_other_way = family.has_rows_at_ends() ? false : runs_back(row, way);
      if (way == Vec3(0)) way = way_of(row);
      path.add(row, (joining.to_and_fro && index % 2 == 1) != runs_other_way);
      ++index;
    }
  }
  if (path.rows().empty()) throw FieldError("planes", "no plane cuts the surface", "another spacing or count");
  const ToolPathFacts facts = facts_of(family, path.rows());
  check_gouging(f, *facts.bend);
  ToolPath result(contact.cutter, path.finish(), read_feeds(f), facts);
  if (f.has("scallop")) result.set_bands(bands_of(path.rows(), f.number("scallop")));
  return result;
}

}  // namespace

TypeDeclaration tool_path_type() {
  TypeDeclaration type = declare(Category::curve, "tool_path",
                                 "Path of a milling cutter in rows over a surface: along lines of a parameter, or in "
                                 "parallel planes. 'lekalo measure' tells rows, lengths, time, the height of cusps and "
                                 "how near the cutter is to cutting into the part.");
  type.example(
          "of: { type: sphere_surface, radius: 4, domain: { u: [0, 1.2], v: [0.4, 1.2] } }, cutter: { radius: 0.5, "
          "corner_radius: 0.5, length: 2 }, count: 6")
      .field("of", reference({Category::surface}), "the surface; bounded, with a normal all along the rows")
      .field("along", choice({"u", "v"}), "which parameter runs along a row; the other one is held", "u")
      .optional("part", rectangle(), "of the surface's parameters, on which the rows lie; all when left out")
      .optional("planes",
                group({{"through", point(), "a point of one, from which places count", false, "[0, 0, 0]"},
                       {"normal", direction(), "of the planes", true, {}}}),
                "rows where parallel planes cut the surface, in place of lines of a parameter")
      .optional("count", integer().between(1, 10000), "of the rows, evenly spread")
      .optional("spacing", number().positive(), "rows at most so far apart: in the held parameter, or of the planes")
      .optional("scallop", length().positive(), "rows so far apart that cusps between them are at most so high")
      .field("pattern", choice({"zigzag", "one_way"}),
             "rows to and fro; or all in one direction, with the cutter lifted on its way back", "zigzag");
  declare_contact(type);
  return type
      .optional("approach", length().positive(),
                "from how high along the axis the cutter comes down to a row; of one_way its radius when left out")
      .optional("exit", length().positive(), "how high along the axis it is lifted from a row; as approach")
      .optional("feed", number().positive(), "speed of cutting moves, scene units by unit of time")
      .optional("approach_feed", number().positive(), "speed of the way down; the feed when left out")
      .optional("rapid_feed", number().positive(), "speed of moves in the air; the feed when left out")
      .shows({"cutters", "tool_axes", "contacts", "tool_moves"})
      .built_by(tool_path);
}

}  // namespace lekalo::geometry
