#include "frontal/parts/keeping.hpp"

#include <exception>
#include <utility>

namespace graycube {

KeepingResult keep_picture(KeepingWork work) {
  KeepingResult result;
  result.job = work.job.job;
  try {
    result.picture = work.film->develop();
    work.film.reset();
    work.store->write_picture(work.job, result.picture);
  } catch (const std::exception& e) {
    result.error = e.what();
  }
  return result;
}

ReadingResult read_picture(const ReadingWork& work) {
  try {
    return {work.job, work.store->read_picture(work.job)};
  } catch (const std::exception&) {
    return {work.job, std::nullopt};  // there is no memory for it
  }
}

}  // namespace graycube
