#include "render/model/section.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/bodies/primitives/primitives.h"
#include "geometry/box_corners.h"
#include "geometry/shapes/csg/body_shape.h"
#include "geometry/shapes/csg/csg.h"
#include "geometry/shapes/csg/half_space.h"
#include "geometry/transformed.h"
#include "render/model/section_faces.h"
#include "render/model/text_template.h"

namespace lekalo::render {

using namespace geometry;

namespace {

// Hatchings of neighbours, which differ (ISO 128-3).
constexpr double kAngles[] = {45, 135, 30, 150, 60, 120};  // degrees
constexpr double kBeyond = 0.1;                            // of the size: by which tools go beyond what they cut
// Faces of the tool of a stepped section: its planes, and the face over against them.
constexpr const char *kStepped = "stepped_section", *kCut = "cut", *kAway = "away";
constexpr double kSamePlace = 1e-9;  // of a path's size

ShapePtr solid_of(const Object& object) {
  if (const auto* body = std::get_if<BodyPtr>(&object.shape))
    return (*body)->is_closed() ? std::make_shared<BodyShape>(*body) : nullptr;
  const auto* shape = std::get_if<ShapePtr>(&object.shape);
  return shape && (*shape)->is_closed() ? *shape : nullptr;
}

// The frame of a stepped section: its line lies in the x-y plane, y is the side that is taken away.
Frame frame_of(const Section& section) {
  const Vec3 z = glm::normalize(section.along), y = glm::normalize(section.towards - glm::dot(section.towards, z) * z);
  Frame frame;
  frame.x = glm::cross(y, z), frame.y = y, frame.z = z;
  return frame;
}

// The line must lead across the side that is taken away, from one end to the other: then it parts what is taken away
// from what stays.
void check_path(const Section& section) {
  const Frame frame = frame_of(section);
  std::vector<Vec2> line;
  for (const Vec3& p : section.path) line.push_back(Vec2(frame.to_local_point(p)));
  double size = 0;
  for (const Vec2& p : line) size = std::max(size, glm::length(p - line.front()));
  const double same = kSamePlace * size, across = line.back().x - line.front().x;
  const auto corner = [](size_t k) { return "path." + std::to_string(k); };
  for (size_t k = 1; k < line.size(); ++k)
    if (glm::length(line[k] - line[k - 1]) <= same)
      throw FieldError(corner(k), "seen along 'along', this corner lies on the one before", "leave it out");
  if (std::abs(across) <= same)
    throw FieldError("path", "the line does not lead across 'towards'", "for towards: -y it goes from left to right");
  for (size_t k = 1; k < line.size(); ++k) {
    const double step = (line[k].x - line[k - 1].x) * (across > 0 ? 1 : -1);
    if (step < -same)
      throw FieldError(corner(k), "the line goes back: nothing says what lies behind it",
                       "steps lead along 'towards' or across it, always the same way");
    if (std::abs(step) <= same && (k == 1 || k == line.size() - 1))
      throw FieldError(corner(k == 1 ? 0 : k), "the line ends along 'towards': its ends go on without end",
                       "let the first and the last piece lead across 'towards'");
  }
}

// The line of a stepped section, its ends taken beyond the box, and what lies on its side of `towards`.
Body prism_behind(const Section& section, const Box3& box) {
  Frame frame = frame_of(section);
  const double reach = (1 + kBeyond) * box.diameter();
  Interval height(kInfinity, -kInfinity);
  Vec2 lo(kInfinity), hi(-kInfinity);
  const auto local = [&](const Vec3& p) { return Vec2(frame.to_local_point(p)); };
  for (const Vec3& p : corners(box)) {
    height = hull(height, Interval(glm::dot(p, frame.z)));
    lo = glm::min(lo, local(p)), hi = glm::max(hi, local(p));
  }
  std::vector<Vec2> line;
  for (const Vec3& p : section.path) line.push_back(local(p));
  if (line.front().x > line.back().x) std::reverse(line.begin(), line.end());
  line.front() += reach * glm::normalize(line.front() - line[1]);
  line.back() += reach * glm::normalize(line.back() - line[line.size() - 2]);
  const double top = std::max({hi.y, line.front().y, line.back().y}) + reach;
  line.emplace_back(line.back().x, top);
  line.emplace_back(line.front().x, top);
  frame.origin = (height.lo - kBeyond * reach) * frame.z;
  Body body = prism(frame, line, height.width() + 2 * kBeyond * reach);
  const int pieces = static_cast<int>(section.path.size()) - 1;
  for (Face& face : body.faces)
    if (face.origin.role == "side" && face.origin.index <= pieces + 1)
      face.origin = {kStepped, face.origin.index < pieces ? kCut : face.origin.index == pieces + 1 ? kAway : "", -1};
  return body;
}

// What is taken away, in coordinates from which the map leads to the section's.
ShapePtr tool_of(const Section& section, const Box3& box, const Affine& to_world) {
  const Affine back = to_world.inverse();
  if (section.cut_away) return back.is_identity() ? section.cut_away : transformed(section.cut_away, back);
  if (!section.path.empty())
    return std::make_shared<BodyShape>(std::make_shared<Body>(transformed(prism_behind(section, box), back)));
  std::vector<ShapePtr> beyond;
  for (const SectionPlane& plane : section.planes)
    beyond.push_back(std::make_shared<HalfSpaceShape>(back.point(plane.through),
                                                      -glm::normalize(glm::transpose(to_world.linear) * plane.normal)));
  return beyond.size() == 1 ? beyond.front() : std::make_shared<Csg>(Csg::Operation::intersect, beyond);
}

int leaves(const ShapePtr& shape) {
  const auto* tree = dynamic_cast<const Csg*>(shape.get());
  return tree ? tree->leaf_count() : 1;
}

// Whether nothing, or all, of a box is taken away for certain.
enum class Effect { none, some, all };
Effect effect_on(const Section& section, const Box3& box) {
  if (section.cut_away) {
    const Box3 tool = section.cut_away->bounds();
    const bool apart = glm::any(glm::lessThan(tool.hi, box.lo)) || glm::any(glm::lessThan(box.hi, tool.lo));
    return apart ? Effect::none : Effect::some;
  }
  if (section.planes.empty()) return Effect::some;
  bool all = true;
  for (const SectionPlane& plane : section.planes) {
    double least = kInfinity, most = -kInfinity;
    for (const Vec3& p : corners(box)) {
      const double height = glm::dot(plane.normal, p - plane.through);
      least = std::min(least, height), most = std::max(most, height);
    }
    if (most <= 0) return Effect::none;
    all = all && least >= 0;
  }
  return all ? Effect::all : Effect::some;
}

// The object's solid without what its capped clips take away: rays close their cuts of bodies alone, and what a section
// leaves is none.
ShapePtr with_caps(const ShapePtr& solid, Object& object) {
  const Affine back = object.transform.inverse();
  std::vector<ShapePtr> operands{solid};
  for (const ClipPlane& clip : object.clips)
    if (clip.cap)
      operands.push_back(std::make_shared<HalfSpaceShape>(
          back.point(clip.through), -glm::normalize(glm::transpose(object.transform.linear) * clip.normal)));
  if (operands.size() == 1) return solid;
  std::erase_if(object.clips, [](const ClipPlane& clip) { return clip.cap; });
  return std::make_shared<Csg>(Csg::Operation::subtract, operands);
}

class Cutting {
 public:
  explicit Cutting(const Section& section) : section_(section) {}

  std::vector<Object> of(const std::vector<Object>& objects, const Affine& to_world) {
    std::vector<Object> kept;
    for (Object object : objects)
      if (cut(object, to_world * object.transform)) kept.push_back(std::move(object));
    return kept;
  }
  const SectionEffect& effect() const { return effect_; }

 private:
  // False where nothing is left.
  bool cut(Object& object, const Affine& to_world) {
    if (!object.may_be_cut || object.first_cut_leaf >= 0) return true;
    if (const auto* group = std::get_if<GroupPtr>(&object.shape)) {
      const bool was_empty = (*group)->objects.empty();
      auto left = std::make_shared<const Group>(Group{of((*group)->objects, to_world)});
      object.shape = left;
      return was_empty || !left->objects.empty();
    }
    ShapePtr solid = solid_of(object);
    const Box3 box = solid ? transformed(solid->bounds(), to_world) : Box3();
    const Effect effect = solid && solid->bounds().bounded() ? effect_on(section_, box) : Effect::none;
    if (effect == Effect::none) return ++effect_.untouched, true;
    if (effect == Effect::all) return ++effect_.taken_away, false;
    const ShapePtr tool = tool_of(section_, box, to_world);
    solid = with_caps(solid, object);
    object.first_cut_leaf = leaves(solid);
    object.shape = ShapePtr(std::make_shared<Csg>(Csg::Operation::subtract, std::vector<ShapePtr>{solid, tool}));
    object.representation = Representation::direct;
    renumber_face_materials(object);
    if (!object.cut_faces) object.cut_faces = section_.faces;
    if (object.cut_faces->own_angle)
      object.cut_faces->hatching.angle = kAngles[count_++ % std::size(kAngles)] * kPi / 180;
    ++effect_.cut;
    return true;
  }

  const Section& section_;
  SectionEffect effect_;
  size_t count_ = 0;
};

}  // namespace

FieldType section_hatch() {
  return group({{"angle", angle(), "from the page's horizontal; each object another by default", false, {}},
                {"spacing", page_length().at_least(0.1), "between lines, on the page", false, "1.6 mm"},
                {"crossed", boolean(), "with lines across these", false, "false"},
                {"style", reference({Category::style}), "of the lines", false, "hairline"}})
      .or_word({"none"});
}

std::vector<Field> section_fields(bool titled) {
  std::vector<Field> fields{
      {"planes",
       groups({{"through", point(), "a point of the plane", false, "[0, 0, 0]"},
               {"normal", direction(), "towards what is taken away", true, {}}})
           .count(1, 8),
       "what lies beyond all of them is taken away: one for a full section, two for a half section",
       false,
       {}},
      {"path", points().count(2, 64), "of a stepped section: corners of the line along which it cuts", false, {}},
      {"along", direction(), "of a stepped section: the direction that all of its planes have", false, "z"},
      {"towards", direction(), "of a stepped section: the side that is taken away", false, {}},
      {"cut_away",
       reference({Category::body, Category::shape}),
       "of a broken-out section: the closed solid that is taken away",
       false,
       {}},
      {"hatch", section_hatch(), "of the cut faces of objects that do not say; none: no lines", false, "{}"}};
  if (titled) fields.push_back({"title", label(), "letter of the section: A names the view A–A", false, {}});
  return fields;
}

CutFaces cut_faces_of(const Fields& fields, const char* field) {
  CutFaces faces;
  faces.hatched = fields.word(field).empty();
  if (!faces.hatched) return faces;
  const Fields& given = fields.group(field);
  faces.own_angle = !given.has("angle");
  faces.hatching = {given.has("angle") ? given.number("angle") : kPi / 4, given.number("spacing"),
                    given.boolean("crossed"), false, style_of(given, "style")};
  return faces;
}

Section section_of(const Fields& fields) {
  const int ways = fields.has("planes") + fields.has("path") + fields.has("cut_away");
  if (ways != 1)
    throw FieldError("", "a section has one of 'planes', 'path' and 'cut_away'",
                     "planes: { through: [0, 0, 0], normal: -y } takes away what lies before the plane y = 0");
  Section section;
  if (fields.has("planes"))
    for (const Fields& plane : fields.groups("planes"))
      section.planes.push_back({plane.vec3("through"), plane.vec3("normal")});
  if (fields.has("path")) {
    if (!fields.has("towards")) throw FieldError("path", "a stepped section needs 'towards'", "the side to take away");
    section.path = fields.points("path"), section.along = fields.vec3("along"),
    section.towards = fields.vec3("towards");
    if (glm::length(glm::cross(section.along, section.towards)) < 1e-9)
      throw FieldError("towards", "the side that is taken away lies across 'along'", "towards: -y, along: z");
    check_path(section);
  } else {
    for (const char* field : {"along", "towards"})
      if (fields.given(field)) throw FieldError(field, std::string("'") + field + "' goes with 'path'");
  }
  if (fields.holds<BodyPtr>("cut_away")) {
    if (!fields.body("cut_away")->is_closed())
      throw FieldError("cut_away", "this body is not closed: it has no inside", "a solid, such as an extrusion_body");
    section.cut_away = std::make_shared<BodyShape>(fields.body("cut_away"));
  } else if (fields.has("cut_away")) {
    section.cut_away = fields.get<ShapePtr>("cut_away");
    if (!section.cut_away->is_closed())
      throw FieldError("cut_away", "this shape is not closed: it has no inside", section.cut_away->how_to_close());
  }
  section.faces = cut_faces_of(fields, "hatch");
  if (fields.has("title")) section.title = fields.get<TextTemplate>("title").text();
  return section;
}

SectionEffect cut(std::vector<Object>& objects, const Section& section) {
  Cutting cutting(section);
  objects = cutting.of(objects, Affine());
  return cutting.effect();
}

SectionSteps steps_of(const Object& object) {
  SectionSteps steps;
  const auto* shape = object.first_cut_leaf < 0 ? nullptr : std::get_if<ShapePtr>(&object.shape);
  const auto* left = shape ? dynamic_cast<const Csg*>(shape->get()) : nullptr;
  const auto* tool = left ? dynamic_cast<const BodyShape*>(left->operands().back().get()) : nullptr;
  if (!tool) return steps;
  const Body& body = *tool->body();
  const auto is = [&](int face, const char* role) {
    const Origin& origin = body.faces[static_cast<size_t>(face)].origin;
    return origin.feature == kStepped && origin.role == role;
  };
  for (const Edge& edge : body.edges)
    if (std::all_of(edge.coedges.begin(), edge.coedges.end(),
                    [&](int k) { return is(body.loops[body.coedges[k].loop].face, kCut); }))
      steps.edges.push_back(edge.curve);
  for (int k = 0; k < static_cast<int>(body.faces.size()); ++k)
    if (is(k, kAway)) {
      const Rectangle domain = body.faces[static_cast<size_t>(k)].surface->domain();
      steps.away = body.normal(k, domain.u.middle(), domain.v.middle());
    }
  return steps;
}

bool has_hatched_cuts(const std::vector<Object>& objects) {
  return std::any_of(objects.begin(), objects.end(), [](const Object& object) {
    if (const auto* group = std::get_if<GroupPtr>(&object.shape)) return has_hatched_cuts((*group)->objects);
    return object.first_cut_leaf >= 0 && object.cut_faces && object.cut_faces->hatched;
  });
}

}  // namespace lekalo::render
