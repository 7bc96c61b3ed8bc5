#include "formats/graycube/read_scene.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>
#include <utility>

#include "formats/graycube/expansion.hpp"
#include "formats/graycube/read_csg.hpp"
#include "formats/graycube/read_material.hpp"
#include "formats/graycube/read_settings.hpp"
#include "formats/json/access.hpp"
#include "formats/json/cbor_fast_reader.hpp"
#include "formats/json/error_report.hpp"
#include "formats/json/name_table.hpp"
#include "formats/json/tree.hpp"
#include "scene/limits.hpp"
#include "spelling.hpp"
#include "written_digits.hpp"

namespace graycube {
namespace {

constexpr std::uint32_t kFormatVersion = 1;
static_assert(kMaxSceneBytes <= kMaxJsonBytes);
/// Bytes of the shortest object, {"csg": {"type": …}}, in CBOR.
constexpr std::size_t kLeastObjectBytes = 12;

/// The keys of the file's root.
enum RootKey : std::size_t {
  kGraycube,
  kDigits,
  kImage,
  kCamera,
  kBackground,
  kAmbient,
  kMaxDepthKey,
  kMinWeight,
  kLights,
  kMaterials,
  kShapes,
  kObjects,
  kRootKeys
};
constexpr std::array<KeyRule, kRootKeys> kRootRules{{{"graycube", true},
                                                     {"digits"},
                                                     {"image", true},
                                                     {"camera", true},
                                                     {"background"},
                                                     {"ambient"},
                                                     {"max_depth"},
                                                     {"min_weight"},
                                                     {"lights", true},
                                                     {"materials"},
                                                     {"shapes"},
                                                     {"objects", true}}};

class SceneReader {
 public:
  SceneReader(const PaddedText& text, const MeshLoader& load)
      : text_(text.view()), tree_(text), errors_(tree_), json_(tree_, errors_) {
    set_loader(load);
  }
  /// A reader that only read_in_pieces() may use.
  SceneReader(std::string_view cbor, const MeshLoader& load)
      : text_(cbor), tree_(cbor, JsonTree::Unread{}), errors_(tree_), json_(tree_, errors_) {
    set_loader(load);
    pieces_.emplace(tree_);
  }

  /// Reads without the whole tree, which is more than half of the work. Nothing when anything is
  /// wrong or unusual, for which the whole tree is needed.
  std::optional<ReadResult> read_in_pieces() {
    if (!pieces_->read_up_to(kRootRules[kObjects].name)) return std::nullopt;
    json_.members(0, "a scene", kRootRules, root_);
    read_root();
    if (!errors_.empty() || !pieces_->is_at_end()) return std::nullopt;
    return ReadResult{std::move(scene_), {}, used_files_, true};
  }

  ReadResult read() {
    if (tree_.syntax_error()) return {std::nullopt, {syntax_error()}};
    json_.members(0, "a scene", kRootRules, root_);
    if (tree_.kind(0) == JsonKind::kObject) read_root();
    if (!errors_.empty()) return {std::nullopt, errors_.take(text_), used_files_};
    return {std::move(scene_), {}, used_files_};
  }

 private:
  void set_loader(const MeshLoader& load) {
    if (!load) return;
    load_mesh_ = [this, &load](std::string_view file) {
      used_files_ = true;
      return load(file);
    };
  }

  SceneError syntax_error() const {
    const auto& error = *tree_.syntax_error();
    if (tree_.is_cbor()) {
      return {tree_.pointer(error.value),
              "byte " + std::to_string(error.offset) + ": " + error.message, 0, 0};
    }
    const TextPosition p = text_positions(text_, {error.offset}).front();
    return {tree_.pointer(error.value),
            "line " + std::to_string(p.line) + ", column " + std::to_string(p.column) + ": " +
                error.message,
            p.line, p.column};
  }

  void read_root() {
    RenderSettings& s = scene_.settings;
    std::uint32_t version = 0;
    json_.read_optional(root_[kGraycube], version, kFormatVersion, kFormatVersion);
    json_.read_optional(root_[kDigits], scene_.digits, 1u, kMaxDigits);
    if (root_[kImage] != 0) read_image(json_, root_[kImage], s.image);
    if (root_[kCamera] != 0) read_camera(json_, root_[kCamera], s.camera);
    json_.read_optional(root_[kBackground], s.background);
    json_.read_optional(root_[kAmbient], s.ambient);
    json_.read_optional(root_[kMaxDepthKey], s.max_depth, 0u, kMaxDepth);
    json_.read_optional(root_[kMinWeight], s.min_weight, kNotNegative);
    if (root_[kLights] != 0) read_lights(json_, root_[kLights], s.lights);
    read_materials();
    const auto shapes_at = read_names(root_[kShapes], kMaxShapes, "shapes", shape_names_);
    read_trees(shapes_at);
  }

  /// Enters the members' names; returns the place of each new one.
  std::vector<JsonIndex> read_names(JsonIndex at, std::uint32_t limit, const char* what,
                                    NameTable& names) {
    std::vector<JsonIndex> places;
    if (at == 0 || !json_.is_object(at)) return places;
    if (tree_.size(at) > limit) {
      errors_.add(at, "expected at most " + std::to_string(limit) + " " + what + ", found " +
                          std::to_string(tree_.size(at)));
      return places;
    }
    for (JsonIndex m = tree_.first_child(at); m != tree_.end(at); m = tree_.next(m)) {
      if (names.add(tree_.key(m)))
        places.push_back(m);
      else
        errors_.add(m, "duplicate key " + quoted(tree_.key(m)));
    }
    return places;
  }

  void read_materials() {
    for (const JsonIndex at :
         read_names(root_[kMaterials], kMaxMaterials, "materials", material_names_)) {
      auto& named = scene_.materials.emplace_back();
      named.name = tree_.key(at);
      read_material(json_, at, named.material);
    }
    const auto media = static_cast<std::size_t>(
        std::count_if(scene_.materials.begin(), scene_.materials.end(),
                      [](const NamedMaterial& m) { return attenuates(m.material); }));
    if (media > kMaxMedia)
      errors_.add(root_[kMaterials], "expected at most " + std::to_string(kMaxMedia) +
                                         " materials with \"attenuation\", found " +
                                         std::to_string(media));
  }

  void read_trees(const std::vector<JsonIndex>& shapes_at) {
    CsgReader csg(json_, material_names_, shape_names_, load_mesh_);
    std::vector<TreeSummary> shapes, objects;
    scene_.shapes.resize(shapes_at.size());
    for (std::size_t i = 0; i < shapes_at.size(); ++i) {
      scene_.shapes[i].name = tree_.key(shapes_at[i]);
      shapes.push_back(csg.read_shape(shapes_at[i], scene_.shapes[i].node));
    }
    const JsonIndex list = root_[kObjects];
    if (list == 0 || !json_.is_array(list)) return;
    if (tree_.size(list) > kMaxObjects) {
      json_.wrong(list, "at most " + std::to_string(kMaxObjects) + " objects");
      return;
    }
    // When read in pieces, the array's size is only a claim that may be too large.
    if (pieces_ && tree_.size(list) > text_.size() / kLeastObjectBytes) return give_up(list);
    scene_.objects.reserve(tree_.size(list));
    // Objects without refs and repeats need no expansion of their own: one summary holds them all.
    TreeSummary plain;
    JsonIndex at = tree_.first_child(list);
    for (std::uint32_t i = 0; i < tree_.size(list); ++i) {
      if (pieces_ && (!errors_.empty() || !pieces_->read_element(at))) return give_up(list);
      TreeSummary summary = read_object(csg, at, scene_.objects.emplace_back());
      at = tree_.next(at);
      if (!summary.uses.empty() || !summary.repeats.empty()) {
        objects.push_back(std::move(summary));
        continue;
      }
      plain.counts.add(summary.counts);
    }
    objects.push_back(std::move(plain));
    check_expansion(tree_, errors_, shape_names_, shapes, objects, list);
  }

  void give_up(JsonIndex at) { errors_.add(at, "unusual"); }

  TreeSummary read_object(CsgReader& csg, JsonIndex at, SceneObject& out) {
    enum : std::size_t { kName, kMaterial, kCsg, kKeys };
    constexpr std::array<KeyRule, kKeys> kRules{{{"name"}, {"material"}, {"csg", true}}};
    std::array<JsonIndex, kKeys> member{};
    json_.members(at, "an object", kRules, member);
    std::string_view name;
    if (json_.read_optional(member[kName], name)) out.name = name;
    if (member[kMaterial] != 0) out.material = csg.read_material_name(member[kMaterial]);
    if (member[kCsg] == 0) return {};
    return csg.read_object(member[kCsg], out.csg, member[kMaterial] != 0);
  }

  std::string_view text_;
  JsonTree tree_;
  std::optional<FastCborReader> pieces_;
  ErrorReport errors_;
  JsonAccess json_;
  std::array<JsonIndex, kRootKeys> root_{};
  NameTable material_names_, shape_names_;
  MeshLoader load_mesh_;
  bool used_files_ = false;
  Scene scene_;
};

ReadResult failure(std::string message) { return {std::nullopt, {{"", std::move(message)}}}; }

std::string too_large() {
  return "the file is larger than " + std::to_string(kMaxSceneBytes) + " bytes";
}

}  // namespace

ReadResult read_scene_text(const PaddedText& json, const MeshLoader& load) {
  if (json.view().size() > kMaxSceneBytes) return failure(too_large());
  if (json.view().starts_with(kCborMagic)) {
    if (auto quick = SceneReader(json.view(), load).read_in_pieces()) return std::move(*quick);
  }
  return SceneReader(json, load).read();
}

ReadResult read_scene_text(std::string_view json) {
  if (json.size() > kMaxSceneBytes) return failure(too_large());
  return read_scene_text(PaddedText(json));
}

ReadResult read_scene_file(const std::filesystem::path& path) {
  // In pieces, as pipes have no size; a regular file's size is checked before memory is taken.
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  static_assert(kPiece >= kTextPadding);
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    return failure("cannot read the file: it is a directory");
  const auto size = std::filesystem::file_size(path, error);
  const bool has_size = !error;
  if (has_size && size > kMaxSceneBytes) return failure(too_large());
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    const bool exists = std::filesystem::exists(path, error);
    return failure(exists ? "cannot open the file for reading" : "there is no such file");
  }
  std::string text;
  if (has_size) text.reserve(size + kPiece);
  while (file && text.size() <= kMaxSceneBytes) {
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    file.read(text.data() + before, static_cast<std::streamsize>(kPiece));
    text.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) return failure("reading the file failed");
  return read_scene_text(PaddedText(std::move(text)), mesh_files_beside(path));
}

}  // namespace graycube
