// SPDX-License-Identifier: Apache-2.0
// `ifa objects`: the library of objects, one object, or a user's own mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "body/mesh_import.h"
#include "body/mesh_report.h"
#include "body/new_object.h"
#include "body/object_file.h"
#include "body/simple_hull.h"
#include "body/symmetry.h"
#include "command.h"

namespace ifa::cli {

namespace {

namespace fs = std::filesystem;

struct ObjectsOptions {
  std::string what;  ///< object, object file or mesh; empty: the library
  std::string units, output;
  double mass = 0, density = 0;
  double restitution = 0.6, friction = 0.4;
  bool shell = false, replace = false;
  std::string making;  ///< an option that is given and makes sense with an output only
};

Eigen::Vector3d extentOf(const Mesh& mesh) { return inspectMesh(mesh).extent; }

std::string sizeText(const Eigen::Vector3d& extent) {
  const bool large = extent.maxCoeff() >= 1;
  const Eigen::Vector3d shown = large ? extent : Eigen::Vector3d(1e3 * extent);
  return fmt::format("{:.4g} x {:.4g} x {:.4g} {}", shown.x(), shown.y(), shown.z(),
                     large ? "m" : "mm");
}

template <class Map>
std::string namesOf(const Map& map) {
  std::string text;
  for (const auto& entry : map) text += (text.empty() ? "" : ", ") + entry.first;
  return text;
}

std::string surfaceText(const SurfaceProperties& surface) {
  std::string text =
      fmt::format("restitution {:.3g}, friction {:.3g}, rolling {:.2g} mm, spinning {:.2g} mm",
                  surface.restitution, surface.friction, 1e3 * surface.rollingFriction,
                  1e3 * surface.spinningFriction);
  if (surface.referenceImpulse > 0) {
    text += fmt::format(", reference impulse {:.3g} N s", surface.referenceImpulse);
  }
  return text;
}

std::string counted(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// The parts of a long line that belong to its label stand in one column.
std::string row(const std::string& label, const std::string& text) {
  return fmt::format("  {:<16}{}\n", label, text);
}

std::string hullText(std::size_t vertices, std::size_t exactVertices, double deviation) {
  std::string text = fmt::format("{} vertices", vertices);
  if (exactVertices <= vertices) return text;
  return text + fmt::format(", simplified from {}: at most {:.2g} mm inside the mesh",
                            exactVertices, 1e3 * deviation);
}

std::string symmetryText(const SymmetryGroup& group) {
  if (group.order() == 1) return "none (C1)";
  return fmt::format("{}: order {}, {}{}", group.name(), group.order(),
                     counted(group.rotations(), "rotation"),
                     group.nearlyOfRevolution() ? "; nearly of revolution" : "");
}

std::string bodyText(const Body& body) {
  const ObjectDefinition& d = body.definition;
  const char* kind =
      d.parts.empty() ? (d.kind == BodyKind::kShell ? "thin shell" : "solid") : "composite";
  std::string text = fmt::format("{}: {}\n", d.name, d.title);
  if (!d.path.empty()) text += row("file", d.path);
  text += row("size", sizeText(extentOf(body.mesh)));
  text += row("mass", fmt::format("{:.4g} g, {}{}{}", 1e3 * body.mass, kind,
                                  d.material.empty() ? "" : ", ", d.material));
  const Eigen::Vector3d moments = 1e9 * body.principalMoments;
  text += row("inertia", fmt::format("{:.4g}, {:.4g}, {:.4g} g mm^2 (principal)", moments[0],
                                     moments[1], moments[2]));
  const Eigen::Vector3d centre = 1e3 * body.centreOfMass;
  text += row("centre of mass", fmt::format("{:.3f}, {:.3f}, {:.3f} mm in the mesh's frame",
                                            centre.x(), centre.y(), centre.z()));
  text += row("mesh", counted(body.mesh.triangles.size(), "triangle") + ", " +
                          counted(body.mesh.materials.size(), "material"));
  text +=
      row("convex hull", hullText(body.hull.size(), body.exactHullVertices, body.hullDeviation));
  text += row("symmetry", symmetryText(findSymmetry(body)));
  for (const auto& [name, surface] : d.surfaces) {
    text +=
        row((name == d.defaultSurface ? "on " + name + " *" : "on " + name), surfaceText(surface));
  }
  if (!d.faces.empty()) text += row("faces", namesOf(d.faces));
  if (!d.notes.empty()) text += row("notes", d.notes);
  text.pop_back();
  return text;
}

int listLibrary(CommandContext& context) {
  const auto names = listObjects();
  if (!names) return context.fail(names.error());
  std::string text =
      fmt::format("{:<18}{:>30}{:>10}{:>7}  {}\n", "object", "size", "mass, g", "hull", "surfaces");
  for (const std::string& name : *names) {
    const auto body = loadObject(name);
    if (!body) {
      context.console.warn(body.error().text());
      continue;
    }
    text += fmt::format("{:<18}{:>30}{:>10.4g}{:>7}  {}\n", name, sizeText(extentOf(body->mesh)),
                        1e3 * body->mass, body->hull.size(), namesOf(body->definition.surfaces));
  }
  context.console.result(text + "\nin " + objectsFolder().string());
  return context.succeed();
}

int showObject(const ObjectsOptions& options, CommandContext& context) {
  const auto body = loadObject(options.what);
  if (!body) return context.fail(body.error());
  context.console.result(bodyText(*body));
  return context.succeed();
}

std::string reportText(const fs::path& path, const std::string& units, const MeshReport& report,
                       const std::optional<SimpleHull>& hull) {
  std::string text = fmt::format("{} (in {})\n", path.string(), units);
  text += row("size", sizeText(report.extent));
  text += row("mesh", fmt::format("{}, {} vertices", counted(report.triangles, "triangle"),
                                  report.vertices));
  text += row("surface", fmt::format("{:.4g} cm^2", 1e4 * report.area));
  if (report.solid())
    text += row("volume", fmt::format("{:.4g} cm^3", 1e6 * std::abs(report.volume)));
  if (hull) {
    text += row("convex hull", hullText(hull->corners.size(), hull->exactCorners, hull->deviation));
  }
  for (const MeshProblem& problem : report.problems) {
    const char* kind = problem.severity == ProblemSeverity::kNote ? "note" : "problem";
    text += row(kind, fmt::format("{} ({})", problem.message, problem.remedy));
  }
  text += row("good for", report.solid()    ? "a solid or a thin shell"
                          : report.usable() ? "a thin shell only"
                                            : "nothing");
  text.pop_back();
  return text;
}

int inspect(const ObjectsOptions& options, CommandContext& context) {
  const std::string units = options.units.empty() ? "m" : options.units;
  const auto mesh = importMesh(options.what, metresPerUnit(units));
  if (!mesh) return context.fail(mesh.error());
  const MeshReport report = inspectMesh(*mesh);
  if (!report.usable()) {
    context.console.result(reportText(options.what, units, report, {}));
    const MeshProblem& worst = report.problems.front();
    return context.fail({ErrorCode::kBadInput, worst.message, options.what, worst.remedy});
  }
  auto hull = hullForPhysics(mesh->vertices);
  if (!hull) {
    hull.error().place = options.what;
    return context.fail(hull.error());
  }
  context.console.result(reportText(options.what, units, report, *hull));
  return context.succeed();
}

int make(const ObjectsOptions& options, CommandContext& context) {
  if (options.units.empty()) {
    return context.fail(
        {ErrorCode::kUsage, "the mesh's units are not stated", "--units", "one of m, cm, mm, in"});
  }
  if ((options.mass > 0) == (options.density > 0)) {
    return context.fail({ErrorCode::kUsage, "state either a mass or a density", "--mass, --density",
                         "for example --density 1200 (kg/m^3; with --shell kg/m^2)"});
  }
  NewObjectRequest request;
  request.mesh = options.what;
  request.units = options.units;
  request.output = options.output;
  request.kind = options.shell ? BodyKind::kShell : BodyKind::kSolid;
  request.mass = options.mass;
  request.density = options.density;
  request.surface = {options.restitution, options.friction, 0.0002, 0.0002, 0};
  request.replace = options.replace;
  const auto body = makeObjectFile(request);
  if (!body) return context.fail(body.error());
  for (const MeshProblem& problem : inspectMesh(body->mesh).problems) {
    context.console.warn(problem.message + " (" + problem.remedy + ")");
  }
  context.console.result(bodyText(*body));
  return context.succeed(options.output);
}

bool isObject(const std::string& what) {
  std::error_code code;
  const fs::path path(what);
  if (path.extension() == ".json") return true;
  return path.extension().empty() && !fs::is_regular_file(path, code);
}

int runObjects(const ObjectsOptions& options, CommandContext& context) {
  if (options.output.empty() && !options.making.empty()) {
    return context.fail({ErrorCode::kUsage, "is for making an object, and no object file is named",
                         options.making, "add -o NAME.json"});
  }
  if (options.what.empty()) {
    if (options.output.empty()) return listLibrary(context);
    return context.fail({ErrorCode::kUsage, "no mesh was named", "-o", "ifa objects MESH -o FILE"});
  }
  if (!options.output.empty()) return make(options, context);
  return isObject(options.what) ? showObject(options, context) : inspect(options, context);
}

}  // namespace

void addObjectsCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<ObjectsOptions>();
  CLI::App* command =
      app.add_subcommand("objects", "list the library, show an object, inspect or take in a mesh");
  command->add_option("object", options->what, "name, object file or mesh file");
  command->add_option("--units", options->units, "units of the mesh file: m, cm, mm or in")
      ->check(CLI::IsMember({"m", "cm", "mm", "in"}));
  const std::vector<CLI::Option*> forMaking = {
      command->add_option("--density", options->density, "kg/m^3, or kg/m^2 with --shell")
          ->check(numberFrom(1e-3, 3e4)),
      command->add_option("--mass", options->mass, "kg")->check(numberFrom(1e-6, 1e3)),
      command->add_flag("--shell", options->shell, "a thin shell instead of a solid"),
      command->add_option("--restitution", options->restitution, "of the new object (0.6)")
          ->check(numberFrom(0, 0.95)),
      command->add_option("--friction", options->friction, "of the new object (0.4)")
          ->check(numberFrom(0, 2)),
      command->add_flag("--force", options->replace, "overwrite files that exist")};
  command->add_option("-o,--output", options->output, "object file to make of the mesh");
  command->callback([options, forMaking, &context] {
    for (const CLI::Option* option : forMaking) {
      if (option->count() > 0) options->making = option->get_name();
    }
    context.action = [options, &context] { return runObjects(*options, context); };
  });
}

}  // namespace ifa::cli
