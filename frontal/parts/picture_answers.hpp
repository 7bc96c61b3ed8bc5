// Answers requests for a picture: rows of it, or that its files are written.
#pragma once

#include <cstddef>
#include <functional>

#include "film/film.hpp"
#include "film/picture_files.hpp"
#include "frontal/parts/post.hpp"

namespace graycube {

/// Rows of a picture are sent in messages of about this size: small enough that the memory of one
/// serves the next.
inline constexpr std::size_t kPictureChunkBytes = std::size_t{1} << 20;

/// The rows that are asked for, as far as they fit into a message.
Answer picture_rows(const Picture& picture, const control::Fetch& m);

/// Writes the files that are asked for; `used_s` tells the CPU seconds that were used so far.
Answer write_picture(const Picture& picture, const control::Write& m, const PictureOrigin& origin,
                     const std::function<double()>& used_s);

}  // namespace graycube
