// Decides which submitted scenes the frontal accepts as jobs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "frontal/parts/job_queue.hpp"
#include "frontal/parts/post.hpp"
#include "proto/messages.hpp"

namespace graycube {

/// Why a scene is not accepted; nothing if it is. `is_private`: the client may be trusted with
/// scenes that it has compiled.
std::optional<Refusal> refusal_of(const control::Submit& m, std::span<const std::byte> scene,
                                  bool is_private);

/// Why no job can be added to the queue, whatever it is; nothing if one can.
std::optional<Refusal> refusal_for_want_of_room(const JobQueue& queue);

/// Why nothing is accepted any more.
Refusal farm_goes_down();

/// A digest of all that a client asks for: what is the same has the same picture.
std::uint64_t content_of(const control::Submit& m, std::span<const std::byte> scene);

}  // namespace graycube
