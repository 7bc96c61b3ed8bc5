// Decides which submitted scenes the frontal accepts as jobs.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "frontal/parts/post.hpp"
#include "proto/messages.hpp"

namespace graycube {

/// Why a scene is not accepted; nothing if it is. `is_private`: the client may be trusted with
/// scenes that it has compiled.
std::optional<Refusal> refusal_of(const control::Submit& m, std::span<const std::byte> scene,
                                  bool is_private);

}  // namespace graycube
