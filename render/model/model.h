// A scene as it is meant: named geometry in double precision, materials, objects, lights, camera. Immutable once built;
// made from a scene file by scene/build, or by a C++ program directly.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "geometry/body.h"
#include "geometry/curve.h"
#include "geometry/mesh.h"
#include "geometry/shape.h"
#include "geometry/surface.h"
#include "render/camera.h"
#include "render/image/display.h"
#include "render/integrator.h"
#include "render/light.h"
#include "render/material.h"
#include "render/model/page.h"
#include "render/samplers/sampler.h"

namespace lekalo::render {

struct Group;
using GroupPtr = std::shared_ptr<const Group>;

// Anything that can be named in `geometry` or shown by an object. A set of patches is a vector of surfaces.
using SurfaceSet = std::vector<geometry::SurfacePtr>;
using Entity = std::variant<Vec3, geometry::CurvePtr, geometry::SurfacePtr, SurfaceSet, geometry::BodyPtr,
                            geometry::MeshPtr, geometry::ShapePtr, GroupPtr>;

enum class Representation { direct, mesh };

// Keeps what lies on the side of the plane against its normal: dot(p - through, normal) <= 0.
struct ClipPlane {
  Vec3 through{0};
  Vec3 normal{0, 0, 1};
  bool cap = false;  // close the cut of a body with a plane face of the same material
};

struct Object {
  std::string name;
  Entity shape;
  std::optional<Entity> as_written;  // the shape that the scene names, where its boundary took its place
  geometry::Affine transform;
  MaterialPtr material;       // front, where the normal looks at the viewer
  MaterialPtr back_material;  // null: the same
  Representation representation = Representation::direct;
  double sag = 0;  // of the mesh in scene units; 0: sag_pixels
  double sag_pixels = 0.25;
  double mesh_angle = 0;      // largest turn of the normal, of curves of the tangent; 0: 10 degrees, of curves any
  bool flat_shading = false;  // mesh facets show their own normals
  uint32_t visible_to = kVisibleToAll;
  std::vector<ClipPlane> clips;       // where it is placed: in the world, or in its group
  std::shared_ptr<const Look> look;   // in drawings; null: the drawing's lines, no helpers
  std::string legend;                 // its entry in the legend of a drawing; empty: none
  bool may_be_cut = true;             // by sections of drawings
  std::optional<CutFaces> cut_faces;  // none: as the section says
  int first_cut_leaf = -1;            // of a solid that a section cut: leaves from here on are what is taken away
};

// Objects placed together as one; a group may hold groups. Instances share the compiled group.
struct Group {
  std::vector<Object> objects;
};

struct Film {
  static constexpr int kMaxSide = 65536;  // pixels
  static constexpr double kMaxPixels = 1e8;
  int width = 960;
  int height = 720;
  int samples = 16;
  std::string filter = "box";  // box, gaussian, mitchell
  double filter_radius = 0;    // pixels; 0: the filter's own
  uint32_t seed = 0;
  double noise = 0;                 // target of adaptive sampling, see film/render.h; 0: as `contrast` says
  double contrast = 0;              // adaptive sampling, see film/render.h; 0: all pixels take all samples
  bool half_color = false;          // R G B A are written as half (11 bits) in place of float
  std::vector<std::string> layers;  // to keep, of film_layers() (film/render.h); empty: the usual ones
  struct Crop {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels, half open; x1 == 0: the full picture
  } crop;
};

struct OutputFile {
  std::string path;
  std::string kind;          // render, drawing
  DisplayTransform display;  // of a picture in png
  std::string panel;         // of a drawing: only this panel; empty: the page
  double width = 0;          // of a drawing in millimetres; 0: the page's
};

// One view of several on a page.
// What a scene leaves out and was chosen for it.
struct DefaultTaken {
  enum class Of { objects, lights, view } of;
  std::string text;
};

struct Section;

struct Panel {
  std::string name;
  CameraPtr camera;  // for a picture of the whole page's size
  std::function<CameraPtr(int width, int height)> make_camera;
  bool camera_frames = false;  // as Model::camera_frames
  bool own_camera = false;     // none: the scene's
  DrawingChoices drawing;
  std::optional<std::vector<Object>> objects;  // none: those of the scene
  std::shared_ptr<const Section> section;      // that was applied to them; null: none
};

struct Model {
  std::map<std::string, Entity> geometry;
  std::map<std::string, MaterialPtr> materials;
  std::vector<Object> objects;
  std::vector<LightPtr> lights;
  Spectrum background{1.0f, 1.0f, 1.0f};
  CameraPtr camera;
  // The same view for a picture of another size; set where the camera frames the scene or keeps an aspect ratio.
  std::function<CameraPtr(int width, int height)> make_camera;
  bool camera_frames = false;  // it stands where the scene fills the picture, not at a place of its own
  Film film;
  IntegratorPtr integrator;
  std::vector<OutputFile> outputs;
  std::map<std::string, Style> styles;  // built-in and the scene's own
  DrawingChoices drawing;
  std::vector<Panel> panels;
  Layout layout;
  Paper paper;
  std::string title;
  std::string unit;
  std::map<std::string, double> parameters;  // as evaluated
  std::string source;                        // file name as given, for metadata
};

// The groups of the model's lights in the order of their first light; LightParts has room for one less than its most.
std::vector<std::string> light_groups(const Model& model);

// Box of everything that the objects show; unbounded shapes are left out.
geometry::Box3 bounds(const Model& model);
geometry::Box3 bounds(const std::vector<Object>& objects);
geometry::Box3 bounds(const Entity& entity);

// The same of many things in a row: what several of them have in common is looked at once.
class Boxes {
 public:
  geometry::Box3 of(const Entity& entity);
  geometry::Box3 of(const std::vector<Object>& objects);

 private:
  std::unordered_map<const void*, geometry::Box3> known_;
};

}  // namespace lekalo::render
