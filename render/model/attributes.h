// Attributes of the elements of a model: physical data that a thing carries as a whole and that its faces and edges may
// have otherwise (Golovanov 2016, 8.1). They change no shape.
#pragma once

#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/bodies/topology/selection.h"
#include "render/material.h"

namespace lekalo::render {

// A usual quantity, in SI units.
struct UsualAttribute {
  std::string name;
  std::string unit;         // as messages write it; empty: a plain number
  std::string description;  // of the declaration
  double least = -geometry::kInfinity, most = geometry::kInfinity;
};
const std::vector<UsualAttribute>& usual_attributes();
// Empty for others.
std::string unit_of_attribute(const std::string& name);
// "temperature, °C": with its unit.
std::string title_of_attribute(const std::string& name);

// What attributes are said of: a whole thing, by the address of what it is made of, or a face or edge of its boundary
// by number.
struct ElementId {
  enum class Kind { whole, face, edge };
  const void* thing = nullptr;
  Kind kind = Kind::whole;
  int index = -1;
  auto operator<=>(const ElementId&) const = default;
};

struct NamedElement {
  ElementId id;
  std::string name;        // as a scene writes it: part, part.top
  geometry::BodyPtr body;  // of faces and edges
};

// What is said of one element.
struct ElementAttributes {
  std::string name;
  std::map<std::string, double> numbers;
  MaterialPtr material;       // null: nothing is said
  std::string material_name;  // empty for one that has none
};

// A value with the element of which it is said.
struct Attribute {
  double value = 0;
  std::string of;
};

class AttributeTable {
 public:
  // What is said of the element from now on; later values are put in place of earlier ones.
  void add(const NamedElement& element, const ElementAttributes& said);
  // What is said of a thing and its faces and edges is said of another one too, which has the same: its boundary.
  void copy(const void* from, const void* to);
  bool speaks_of(const void* thing) const;

  // What is said of the element itself; null: nothing.
  const ElementAttributes* own(const ElementId& id) const;
  // Its own attributes and those that it inherits: a face from its body; an edge from its faces where both have the
  // same value, else from the body, which only edges are asked for.
  std::map<std::string, Attribute> of(const ElementId& id, const geometry::Body* body = nullptr) const;
  std::optional<Attribute> of(const ElementId& id, const std::string& name, const geometry::Body* body = nullptr) const;

  const std::map<ElementId, ElementAttributes>& elements() const { return elements_; }
  // Every name of a number that some element has, in order.
  std::vector<std::string> names() const;

 private:
  std::map<ElementId, ElementAttributes> elements_;
};

// Metres of a scene unit; 1 where the scene says none, nothing for a text that is no unit of length.
std::optional<double> metres_of(const std::string& unit);

}  // namespace lekalo::render
