// The scene types whose points come from code outside the program.
#include <fmt/format.h>

#include "geometry/external/external_curve.h"
#include "geometry/external/external_surface.h"
#include "render/external/library.h"
#include "render/external/process.h"

namespace lekalo::render {

using namespace geometry;

namespace {

void declare_source(TypeDeclaration& type, const std::string& signature, const std::string& request) {
  type.runs_foreign_code = true;
  type.optional("library", file(),
                "shared library with the function; include/lekalo/external.h has its declaration: " + signature)
      .optional("function", text(), "name of the function in the library")
      .field("parameters", numbers(), "numbers that the function gets with each call", "[]")
      .field("threads", choice({"serialized", "safe"}),
             "serialized: one call of the library at a time; safe: its functions may be called by several threads",
             "serialized")
      .optional("command", command(),
                "in place of a library: a program that reads a line '" + request +
                    "' and answers with a line of numbers, the point and its derivatives up to the order")
      .field("timeout", number().positive().at_most(86400),
             "seconds that a call of the function, or an answer of the program, may take", "10");
}

void declare_fit(TypeDeclaration& type, int highest) {
  type.field("order", integer().between(0, highest),
             "highest derivatives that the function knows; higher ones are those of the fitted spline", "2")
      .field("tolerance", number().between(1e-13, 0.1),
             "largest sampled distance of the fitted spline, which rays meet, from the function, as part of the size",
             "1e-9");
}

// The function, and the field in which it is given.
struct Source {
  std::shared_ptr<const ExternalFunction> function;
  const char* field;
};

Source read_source(const Fields& f, int parameter_count) {
  if (f.has("command") == f.has("library"))
    throw FieldError(
        f.has("command") ? "command" : "",
        f.has("command") ? "'library' and 'command' exclude each other" : "where the points come from is missing",
        "write library: FILE.so, function: NAME, or command: [PROGRAM, ARGUMENT, ...]");
  if (f.has("command")) {
    for (const char* field : {"function", "parameters", "threads"})
      if (f.given(field))
        throw FieldError(field, fmt::format("'{}' belongs to a library", field), "a program takes arguments");
    const auto& command = f.get<std::vector<std::string>>("command");
    return {start_evaluator(command, parameter_count, f.number("timeout")), "command"};
  }
  if (!f.has("function")) throw FieldError("library", "which function of the library?", "write function: NAME");
  return {load_function(f.text("library"), f.text("function"), parameter_count, f.numbers("parameters"),
                        f.text("threads") == "safe", f.number("timeout")),
          "function"};
}

// make(source), with what the function says reported where it is given.
template <class Make>
auto asked(const Source& source, Make make) -> decltype(make()) {
  try {
    return make();
  } catch (const ExternalError& error) {
    throw FieldError(source.field, error.what());
  }
}

TypeDeclaration external_curve_type() {
  TypeDeclaration type =
      declare(Category::curve, "external_curve",
              "Curve that a function of a shared library, or a program, evaluates: to see and check another geometry "
              "kernel. Runs that code: needs --allow-external.");
  type.example("library: file.so, function: helix, parameters: [1, 0.2], domain: [0, 4*pi]");
  declare_source(type, "int NAME(const double* parameters, double t, int order, double* out)", "t order");
  type.field("domain", range(), "of t").field("closed", boolean(), "the ends meet, and the parameter wraps", "false");
  declare_fit(type, kMaxCurveOrder);
  return type.built_by([](const Fields& f) {
    const Source source = read_source(f, 1);
    return asked(source, [&] {
      return ExternalCurve(source.function, f.range("domain"), f.boolean("closed"), f.integer("order"),
                           f.number("tolerance"));
    });
  });
}

TypeDeclaration external_surface_type() {
  TypeDeclaration type =
      declare(Category::surface, "external_surface",
              "Surface that a function of a shared library, or a program, evaluates: to see and check another geometry "
              "kernel. Runs that code: needs --allow-external.");
  type.example("library: file.so, function: wave, parameters: [0.2, 3], domain: { u: [-1, 1], v: [-1, 1] }");
  declare_source(type, "int NAME(const double* parameters, double u, double v, int order, double* out)", "u v order");
  type.field("domain", rectangle(), "of u and v")
      .field("closed", boolean().for_each_direction(), "the opposite edges are one, and the parameter wraps", "false");
  declare_fit(type, kMaxSurfaceOrder);
  return type.built_by([](const Fields& f) {
    const Source source = read_source(f, 2);
    return asked(source, [&] {
      return ExternalSurface(source.function, f.rectangle("domain"), {f.u<bool>("closed"), f.v<bool>("closed")},
                             f.integer("order"), f.number("tolerance"));
    });
  });
}

}  // namespace

std::vector<TypeDeclaration> external_types() { return {external_curve_type(), external_surface_type()}; }

}  // namespace lekalo::render
