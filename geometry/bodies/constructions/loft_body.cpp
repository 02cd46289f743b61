// Bodies through plane sections (Golovanov 2016, 5.8): face i is a surface on segment i of every section. Closed ones
// go through the first section again. With a guide g and its frame A the sections are carried along it and neighbours
// blended:
//
//   R_j(u, v) = g(v) + A(v) A^-1(v_j) (r_j(u) - g(v_j))
#include <fmt/format.h>

#include <cmath>

#include "geometry/bodies/constructions/profile.h"
#include "geometry/bodies/constructions/swept_body.h"
#include "geometry/curves/derived/reparametrized_curve.h"
#include "geometry/curves/operations/parameter_line.h"
#include "geometry/surfaces/nets/curve_family.h"
#include "geometry/surfaces/nets/lofts.h"
#include "geometry/surfaces/swept/sweep.h"

namespace lekalo::geometry {

namespace {

Vec3 center_of(const Profile& section) {
  Vec3 sum(0);
  const std::vector<Vec3> points = section.samples();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Each section's plane looks towards the next one, the last one's away from the one before.
void face_forward(std::vector<Profile>& sections, bool closed) {
  const size_t count = sections.size();
  for (size_t i = 0; i < count; ++i) {
    const size_t next = i + 1 < count ? i + 1 : closed ? 0 : i, from = next == i ? i - 1 : i, to = next == i ? i : next;
    const Vec3 motion = center_of(sections[to]) - center_of(sections[from]);
    try {
      face_along(sections[i], motion, "of");
    } catch (const FieldError&) {
      throw FieldError("of", fmt::format("the plane of section {} runs through its neighbour's center", i),
                       "sections that follow one another across their planes");
    }
  }
}

// Segments that run clockwise, seen against the plane, the other way round in the opposite order.
std::vector<CurvePtr> counterclockwise(const Profile& section) {
  const ProfileLoop& loop = section.loops[0];
  if (section.is_left(loop)) return loop.segments;
  std::vector<CurvePtr> result;
  for (size_t i = loop.segments.size(); i-- > 0;) result.push_back(reversed_curve(loop.segments[i]));
  return result;
}

class Lofting {
 public:
  explicit Lofting(const Fields& f) : fields_(f), closed_(f.boolean("closed")) {
    for (const std::any& one : f.references("of")) curves_.push_back(std::any_cast<CurvePtr>(one));
    if (curves_.size() < 2) throw FieldError("of", "a loft has two sections at least");
    check_guide();
    for (size_t i = 0; i < curves_.size(); ++i) read(i);
    face_forward(sections_, closed_);
    for (const Profile& section : sections_) segments_.push_back(counterclockwise(section));
    for (size_t i = 1; i < segments_.size(); ++i)
      if (segments_[i].size() != segments_[0].size())
        throw FieldError("of",
                         fmt::format("section 0 has {} segment{} and section {} has {}", segments_[0].size(),
                                     segments_[0].size() == 1 ? "" : "s", i, segments_[i].size()),
                         "as many corners in each section");
  }

  Body build() {
    // All faces have the same values of v at the sections.
    if (!fields_.has("at_v") && passes_through())
      fields_.set("at_v", read_nodes(fields_, "at_v", one_domain(curves_, fields_), closed_));
    SweptParts parts;
    SweptLoop loop;
    for (size_t k = 0; k < segments_[0].size(); ++k) loop.sides.push_back(side(k));
    parts.loops.push_back(std::move(loop));
    if (!closed_) parts.ends = {sections_.front().plane, sections_.back().plane};
    return swept_body(parts);
  }

 private:
  void check_guide() const {
    if (!fields_.has("along")) {
      if (fields_.given("frame")) throw FieldError("frame", "there is no guide whose frame turns", "leave it out");
      return;
    }
    if (!fields_.has("at_v"))
      throw FieldError("at_v", "the guide's parameters at the sections are missing", "one value for each section");
    for (const char* field : {"closed", "method"})
      if (fields_.given(field))
        throw FieldError(field, "along a guide neighbouring sections are blended by cubics, from the first to the last",
                         "leave it out");
  }

  bool passes_through() const {
    const std::string& method = fields_.text("method");
    return method == "hermite" || method == "spline" || method == "lagrange";
  }

  void read(size_t i) {
    try {
      sections_.push_back(profile_of({curves_[i]}, "of"));
    } catch (const FieldError& error) {
      throw FieldError("of", fmt::format("section {}: {}", i, error.what()), error.hint);
    }
  }

  SweptSide side(size_t k) const {
    std::vector<CurvePtr> of;
    for (const auto& section : segments_) of.push_back(section[k]);
    of = one_domain(std::move(of), fields_);
    const SurfacePtr surface = fields_.has("along") ? guided_loft(fields_, of) : loft_surface(fields_, of);
    return {surface, of.front(), of.back(),
            std::make_shared<ParameterLine>(surface, IsoDirection::u, surface->domain().u.lo)};
  }

  Fields fields_;
  bool closed_;
  std::vector<CurvePtr> curves_;
  std::vector<Profile> sections_;
  std::vector<std::vector<CurvePtr>> segments_;
};

}  // namespace

TypeDeclaration loft_body_type() {
  TypeDeclaration type =
      declare(
          Category::body, "loft_body",
          "Body through plane sections. Faces: side.k on segment k of every section, and start and end unless it is "
          "closed. Methods as of loft_surface.")
          .example(
              "of: [{ type: circle, radius: 1 }, { type: circle, radius: 2, center: [0, 0, 1] }, "
              "{ type: circle, radius: 1, center: [0, 0, 2] }]")
          .field("of", references({Category::curve}),
                 "closed plane curves in their order, with as many segments each; the first segments belong together");
  declare_loft(type);
  type.optional("along", reference({Category::curve}),
                "a guide whose frame carries each section to its neighbours; at_v are its parameters there")
      .field("frame", guide_frame(), "how the guide's frame turns, as of guided_loft", "rotation_minimizing");
  type.built_by([](const Fields& f) -> BodyPtr { return std::make_shared<Body>(Lofting(f).build()); });
  return type;
}

}  // namespace lekalo::geometry
