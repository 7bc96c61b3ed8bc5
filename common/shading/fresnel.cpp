#include "shading/fresnel.hpp"

#include <algorithm>
#include <cmath>

namespace graycube {
namespace {

double square(double v) { return v * v; }

}  // namespace

double fresnel(double cosine, double n, double k) {
  if (n == 1 && k == 0) return 0;
  const double c = std::clamp(cosine, 0.0, 1.0);
  const double sine2 = 1 - c * c;
  // a + ib = √((n + ik)² − sin²), the index times the cosine beyond the surface.
  const double real = n * n - k * k - sine2;
  const double size = std::sqrt(real * real + 4 * n * n * k * k);
  const double a = std::sqrt(0.5 * larger(0, size + real));
  const double b2 = 0.5 * larger(0, size - real);
  // Grazing light, and an index next to 1 that leaves no difference to compute with.
  if (!(square(a + c) + b2 > 0)) return 1;
  const double across = (square(a - c) + b2) / (square(a + c) + b2);
  const double along =
      across * (square(a * c - sine2) + b2 * c * c) / (square(a * c + sine2) + b2 * c * c);
  return std::clamp(0.5 * (across + along), 0.0, 1.0);
}

Rgb fresnel(const Material& m, double cosine, bool is_within) {
  const auto of = [&](double n, double k) {
    return fresnel(cosine, is_within && k == 0 ? 1 / n : n, k);
  };
  const Rgb &n = m.optics.index, &k = m.optics.absorption;
  const double red = of(n.r, k.r);
  if (n == Rgb{n.r, n.r, n.r} && k == Rgb{k.r, k.r, k.r}) return {red, red, red};
  return {red, of(n.g, k.g), of(n.b, k.b)};
}

}  // namespace graycube
