// Faces, edges and vertices of a body by their names, by what they lie between, and by where they are.
//
// A name is that of the entity's origin, as blank.side.2. Shorter ones stand for families: blank.side for all of its
// sides, hole.side for the sides of hole.0, hole.1, ..., side for those of every operand. An entity without a name, or
// with one that several have, is edge.3, the fourth of the body's edges. Seams and poles are not among the edges.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

enum class Element { face, edge, vertex };

// What is asked for; all that is said must hold.
struct Selector {
  std::vector<std::string> names;              // called by one of these
  std::vector<std::string> between;            // edges: two names of faces, one on each side
  std::vector<std::string> of_face;            // edges and vertices: on the border of a face called by one of these
  std::optional<Vec3> parallel;                // straight edges along this direction, plane faces across it
  std::optional<std::vector<BodyPtr>> new_to;  // edges and vertices that none of these bodies has
  std::vector<Selector> all, none;             // all of these hold, none of these
  std::optional<Vec3> extreme;                 // of those that are left, the farthest this way, as a whole
};

// Whether an entity of the full name is meant by a shorter one: names that differ by counters and by what follows.
bool stands_for(std::string_view asked, std::string_view name);

// As a scene may write it: its own name, or edge.3 where it has none.
std::string name_of(const Body& body, Element element, int index);
std::vector<std::string> names_of(const Body& body, Element element);

// The numbers of the entities called so, ascending; none for a name that nothing has.
std::vector<int> called(const Body& body, Element element, std::string_view name);

// Of several names; throws FieldError with the field for a name that nothing has. one_called: of one name, and exactly
// one entity.
std::vector<int> all_called(const Body& body, Element element, const std::vector<std::string>& names,
                            const std::string& field);
int one_called(const Body& body, Element element, const std::string& name, const std::string& field);

// Likewise of those that a selector means. Throws FieldError with the field of the selector for a name that nothing
// has, or what does not go with the kind of element.
std::vector<int> select(const Body& body, Element element, const Selector& selector);

// The edge's faces, one or two numbers, ascending.
std::vector<int> faces_beside(const Body& body, int edge);

// "edge.3 (end, side.2)": with the faces beside an edge.
std::string described(const Body& body, Element element, int index);

// The body with the name of the thing that it was given as put before those of its entities that have no feature.
Body with_feature(const Body& body, const std::string& feature);

}  // namespace lekalo::geometry
