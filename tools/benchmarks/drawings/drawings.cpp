// Lines of drawings with hidden ones told apart, for tools/bench drawings: beside OCCT's exact algorithm
// (HLRBRep_Algo), and for more and more bodies. One thread, processor time; one JSON object a line.
#include <BRepBuilderAPI_MakeFace.hxx>
#include <HLRAlgo_Projector.hxx>
#include <HLRBRep_Algo.hxx>
#include <HLRBRep_HLRToShape.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>

#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>

#include "geometry/surfaces/splines/bezier_surface.h"
#include "occt/occt_shapes.h"
#include "render/drawing/visibility/hidden_lines.h"
#include "render/scene/build/load.h"
#include "timed.h"

namespace lekalo::benchmarks {

namespace {

using namespace render;

struct Drawn {
  double seconds = 1e300, of_crossings = 1e300;  // of crossings and visibility alone
  LineStatistics statistics;
};

// The scene as loaded; all that a drawing asks for before anything is put on paper.
Drawn drawn(const LoadedScene& scene, int runs) {
  Drawn result;
  for (int k = 0; k < runs; ++k) {
    const double begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
    const World world(scene.model, false);
    const VisibleLines lines = visible_lines(world, drawing_work(world));
    result.seconds = std::min(result.seconds, seconds(CLOCK_PROCESS_CPUTIME_ID) - begin);
    result.statistics = lines.statistics;
    result.of_crossings =
        std::min(result.of_crossings, lines.statistics.seconds_of_crossings + lines.statistics.seconds_of_rays);
  }
  return result;
}

int edges_of(const TopoDS_Shape& shape) {
  int count = 0;
  if (!shape.IsNull())
    for (TopExp_Explorer edge(shape, TopAbs_EDGE); edge.More(); edge.Next()) ++count;
  return count;
}

struct OcctDrawn {
  double seconds = 1e300;
  int edges = 0;  // pieces that are seen
};

std::optional<OcctDrawn> occt_drawn(const TopoDS_Shape& shape, int lines, const Vec3& way, int runs) {
  OcctDrawn result;
  for (int k = 0; k < runs; ++k) try {
      const double begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
      const Handle(HLRBRep_Algo) algorithm = new HLRBRep_Algo();
      algorithm->Add(shape, lines);
      algorithm->Projector(HLRAlgo_Projector(gp_Ax2({0, 0, 0}, geometry::occt_direction(-way))));
      algorithm->Update();
      algorithm->Hide();
      HLRBRep_HLRToShape seen(algorithm);
      result.edges = edges_of(seen.VCompound()) + edges_of(seen.Rg1LineVCompound()) +
                     edges_of(seen.RgNLineVCompound()) + edges_of(seen.OutLineVCompound()) +
                     edges_of(seen.IsoLineVCompound());
      result.seconds = std::min(result.seconds, seconds(CLOCK_PROCESS_CPUTIME_ID) - begin);
    } catch (const Standard_Failure&) {
      return std::nullopt;
    }
  return result;
}

void print_row(const std::string& name, const Drawn& ours, const std::optional<OcctDrawn>& theirs) {
  const LineStatistics& s = ours.statistics;
  fmt::print(
      "{{\"name\": \"{}\", \"seconds\": {:.4f}, \"lines\": {}, \"pieces\": {}, \"crossings\": {}, \"rays\": {}, "
      "\"of_crossings\": {:.4f}, \"occt_seconds\": {}, \"occt_pieces\": {}}}\n",
      name, ours.seconds, s.lines, s.pieces, s.crossings, s.rays, ours.of_crossings,
      theirs ? fmt::format("{:.4f}", theirs->seconds) : "null", theirs ? theirs->edges : 0);
}

void teapot(const std::filesystem::path& scenes, int runs) {
  const LoadedScene scene = load_scene(scenes / "teapot_lines.yaml");
  TopoDS_Compound faces;
  const TopoDS_Builder builder;
  builder.MakeCompound(faces);
  for (const geometry::SurfacePtr& surface : std::get<SurfaceSet>(scene.model->objects.front().shape)) {
    const auto form = surface->as_nurbs();
    geometry::Grid<Vec3> net{form->count_u(), form->count_v(), {}};
    for (const geometry::Vec4& p : form->points) net.values.push_back(Vec3(p) / p.w);
    builder.Add(faces, BRepBuilderAPI_MakeFace(geometry::occt_spline(geometry::bezier_surface(net)), 1e-7).Face());
  }
  const Drawn ours = drawn(scene, runs);
  print_row("teapot", ours, occt_drawn(faces, 8, scene.model->camera->view_direction(), 1));
}

void rods(const std::filesystem::path& scenes, int runs) {
  print_row("300 rods", drawn(load_scene(scenes / "crossing_rods.yaml"), runs), std::nullopt);
}

void bodies(const std::filesystem::path& scenes, int runs) {
  for (const auto& [columns, rows] : {std::pair(5, 5), std::pair(25, 10)}) {
    LoadOptions options;
    options.set_parameters = {{"columns", std::to_string(columns)}, {"rows", std::to_string(rows)}};
    print_row(fmt::format("{} bodies", 4 * columns * rows),
              drawn(load_scene(scenes / "bodies_on_a_grid.yaml", options), runs), std::nullopt);
  }
}

}  // namespace

}  // namespace lekalo::benchmarks

int main(int argc, char** argv) {
  const int runs = argc == 3 ? std::atoi(argv[2]) : 0;
  if (runs <= 0) {
    fmt::print(stderr, "usage: drawings_benchmark SCENES RUNS\n");
    return 2;
  }
  lekalo::benchmarks::teapot(argv[1], runs);
  lekalo::benchmarks::rods(argv[1], runs);
  lekalo::benchmarks::bodies(argv[1], runs);
  return 0;
}
