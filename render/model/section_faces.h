// What a section left of an object, by what the object was: which faces are which, and their materials.
#pragma once

#include "render/model/model.h"

namespace lekalo::render {

// The shape of an object as it was before a section cut it; its shape where none did.
Entity before_section(const Object& object);

// The face of that shape of which a hit's face is a part; -1: the section itself made it.
int face_before_section(const Object& object, int face);

// The shape that the scene names: before a section, and before its boundary took its place.
Entity shape_as_written(const Object& object);

// Takes materials by the faces of the body that was cut as those of what is left.
void renumber_face_materials(Object& object);

// Shows this body, which is the boundary of the object's solid, in place of that; what a section takes away is cut from
// it.
void put_before_section(Object& object, const geometry::BodyPtr& body);

}  // namespace lekalo::render
