// SPDX-License-Identifier: Apache-2.0
#include "body/mesh_bytes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace ifa {
namespace {

constexpr char kMesh = 'M', kError = 'E';

template <class T>
void put(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Their count, then the values as they lie in memory.
template <class T>
void putAll(std::string& bytes, const T* values, std::size_t count) {
  put(bytes, static_cast<std::uint64_t>(count));
  if (count > 0) bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

void putText(std::string& bytes, const std::string& text) {
  putAll(bytes, text.data(), text.size());
}

/// Takes values one after the other; all are nothing once the bytes have ended.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T take() {
    T value{};
    good_ = good_ && rest_.size() >= sizeof value;
    if (!good_) return value;
    std::memcpy(static_cast<void*>(&value), rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }
  template <class Container>
  void takeAll(Container& values) {
    using T = typename Container::value_type;
    const auto count = take<std::uint64_t>();
    good_ = good_ && count <= rest_.size() / sizeof(T);
    if (!good_ || count == 0) return;
    values.resize(static_cast<std::size_t>(count));
    std::memcpy(static_cast<void*>(values.data()), rest_.data(), values.size() * sizeof(T));
    rest_.remove_prefix(values.size() * sizeof(T));
  }
  /// All was there, and nothing more.
  [[nodiscard]] bool isDone() const { return good_ && rest_.empty(); }
  [[nodiscard]] bool good() const { return good_; }

 private:
  std::string_view rest_;
  bool good_ = true;
};

bool isWhole(const Mesh& mesh) {
  const auto inside = [](int index, std::size_t count) {
    return index >= 0 && static_cast<std::size_t>(index) < count;
  };
  const bool vertices = std::all_of(
      mesh.triangles.begin(), mesh.triangles.end(), [&](const std::array<int, 3>& triangle) {
        return std::all_of(triangle.begin(), triangle.end(),
                           [&](int index) { return inside(index, mesh.vertices.size()); });
      });
  return vertices && mesh.triangleMaterial.size() == mesh.triangles.size() &&
         std::all_of(mesh.triangleMaterial.begin(), mesh.triangleMaterial.end(),
                     [&](int index) { return inside(index, mesh.materials.size()); });
}

}  // namespace

std::string meshBytes(const Result<Mesh>& mesh) {
  std::string bytes(1, mesh ? kMesh : kError);
  if (!mesh) {
    put(bytes, static_cast<int>(mesh.error().code));
    for (const std::string& text :
         {mesh.error().message, mesh.error().place, mesh.error().remedy}) {
      putText(bytes, text);
    }
    return bytes;
  }
  putAll(bytes, mesh->vertices.data(), mesh->vertices.size());
  putAll(bytes, mesh->triangles.data(), mesh->triangles.size());
  putAll(bytes, mesh->triangleMaterial.data(), mesh->triangleMaterial.size());
  for (const MeshMaterial& material : mesh->materials) {
    putText(bytes, material.name);
    put(bytes, material.colour);
    put(bytes, material.roughness);
    put(bytes, material.metallic);
  }
  return bytes;
}

Result<Mesh> meshFromBytes(std::string_view bytes) {
  Taker taker(bytes);
  const char kind = taker.take<char>();
  if (kind == kError) {
    Error error;
    error.code = static_cast<ErrorCode>(taker.take<int>());
    for (std::string* text : {&error.message, &error.place, &error.remedy}) taker.takeAll(*text);
    if (taker.isDone()) return tl::unexpected<Error>(error);
  }
  Mesh mesh;
  taker.takeAll(mesh.vertices);
  taker.takeAll(mesh.triangles);
  taker.takeAll(mesh.triangleMaterial);
  while (kind == kMesh && taker.good() && !taker.isDone()) {
    MeshMaterial& material = mesh.materials.emplace_back();
    taker.takeAll(material.name);
    material.colour = taker.take<std::array<double, 4>>();
    material.roughness = taker.take<double>();
    material.metallic = taker.take<double>();
  }
  if (kind == kMesh && taker.isDone() && isWhole(mesh)) return mesh;
  return badInput("is not a mesh that can be read");
}

}  // namespace ifa
