// What a section left of an object, by what the object was: which faces are which, and their materials.
#pragma once

#include "render/model/model.h"

namespace lekalo::render {

// The shape of an object as it was before a section cut it; its shape where none did.
Entity before_section(const Object& object);

// The face of that shape of which a hit's face is a part; -1: the section itself made it.
int face_before_section(const Object& object, int face);

// Takes materials by the faces of the body that was cut as those of what is left.
void renumber_face_materials(Object& object);

// Cuts this body, in place of the solid of which it is the boundary.
void put_before_section(Object& object, const geometry::BodyPtr& body);

}  // namespace lekalo::render
