#include "frontal/admission/long_scene.hpp"

#include <exception>

#include "frontal/admission/submission.hpp"

namespace graycube {

AdmissionResult admit_scene(const AdmissionWork& work) {
  AdmissionResult result;
  try {
    result.content = content_of(work.request, work.scene);
    if (work.job != 0) work.store->write_scene(work.job, work.scene);
  } catch (const std::exception& e) {
    result.error = e.what();
  }
  return result;
}

}  // namespace graycube
