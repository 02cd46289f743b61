// Objects of scene files: what is shown, and how.
#pragma once

#include <any>
#include <string>
#include <vector>

#include "geometry/describe.h"
#include "render/model/model.h"

namespace lekalo::render {

// An object as declared; a family as its shape makes one for each member. Objects without a material of their own have
// none yet: neutral() gives them the scene's neutral one, or that of the object that shows their group.
using Objects = std::vector<Object>;

// The entity that a reference to geometry holds.
Entity entity_of(const std::any& thing);

// What objects show, for finding an object or a declaration by its shape: the same for the same shape only. Null for
// points, which are values.
const void* identity(const Entity& entity);

// The kinds of `lines` that things like this can have, though this one may have none.
std::vector<std::string> line_kinds_of(const Entity& entity);

// Throws FieldError (field shape) for what is too large to be shown.
void check_size(const Object& object);

// A solid that is put together becomes its boundary where caps close its cuts; those of bodies alone are closed.
void put_boundary_for_caps(Object& object);

}  // namespace lekalo::render
