// Reads the mail that a part of a node has posted, for tests.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "node/parts/mail.hpp"

namespace graycube::testing {

/// The stamp of rank 0 of a square of four nodes, in job 1.
inline constexpr BatchStamp kFirst{1, 0, 0, 7, 0};
inline constexpr BatchLimits kAnything{.pixel_count = 1 << 16,
                                       .tile_count = 1 << 10,
                                       .max_depth = 5,
                                       .columns = 8,
                                       .rows = 8,
                                       .nodes = 4};

inline Mail mail_of_square() {
  Mail mail(kFirst);
  mail.set_peers({Rank{1}, Rank{2}});
  mail.begin(kFirst);
  return mail;
}

struct SentMail {
  std::vector<Mail::Outgoing> all;

  explicit SentMail(Mail& mail) : all(mail.take()) {}

  std::vector<BatchHeader> headers() const {
    std::vector<BatchHeader> headers;
    for (const Mail::Outgoing& o : all) {
      if (!looks_like_batch(o.message.frame)) continue;
      headers.push_back(std::get<BatchHeader>(peek_header(o.message.frame)));
    }
    return headers;
  }
  std::vector<BatchType> types() const {
    std::vector<BatchType> types;
    for (const BatchHeader& h : headers()) types.push_back(h.type);
    return types;
  }
  /// The number of records in each batch of a type.
  std::vector<std::uint32_t> counts(BatchType type) const {
    std::vector<std::uint32_t> counts;
    for (const BatchHeader& h : headers()) {
      if (h.type == type) counts.push_back(h.count);
    }
    return counts;
  }
  /// The control messages of a type.
  template <typename T>
  std::vector<T> told() const {
    std::vector<T> told;
    for (const Mail::Outgoing& o : all) {
      if (looks_like_batch(o.message.frame)) continue;
      const auto decoded = decode(o.message.text());
      if (const auto* m = std::get_if<T>(&std::get<ControlMessage>(decoded))) told.push_back(*m);
    }
    return told;
  }
};

inline RayTask shadow_ray(std::uint16_t hops = 0) {
  RayTask ray;
  ray.kind = RayKind::kShadow;
  ray.weight = {1, 1, 1};
  ray.ray = {{0, 0, 0}, {1, 0, 0}};
  ray.t_max = 1;
  ray.hops = hops;
  return ray;
}

inline std::vector<RayTask> shadow_rays(std::size_t count, std::uint16_t hops = 0) {
  return std::vector<RayTask>(count, shadow_ray(hops));
}

}  // namespace graycube::testing
