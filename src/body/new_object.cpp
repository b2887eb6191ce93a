// SPDX-License-Identifier: Apache-2.0
#include "body/new_object.h"

#include <array>
#include <system_error>
#include <utility>

#include "base/file.h"
#include "body/mesh_import.h"
#include "body/mesh_text.h"
#include "body/object_file.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

/// The three files of an object, in the order in which they are written: the object file last, so
/// that there is none without its mesh.
struct OutputFiles {
  fs::path materials, mesh, object;
};

OutputFiles outputFiles(const NewObjectRequest& request) {
  const auto named = [&](const std::string& ending) {
    return request.output.parent_path() / (request.output.stem().string() + ending);
  };
  std::error_code code;
  const bool readsItsOutput = fs::equivalent(request.mesh, named(".obj"), code) && !code;
  const std::string infix = readsItsOutput ? "-mesh" : "";
  return {named(infix + ".mtl"), named(infix + ".obj"), request.output};
}

Result<void> checkFree(const OutputFiles& files) {
  std::error_code code;
  for (const fs::path& path : {files.object, files.mesh, files.materials}) {
    if (fs::exists(path, code)) {
      return badInput("exists already", path.string(), "choose another name, or use --force");
    }
  }
  return {};
}

Result<void> writeAll(const OutputFiles& files, const Mesh& mesh, const std::string& objectText) {
  const std::array<std::pair<fs::path, std::string>, 3> contents = {
      {{files.materials, mtlText(mesh)},
       {files.mesh, objText(mesh, files.materials.filename().string())},
       {files.object, objectText}}};
  for (std::size_t i = 0; i < contents.size(); ++i) {
    if (auto written = writeFileAtomically(contents[i].first, contents[i].second); !written) {
      std::error_code code;
      for (std::size_t k = 0; k < i; ++k) fs::remove(contents[k].first, code);
      return written;
    }
  }
  return {};
}

ObjectDefinition definitionFor(const NewObjectRequest& request, const OutputFiles& files) {
  ObjectDefinition definition;
  definition.name = request.output.stem().string();
  definition.title = definition.name;
  definition.path = files.object.string();
  definition.meshPath = files.mesh.string();
  definition.meshFile = files.mesh.filename().string();
  definition.kind = request.kind;
  definition.mass = request.mass;
  definition.density = request.mass > 0 ? 0 : request.density;
  definition.surfaces["desk"] = request.surface;
  definition.defaultSurface = "desk";
  definition.notes = "Made from " + request.mesh.filename().string() + ".";
  return definition;
}

}  // namespace

Result<Body> makeObjectFile(const NewObjectRequest& request) {
  const double scale = metresPerUnit(request.units);
  if (scale == 0) return badInput("unknown units \"" + request.units + "\"", "--units");
  if (request.output.extension() != ".json") {
    return badInput("must end in .json", request.output.string());
  }
  const OutputFiles files = outputFiles(request);
  if (!request.replace) {
    if (const auto good = checkFree(files); !good) return tl::unexpected(good.error());
  }
  auto mesh = importMesh(request.mesh, scale);
  if (!mesh) return tl::unexpected(mesh.error());
  const ObjectDefinition definition = definitionFor(request, files);
  const std::string text = objectFileText(definition);
  // What the reader would refuse is never written.
  if (const auto good = parseObjectFile(text, files.object); !good) {
    return tl::unexpected(good.error());
  }
  ObjectDefinition named = definition;
  named.meshPath = request.mesh.string();  // what an error is about
  auto body = makeBodyFromMesh(std::move(named), *mesh);
  if (!body) return body;
  body->definition.meshPath = definition.meshPath;
  if (const auto good = writeAll(files, *mesh, text); !good) return tl::unexpected(good.error());
  return body;
}

}  // namespace ifa
