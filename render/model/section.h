// Sections of drawings: part of a solid is taken away so that its inside is seen, and the faces of the cut are hatched,
// those alone (ISO 128-3). A full section has one plane, a half section two, a stepped one a path of planes, a
// broken-out one a solid that is taken away.
#pragma once

#include <string>
#include <vector>

#include "render/model/model.h"

namespace lekalo::render {

struct Section {
  // One of these says what is taken away: what lies beyond all of the planes; what lies beyond a line of straight
  // pieces as it is moved along `along`, on the side of `towards`; a solid.
  std::vector<SectionPlane> planes;
  std::vector<Vec3> path;
  Vec3 along{0, 0, 1}, towards{0};
  geometry::ShapePtr cut_away;
  CutFaces faces;
  std::string title;  // A: the view is called A-A
};

// Those of panels have a title too.
std::vector<geometry::Field> section_fields(bool titled);
// The field that says how cut faces look, wherever one is declared.
geometry::FieldType section_hatch();
// Both throw FieldError.
Section section_of(const geometry::Fields& fields);
CutFaces cut_faces_of(const geometry::Fields& fields, const char* field);

// What a section did to objects, those in groups counted one by one. Objects that have a section of their own, or want
// none, are not counted.
struct SectionEffect {
  int cut = 0, taken_away = 0, untouched = 0;
};

// The objects with what the section takes away of solids cut off. Curves, points and open surfaces stay; objects that
// have a section of their own, or want none, as well. Of what is taken away whole nothing is left in the list.
SectionEffect cut(std::vector<Object>& objects, const Section& section);

// Of what a stepped section left: the edges in which its planes meet, in coordinates of the object's shape, and the
// side that was taken away. Drawings that look at it from this side are without these edges (ISO 128-3). Empty of
// others.
struct SectionSteps {
  std::vector<geometry::CurvePtr> edges;
  Vec3 away{0};
};
SectionSteps steps_of(const Object& object);

// Whether drawings hatch cut faces of some of the objects.
bool has_hatched_cuts(const std::vector<Object>& objects);

}  // namespace lekalo::render
