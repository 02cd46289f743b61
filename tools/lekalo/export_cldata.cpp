// Paths of cutters as cutter location data: the words of APT (ISO 3592, ISO 4343) as text.
//
//   CUTTER/d,r,e,f,a,b,h   d twice the radius at which the flank would meet the end, r the corner radius, its centre e
//                          from the axis and f above the end, a = 0, b the angle of the flank, h the length
//   GOTO/x,y,z,i,j,k       the middle of the end, and the axis
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "command.h"
#include "export.h"
#include "geometry/machining/tool_path.h"
#include "geometry/tessellation/tessellate.h"
#include "measure.h"
#include "picture.h"
#include "render/image/atomic_file.h"

namespace lekalo::command {

namespace {

using geometry::CutterPose;
using geometry::ToolMove;
using geometry::ToolPath;
using geometry::Vec3;

// Of the size of the path, where no tolerance is given.
constexpr double kSagOfSize = 1e-3;

// -0 and what rounding leaves of 0 is 0.
double plain(double x, double size) { return std::abs(x) < 1e-12 * size ? 0 : x; }

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

class Writer {
 public:
  std::string text;

  void head(const std::string& title, const std::string& unit) {
    if (!title.empty()) line("PARTNO/{}", title);
    if (unit == "mm" || unit == "in")
      line("UNITS/{}", unit == "mm" ? "MM" : "INCHES");
    else
      line("$$ LENGTHS IN {}", unit.empty() ? "UNITS OF THE SCENE" : upper(unit));
    line("MULTAX/ON");
  }

  void path(const std::string& name, const ToolPath& path, double sag) {
    const geometry::Box3 box = geometry::bounds(path);
    size_ = box.diameter();
    if (!(sag > 0)) sag = kSagOfSize * size_;
    line("$$ PATH {}: CHORDS WITHIN {:.6g}", name, sag);
    cutter(path.cutter());
    bool first = true;
    for (const ToolMove& move : path.moves()) {
      const auto at = geometry::polygon_parameters(*move.curve, {sag, geometry::kPi, {}});
      for (size_t i = first ? 0 : 1; i < at.size(); ++i) {
        feed(path, move, first);
        go(move.pose(at[i]));
        first = false;
      }
    }
  }

  int places() const { return places_; }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> words, Args&&... args) {
    text += fmt::format(words, std::forward<Args>(args)...) + "\n";
  }

  void cutter(const geometry::Cutter& c) {
    const double rho = c.rounding();
    if (c.corner_radius < 0) line("$$ THE END IS HOLLOW, RADIUS {:.10g}", -c.corner_radius);
    line("CUTTER/{:.10g},{:.10g},{:.10g},{:.10g},0,{:.10g},{:.10g}", 2 * c.flank_radius(), rho, c.ring_radius(), rho,
         c.angle * 180 / geometry::kPi, c.length);
    feed_ = 0;
  }

  // RAPID holds for one place. The cutter comes to the first one in the air.
  void feed(const ToolPath& path, const ToolMove& move, bool is_first) {
    using Kind = ToolMove::Kind;
    if (is_first || move.kind == Kind::rapid || move.kind == Kind::exit) return line("RAPID");
    const auto feed = path.feed_of(move);
    if (!feed || *feed == feed_) return;
    feed_ = *feed;
    line("FEDRAT/{:.10g}", feed_);
  }

  void go(const CutterPose& pose) {
    const Vec3 &p = pose.reference, &q = pose.axis;
    line("GOTO/{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g}", plain(p.x, size_), plain(p.y, size_),
         plain(p.z, size_), plain(q.x, 1), plain(q.y, 1), plain(q.z, 1));
    ++places_;
  }

  double size_ = 1, feed_ = 0;
  int places_ = 0;
};

}  // namespace

int export_cldata(const ExportOptions& options, const std::string& output) {
  const render::LoadedScene scene = options.scene.load();
  check_inputs_stay(scene, {output});
  std::vector<std::pair<std::string, const ToolPath*>> paths;
  const auto add = [&](const std::string& name, const geometry::CurvePtr* curve) {
    const auto* path = curve ? dynamic_cast<const ToolPath*>(curve->get()) : nullptr;
    if (path) paths.emplace_back(name, path);
    return path != nullptr;
  };
  for (const std::string& name : options.names)
    if (!add(name, std::get_if<geometry::CurvePtr>(&find_geometry(scene, name))))
      throw UsageError(fmt::format("'{}' is no path of a cutter, or one that was moved", name));
  if (options.names.empty())
    for (const render::Object& object : scene.model->objects)
      if (object.transform.is_identity()) add(object.name, std::get_if<geometry::CurvePtr>(&object.shape));
  if (paths.empty()) throw UsageError("there is nothing to export: no path of a cutter is shown");
  Writer writer;
  writer.head(scene.model->title, scene.model->unit);
  for (const auto& [name, path] : paths) writer.path(name, *path, options.sag);
  writer.text += "FINI\n";
  render::write_file_atomically(output, writer.text);
  if (!options.quiet) fmt::print(stderr, "{}: {} places of the cutter\n", output, writer.places());
  return kDone;
}

}  // namespace lekalo::command
