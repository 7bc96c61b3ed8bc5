// A BRL-CAD model of our own against normals worked out in closed form, in rt's kind of picture:
// from the text of the database to the comparison that bench/against_rt.sh makes with rt's own
// pictures.
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "catch.hpp"
#include "film/picture_files.hpp"
#include "formats/brlcad/brlcad.hpp"
#include "scene/compile_scene.hpp"
#include "trace/render_serial.hpp"

using namespace graycube;
namespace fs = std::filesystem;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kSide = 128;
constexpr double kViewSize = 60;
constexpr double kRadius = 20;

/// A ball with the octant x, y, z > 0 cut out of it, and a brick of half-sides 4 about (0, 0, −22).
constexpr const char* kModel =
    "title {A ball and a brick}\nunits mm\n"
    "put ball ell V {0 0 0} A {20 0 0} B {0 20 0} C {0 0 20}\n"
    "put cut arb8 V1 {0 0 0} V2 {30 0 0} V3 {30 30 0} V4 {0 30 0} V5 {0 0 30} V6 {30 0 30} V7 {30 "
    "30 30} V8 {0 30 30}\n"
    "put brick arb8 V1 {-4 -4 -4} V2 {4 -4 -4} V3 {4 4 -4} V4 {-4 4 -4} V5 {-4 -4 4} V6 {4 -4 4} "
    "V7 {4 4 4} V8 {-4 4 4}\n"
    "put a.r comb region yes id 1 tree {- {l ball} {l cut}}\n"
    "put b.r comb region yes id 2 tree {l brick {1 0 0 0  0 1 0 0  0 0 1 -22  0 0 0 1}}\n"
    "put all comb region no tree {u {l a.r} {l b.r}}\n";
/// Azimuth 35, elevation 25, as rows of the picture's axes.
constexpr const char* kView =
    "viewsize 60;\neye_pt 60 40 35;\n"
    "viewrot -0.5735764363510461 0.8191520442889918 0 0\n"
    " -0.3461886090155389 -0.2424039172006126 0.9063077870366499 0\n"
    " 0.7424038800820001 0.5198368001980001 0.4226182617406994 0\n 0 0 0 1 ;\n";

struct Hit {
  double t = kInf;
  Vec3 normal;
};

/// The parameters at which a line enters and leaves a box, with the axis of each face.
struct BoxLine {
  double enter = -kInf, leave = kInf;
  int enter_axis = 0, leave_axis = 0;
};
BoxLine through_box(const Vec3& lo, const Vec3& hi, const Vec3& o, const Vec3& d) {
  BoxLine b;
  for (int a = 0; a < 3; ++a) {
    const double t0 = (lo[a] - o[a]) / d[a], t1 = (hi[a] - o[a]) / d[a];
    if (std::fmin(t0, t1) > b.enter) b.enter = std::fmin(t0, t1), b.enter_axis = a;
    if (std::fmax(t0, t1) < b.leave) b.leave = std::fmax(t0, t1), b.leave_axis = a;
  }
  return b;
}
Vec3 axis_vector(int axis, double sign) {
  Vec3 n;
  n[axis] = sign;
  return n;
}

Hit meet_ball(const Vec3& o, const Vec3& d) {
  const double b = dot(o, d), h2 = b * b - dot(o, o) + kRadius * kRadius;
  if (h2 < 0) return {};
  const double enter = -b - std::sqrt(h2), leave = -b + std::sqrt(h2);
  const BoxLine cut = through_box({0, 0, 0}, {30, 30, 30}, o, d);
  if (!(cut.enter < cut.leave && cut.enter <= enter && cut.leave > enter)) {
    return {enter, (1 / kRadius) * (o + enter * d)};
  }
  if (cut.leave >= leave) return {};
  // In the wall of the cut: the direction out of the ball is into the cut.
  return {cut.leave, axis_vector(cut.leave_axis, d[cut.leave_axis] > 0 ? -1 : 1)};
}
Hit meet_brick(const Vec3& o, const Vec3& d) {
  const BoxLine b = through_box({-4, -4, -26}, {4, 4, -18}, o, d);
  if (!(b.enter < b.leave)) return {};
  return {b.enter, axis_vector(b.enter_axis, d[b.enter_axis] > 0 ? -1 : 1)};
}

/// A picture as rt makes it; `offset` is the place in each cell through which rays go.
Picture reference(double offset) {
  const Vec3 right{-0.5735764363510461, 0.8191520442889918, 0};
  const Vec3 up{-0.3461886090155389, -0.2424039172006126, 0.9063077870366499};
  const Vec3 back{0.7424038800820001, 0.5198368001980001, 0.4226182617406994};
  Picture p;
  p.width = p.height = kSide;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const double u = ((x + offset) / kSide - 0.5) * kViewSize;
      const double v = ((kSide - 1 - y + offset) / kSide - 0.5) * kViewSize;
      const Vec3 o = Vec3{60, 40, 35} + u * right + v * up;
      const Hit ball = meet_ball(o, -back), brick = meet_brick(o, -back);
      const Hit& hit = ball.t <= brick.t ? ball : brick;
      for (int a = 0; a < 3; ++a) {
        p.rgb.push_back(hit.t < kInf ? static_cast<float>(0.5 - 0.5 * hit.normal[a]) : 0.0f);
      }
    }
  }
  return p;
}

int status_of(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE(
    "a BRL-CAD model's normals are those of rt's picture, by rays through the cells' lower-left "
    "corners") {
  BrlcadOptions options;
  options.image = {kSide, kSide, 1};
  options.view = kView;
  BrlcadResult read = read_brlcad(kModel, options);
  REQUIRE(read.scene);
  read.scene->settings.aovs.add(Aov::kNormal);
  const Domain domain(compile_scene(*read.scene));
  Film film(kSide, kSide, 1, domain.settings().aovs);
  render_serial(domain, {}, film);
  const fs::path folder =
      fs::temp_directory_path() / ("graycube-normals-" + std::to_string(::getpid()));
  fs::create_directory(folder);
  write_exr(folder / "ours.exr", film.develop(), {});
  write_png(folder / "theirs.linear.png", reference(0));
  write_png(folder / "shifted.linear.png", reference(0.5));
  const std::string command =
      std::string(COMPARE_NORMALS) + " " + (folder / "ours.exr").string() + " ";
  CHECK(status_of(command + (folder / "theirs.linear.png").string() + " 0.05 0.02 > /dev/null") ==
        0);
  CHECK(status_of(command + (folder / "shifted.linear.png").string() + " > /dev/null") == 1);
  fs::remove_all(folder);
}
