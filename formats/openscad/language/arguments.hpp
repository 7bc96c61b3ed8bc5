// The arguments of one module, as numbers, truth values, vectors and lists.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "flat/polygon.hpp"
#include "formats/openscad/language/parser.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// Reads one module's arguments. What is wrong with them is reported at once: an argument of a
/// wrong type counts as not given, as in OpenSCAD 2021.01, with a warning that --strict makes an
/// error; where nothing takes its place the part is left out, and `ok` is false from then on.
class ScadArguments {
 public:
  ScadArguments(const ScadModule& module, OpenscadReport& report)
      : module_(module), report_(report) {}

  bool ok() const { return ok_; }

  std::optional<double> number(const char* name, int position) {
    const ScadValue* value = module_.argument(name, position);
    if (value == nullptr) return std::nullopt;
    if (const double* n = value->number()) return *n;
    pass_over(name, "must be a number");
    return std::nullopt;
  }
  double number(const char* name, int position, double otherwise) {
    return number(name, position).value_or(otherwise);
  }
  /// For arguments that count as not given, too, if they are infinite or not a number.
  double finite_number(const char* name, int position, double otherwise) {
    const double n = number(name, position, otherwise);
    if (std::isfinite(n)) return n;
    pass_over(name, "must be finite");
    return otherwise;
  }
  /// Half of the diameter if that is given, else the radius.
  double radius(const char* diameter, const char* radius, int position, double otherwise) {
    const auto d = number(diameter, -1);
    return d ? 0.5 * *d : number(radius, position, otherwise);
  }
  /// The value as two numbers; nothing, unreported, for anything else.
  static std::optional<FlatPoint> pair(const ScadValue& value) {
    const ScadList* list = value.list();
    if (list == nullptr || list->size() != 2) return std::nullopt;
    const double *x = (*list)[0].number(), *y = (*list)[1].number();
    if (x == nullptr || y == nullptr) return std::nullopt;
    return FlatPoint{*x, *y};
  }
  bool boolean(const char* name, int position) {
    const ScadValue* value = module_.argument(name, position);
    if (value == nullptr) return false;
    if (const bool* b = value->boolean()) return *b;
    pass_over(name, "must be true or false");
    return false;
  }
  /// The value as three numbers; nothing, unreported, for anything else.
  static std::optional<Vec3> vector(const ScadValue& value) {
    const ScadList* list = value.list();
    if (list == nullptr || list->size() != 3) return std::nullopt;
    Vec3 v;
    for (int a = 0; a < 3; ++a) {
      const double* n = (*list)[static_cast<std::size_t>(a)].number();
      if (n == nullptr) return std::nullopt;
      v[a] = *n;
    }
    return v;
  }
  /// Null, and the part is left out, if the value is no list.
  const ScadList* list(const char* name, int position) {
    const ScadValue* value = module_.argument(name, position);
    if (value != nullptr && value->list() != nullptr) return value->list();
    leave_out(name, std::string(name) + " must be a list");
    return nullptr;
  }

  /// The argument counts as not given because of this.
  void pass_over(const std::string& name, const std::string& why) {
    report_.leave_out(
        module_.name + "() " + name, module_.line,
        module_.name + "(): " + name + " " + why + "; as in OpenSCAD it counts as not given");
  }
  /// The part is missing because of this; `kind` is what parts that are missing for the same reason
  /// have in common.
  void leave_out(const std::string& kind, const std::string& why) {
    report_.leave_out(module_.name + "() " + kind, module_.line,
                      module_.name + "() is left out: " + why);
    ok_ = false;
  }
  /// A warning about what is ignored; the part stays.
  void ignore(const std::string& kind, const std::string& what) {
    report_.warning(module_.name + "() " + kind, module_.line, module_.name + "(): " + what);
  }
  /// True, with a warning, if OpenSCAD makes nothing of this; true also if it is left out already.
  bool empty_unless(bool solid, const char* why) {
    if (ok_ && !solid) report_.warning(module_.line, module_.name + "() is left out: " + why);
    return !ok_ || !solid;
  }

 private:
  const ScadModule& module_;
  OpenscadReport& report_;
  bool ok_ = true;
};

/// How finely OpenSCAD makes something round.
struct ScadFineness {
  double fn = 0, fa = 12, fs = 2;
};
ScadFineness fineness_of(ScadArguments& arguments);
/// The sides of a circle of that radius in OpenSCAD: at least 3, at most kMaxOpenscadSides.
int fragments(double radius, const ScadFineness& fineness);

/// The sides that an explicit $fn below 9 asks for, because then the corners are intended; 0 if the
/// solid is to be round.
int asked_sides(const ScadFineness& fineness);

}  // namespace graycube
