#include "formats/mesh/assimp/read_assimp.hpp"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/mesh/assimp/mark_skipping_files.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "formats/mesh/words.hpp"
#include "mesh/face_limits.hpp"

namespace graycube {
namespace {

using Matrix = aiMatrix4x4t<double>;
using Parts = std::variant<std::vector<MeshPart>, MeshFault>;

/// A node to visit, and the map from its parent to the world.
struct Visit {
  const aiNode* node;
  Matrix to_world;
};

/// Nodes of a file beyond so many: some programs make a node a screw, none makes millions.
constexpr std::size_t kMaxNodes = 1u << 20;

Matrix matrix_of(const aiMatrix4x4& m) {
  return {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,
          m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4};
}

Vec3 moved(const Matrix& m, const aiVector3D& v) {
  const double x = v.x, y = v.y, z = v.z;
  return {m.a1 * x + m.a2 * y + m.a3 * z + m.a4, m.b1 * x + m.b2 * y + m.b3 * z + m.b4,
          m.c1 * x + m.c2 * y + m.c3 * z + m.c4};
}

/// Whether the library hands the format over with y up: as it is defined, or since it turns it so.
bool has_y_up(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 5> kEndings{".gltf", ".glb", ".dae", ".x3d", ".3ds"};
  const std::string ending = path.extension().string();
  return std::ranges::any_of(kEndings, [&](auto e) { return equal_words(ending, e); });
}

/// From a scene whose up is y.
const Matrix kTurned(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);

/// One of an FBX's axes as a row of a map: 0 … 2 is the axis, 1 or −1 its sign.
std::optional<std::array<double, 3>> fbx_axis(const aiMetadata& settings, const std::string& name,
                                              int wanted_sign) {
  std::int32_t axis = -1, sign = 0;
  settings.Get(name, axis);
  settings.Get(name + "Sign", sign);
  if (axis < 0 || axis > 2 || (sign != 1 && sign != -1)) return std::nullopt;
  std::array<double, 3> row{};
  row[static_cast<std::size_t>(axis)] = sign * wanted_sign;
  return row;
}

/// An FBX says which of its axes goes up, which one to the front and which one to the right; where
/// it doesn't, or they aren't three, y is up. Later versions of the library than 5.2 turn the root
/// so that y is.
Matrix from_fbx(const aiScene& scene) {
  if (scene.mMetaData == nullptr || !scene.mRootNode->mTransformation.IsIdentity()) return kTurned;
  const auto x = fbx_axis(*scene.mMetaData, "CoordAxis", 1);
  const auto y = fbx_axis(*scene.mMetaData, "FrontAxis", -1);
  const auto z = fbx_axis(*scene.mMetaData, "UpAxis", 1);
  if (!x || !y || !z) return kTurned;
  const Matrix map((*x)[0], (*x)[1], (*x)[2], 0, (*y)[0], (*y)[1], (*y)[2], 0, (*z)[0], (*z)[1],
                   (*z)[2], 0, 0, 0, 0, 1);
  return map.Determinant() != 0 ? map : kTurned;
}

/// From the scene as the library hands it over to one whose up is z.
Matrix to_z_up(const aiScene& scene, const std::filesystem::path& path) {
  if (equal_words(path.extension().string(), ".fbx")) return from_fbx(scene);
  return has_y_up(path) ? kTurned : Matrix();
}

bool is_linear(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return equal_words(ending, ".gltf") || equal_words(ending, ".glb");
}

double srgb_from_linear(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// The colour of a material, unless it is one that the library made up.
std::optional<std::array<double, 4>> color_of(const aiMaterial& material, bool is_linear) {
  aiString name;
  aiColor4D color;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, color) != AI_SUCCESS) return std::nullopt;
  material.Get(AI_MATKEY_NAME, name);
  const bool is_white = color.r == 1 && color.g == 1 && color.b == 1;
  const std::string_view text(name.C_Str());
  if (text.find(AI_DEFAULT_MATERIAL_NAME) != text.npos || (text.empty() && is_white))
    return std::nullopt;
  std::array<double, 4> rgba{color.r, color.g, color.b, 1};
  float opacity = 1;
  // Programs that confuse opacity with transparency write 0 for what can be seen.
  if (material.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity > 0 && opacity < 1)
    rgba[3] = static_cast<double>(opacity);
  for (std::size_t i = 0; i < 4; ++i) {
    if (!std::isfinite(rgba[i])) return std::nullopt;
    rgba[i] = std::clamp(rgba[i], 0.0, 1.0);
    if (is_linear && i < 3) rgba[i] = std::clamp(srgb_from_linear(rgba[i]), 0.0, 1.0);
  }
  return rgba;
}

/// Collects the meshes of a scene that the library has read.
class Collector {
 public:
  Collector(const aiScene& scene, bool is_linear) : scene_(scene), is_linear_(is_linear) {}

  Parts run(const Matrix& to_world) {
    std::vector<Visit> waiting{{scene_.mRootNode, to_world}};
    for (std::size_t nodes = 0; !waiting.empty(); ++nodes) {
      const Visit visit = waiting.back();
      waiting.pop_back();
      if (nodes == kMaxNodes) return MeshFault{"more than " + std::to_string(kMaxNodes) + " nodes"};
      if (visit.node == nullptr) continue;
      const Matrix here = visit.to_world * matrix_of(visit.node->mTransformation);
      for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) {
        if (auto fault = add(visit.node->mMeshes[i], *visit.node, here)) return *std::move(fault);
      }
      // The last is visited first, so that parts come in the file's order.
      for (unsigned i = visit.node->mNumChildren; i-- > 0;)
        waiting.push_back({visit.node->mChildren[i], here});
    }
    return std::move(parts_);
  }

 private:
  std::optional<MeshFault> add(unsigned index, const aiNode& node, const Matrix& to_world) {
    if (index >= scene_.mNumMeshes) return MeshFault{"a node names a mesh that isn't there"};
    const aiMesh& mesh = *scene_.mMeshes[index];
    if (auto fault = fault_of_counts(mesh)) return fault;
    MeshPart part;
    const char* name = node.mName.length > 0 ? node.mName.C_Str() : mesh.mName.C_Str();
    part.name = mesh_name(name);
    if (mesh.mMaterialIndex < scene_.mNumMaterials)
      part.color = color_of(*scene_.mMaterials[mesh.mMaterialIndex], is_linear_);
    part.polygons.digits = kSinglePrecisionDigits;
    part.polygons.points.reserve(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      part.polygons.points.push_back(moved(to_world, mesh.mVertices[v]));
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) continue;
      part.polygons.add_face({face.mIndices, face.mNumIndices});
    }
    if (!part.polygons.face_ends.empty()) parts_.push_back(std::move(part));
    return std::nullopt;
  }

  /// Counts what a mesh adds to the others against the limits, before memory is taken for it.
  std::optional<MeshFault> fault_of_counts(const aiMesh& mesh) {
    if (parts_.size() == kMaxMeshParts)
      return MeshFault{"more than " + std::to_string(kMaxMeshParts) + " meshes"};
    points_ += mesh.mNumVertices;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const unsigned corners = mesh.mFaces[f].mNumIndices;
      if (corners > kMostFaceCorners)
        return MeshFault{"a face of " + std::to_string(corners) + " corners, at most " +
                         std::to_string(kMostFaceCorners) + " are accepted"};
      if (corners >= 3) triangles_ += corners - 2;
    }
    if (points_ > kMaxMeshPoints || triangles_ > kMaxMeshTriangles) {
      return MeshFault{"at most " + std::to_string(kMaxMeshTriangles) + " triangles and points " +
                       "are accepted, found " + std::to_string(std::max(points_, triangles_))};
    }
    return std::nullopt;
  }

  const aiScene& scene_;
  bool is_linear_;
  std::vector<MeshPart> parts_;
  std::uint64_t points_ = 0, triangles_ = 0;
};

/// The library's message without its own prefix.
std::string message_of(const Assimp::Importer& importer) {
  const std::string why = importer.GetErrorString();
  return why.empty() ? "assimp can't read it" : "assimp: " + why;
}

}  // namespace

Parts read_by_assimp(const std::filesystem::path& path) try {
  Assimp::Importer importer;
  importer.SetIOHandler(new MarkSkippingFiles(kMaxMeshFileBytes));  // the importer deletes it
  // Places and faces are all that counts: the rest is dropped at once.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                  aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_RemoveComponent);
  if (scene == nullptr || scene->mRootNode == nullptr) return MeshFault{message_of(importer)};
  return Collector(*scene, is_linear(path)).run(to_z_up(*scene, path));
} catch (const std::exception& e) {
  return MeshFault{std::string("assimp: ") + e.what()};
}

}  // namespace graycube
