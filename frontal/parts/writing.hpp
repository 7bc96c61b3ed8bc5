// A picture's files that are to be written: slow work, which is done beside the mailroom.
#pragma once

#include "film/film.hpp"
#include "film/picture_files.hpp"
#include "frontal/parts/post.hpp"

namespace graycube {

struct WritingWork {
  /// Who asked.
  PeerId peer;
  control::Write request;
  /// Stays as it is until the work's result has been given.
  const Picture* picture = nullptr;
  PictureOrigin origin;
};

struct WritingResult {
  PeerId peer;
  Answer answer;
};

}  // namespace graycube
