// Rules that must hold for any bytes: decoders neither crash nor believe nonsense, and what they
// accept survives a round trip. Driven by libFuzzer (proto_*_fuzz.cpp) and by seeded mutations in
// the normal suite. Each function returns whether the bytes were accepted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "check.hpp"
#include "proto/batch.hpp"
#include "proto/control.hpp"
#include "proto/model_slice.hpp"

namespace graycube {

/// Decodes a signal, which is only a header.
inline BatchResult signal_of(std::span<const std::byte> bytes) {
  const BatchResult peeked = peek_header(bytes);
  const auto* h = std::get_if<BatchHeader>(&peeked);
  const bool is_other =
      h != nullptr && (h->type < BatchType::kGreeting || h->type > BatchType::kGoodbyeAck);
  return is_other ? BatchResult(BatchError::kBadType) : peeked;
}

inline bool fuzz_batch(std::span<const std::byte> bytes) {
  const BatchLimits limits{
      .pixel_count = 4096, .tile_count = 64, .max_depth = 9, .columns = 4, .rows = 2, .nodes = 8};
  std::vector<RayTask> rays, class_rays;
  std::vector<std::uint16_t> classes;
  std::vector<TileCredit> credits;
  std::vector<Contribution> contributions;
  std::vector<std::uint32_t> tiles;
  std::vector<RayAnswer> answers;
  std::uint64_t granted = 0, work = 0;
  Token token;
  SlicePart part;
  const BatchResult results[] = {decode_rays(bytes, limits, rays),
                                 decode_contributions(bytes, limits, credits, contributions),
                                 decode_link_credit(bytes, limits, granted),
                                 decode_token(bytes, limits, token),
                                 decode_assignment(bytes, limits, tiles),
                                 signal_of(bytes),
                                 decode_offer(bytes, limits, work),
                                 decode_rays(bytes, limits, class_rays, BatchType::kClassRays),
                                 decode_class_credit(bytes, limits, classes),
                                 decode_answers(bytes, limits, answers),
                                 decode_slice_part(bytes, limits, part)};
  const BatchHeader* header = nullptr;
  for (const BatchResult& result : results) {
    const auto* accepted = std::get_if<BatchHeader>(&result);
    if (accepted == nullptr) continue;
    GRAYCUBE_CHECK(header == nullptr, "taken for a batch of two types");
    header = accepted;
  }
  if (header == nullptr) return false;
  std::vector<std::byte> again;
  switch (header->type) {
    case BatchType::kRays: again = encode_rays(header->stamp, rays); break;
    case BatchType::kClassRays:
      again = encode_rays(header->stamp, class_rays, BatchType::kClassRays);
      break;
    case BatchType::kClassCredit: again = encode_class_credit(header->stamp, classes); break;
    case BatchType::kAnswers: again = encode_answers(header->stamp, answers); break;
    case BatchType::kContributions:
      again = encode_contributions(header->stamp, credits, contributions);
      break;
    case BatchType::kLinkCredit: again = encode_link_credit(header->stamp, granted); break;
    case BatchType::kIdle:
    case BatchType::kIdleWithCopy: again = encode_offer(header->stamp, header->type, work); break;
    case BatchType::kToken: again = encode_token(header->stamp, token); break;
    case BatchType::kAssignment: again = encode_assignment(header->stamp, tiles); break;
    case BatchType::kSlicePart: again = encode_slice_part(header->stamp, part); break;
    default: again = encode_signal(header->stamp, header->type); break;
  }
  // Batches have one form only, so even the bytes must come back.
  GRAYCUBE_CHECK(std::ranges::equal(again, bytes), "an accepted batch changed on its round trip");
  return true;
}

inline bool fuzz_control(std::string_view text) {
  const ControlResult first = decode(text);
  const auto* message = std::get_if<ControlMessage>(&first);
  if (message == nullptr) {
    GRAYCUBE_CHECK(!std::get<ControlError>(first).why.empty(), "refused without a reason");
    return false;
  }
  const ControlResult second = decode(encode(*message));
  GRAYCUBE_CHECK(second == first, "an accepted message changed on its round trip");
  return true;
}

/// Leaves below `first`, found by walking as an evaluator would.
inline std::size_t count_leaves(const Model& model, std::size_t first) {
  const TreeNode& node = model.nodes[first];
  if (node.kind == TreeNode::Kind::kLeaf || node.kind == TreeNode::Kind::kInvertedLeaf) {
    GRAYCUBE_CHECK(node.primitive < model.primitives.size(), "primitive %u", node.primitive);
    return 1;
  }
  std::size_t leaves = 0, next = first + 1;
  for (; next < first + node.size; next += model.nodes[next].size)
    leaves += count_leaves(model, next);
  GRAYCUBE_CHECK(next == first + node.size, "children end at %zu", next);
  return leaves;
}

inline bool fuzz_model(std::span<const std::byte> bytes) {
  const auto first = decode_model(bytes);
  const auto* model = std::get_if<Model>(&first);
  if (model == nullptr) {
    const auto& error = std::get<ModelError>(first);
    GRAYCUBE_CHECK(!error.where.empty() && !error.why.empty(), "refused without a reason");
    return false;
  }
  for (const Object& object : model->objects) {
    const std::size_t leaves = count_leaves(*model, object.first_node);
    GRAYCUBE_CHECK(leaves >= 1 && leaves <= object.node_count, "%zu leaves", leaves);
  }
  for (const Primitive& p : model->primitives) {
    GRAYCUBE_CHECK(p.material < model->materials.size() &&
                       std::size_t{p.first_plane} + p.plane_count <= model->planes.size(),
                   "a primitive of material %u, planes %u + %u", p.material, p.first_plane,
                   p.plane_count);
  }
  const std::vector<std::byte> again = encode_model(*model);
  GRAYCUBE_CHECK(again.size() <= bytes.size(), "grew from %zu to %zu bytes", bytes.size(),
                 again.size());
  const auto second = decode_model(again);
  GRAYCUBE_CHECK(std::holds_alternative<Model>(second) && std::get<Model>(second) == *model,
                 "an accepted model changed on its round trip");
  return true;
}

}  // namespace graycube
