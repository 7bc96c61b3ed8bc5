// A model, or the slice of it that one macro-region needs, as bytes, which the frontal sends a node
// behind `load`. FORMAT.md, "Model slices", is normative. Every field of Model crosses with all its
// bits; zeros and identities, as in most primitives, take no room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "csg/model.hpp"
#include "regions/restrict.hpp"

namespace graycube {

/// "GCM1", read as a little-endian integer.
inline constexpr std::uint32_t kModelMagic = 0x314D4347;
inline constexpr std::uint16_t kModelVersion = 8;

inline constexpr std::size_t kMaxModelBytes = std::size_t{1} << 30;
inline constexpr std::uint32_t kMaxModelMaterials = 1u << 20;
inline constexpr std::uint32_t kMaxModelPrimitives = 1u << 24;
inline constexpr std::uint32_t kMaxModelPlanes = 1u << 25;
/// Points of all meshes together; no more than 3 a triangle are used.
inline constexpr std::uint32_t kMaxModelPoints = 3 * kMaxMeshTriangles;
inline constexpr std::uint32_t kMaxModelMeshes = 1u << 20;
/// Their number crosses in 16 bits.
inline constexpr std::uint32_t kMaxModelOutlines = 65535;
/// Segments of all outlines together.
inline constexpr std::uint32_t kMaxModelSegments = 1u << 20;
inline constexpr std::uint32_t kMaxModelNodes = 1u << 26;
inline constexpr std::uint32_t kMaxModelObjects = 1u << 24;
/// Most nodes on the way from an object's root to a leaf: whoever walks the tree may recurse.
inline constexpr std::uint32_t kMaxModelTreeDepth = 512;

/// Why bytes are not a model: which part ("primitive 17"), and what is wrong with it.
struct ModelError {
  std::string where;
  std::string why;
};

/// The size of the bytes that encode_model returns.
std::size_t encoded_model_bytes(const Model& model);

/// The bytes that an object adds to that size.
std::size_t encoded_object_bytes(const Model& model, const Object& object);

/// Whether encode_model may be called: no count, nor the size, nor the depth of a tree is beyond
/// its limit.
bool fits_model_limits(const Model& model);

/// The model must keep to its own rules (those that decode_model checks) and fit the limits; a
/// broken one is a bug that the receiver reports.
std::vector<std::byte> encode_model(const Model& model);

/// Encodes slices of one model, which must outlive the encoder.
class SliceEncoder {
 public:
  explicit SliceEncoder(const Model& model);
  /// encode_model(extract(model, contents)), without the copy between, and the tails behind it.
  std::vector<std::byte> encode(const ModelContents& contents,
                                std::span<const std::span<const std::byte>> tails) const;

 private:
  struct Kept;

  const Model& model_;
  /// For each primitive of the model, the flags of the parts that are written, its mesh aside.
  std::vector<std::uint16_t> flags_;
};

/// Whether bytes begin as encode_model's do; no text of a scene does.
bool is_encoded_model(std::span<const std::byte> bytes);

/// Takes no more memory than the counts that the bytes can hold, and checks every index: nodes of a
/// decoded model nest properly, and every material, plane, point, mesh, outline and primitive
/// that they name exists.
[[nodiscard]] std::variant<Model, ModelError> decode_model(std::span<const std::byte> bytes);
/// Like decode_model, but more bytes may follow: `bytes` becomes those.
[[nodiscard]] std::variant<Model, ModelError> take_model(std::span<const std::byte>& bytes);

}  // namespace graycube
