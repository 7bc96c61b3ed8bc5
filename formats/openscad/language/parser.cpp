#include "formats/openscad/language/parser.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "formats/openscad/language/lexer.hpp"
#include "geometry/infinity.hpp"

namespace graycube {
namespace {

using Kind = ScadToken::Kind;

constexpr std::size_t kMaxQuotedLength = 40;
constexpr const char* kHint =
    "; this reader takes .csg files as `openscad -o MODEL.csg MODEL.scad` writes them";

std::string described(const ScadToken& token) {
  switch (token.kind) {
    case Kind::kEnd: return "the end of the file";
    case Kind::kIdentifier:
    case Kind::kSymbol: return "'" + std::string(token.text.substr(0, kMaxQuotedLength)) + "'";
    case Kind::kNumber: return "a number";
    case Kind::kString: return "a string";
    case Kind::kBad: break;
  }
  return {};
}

/// The value that the word stands for; no argument is called by one of these words.
std::optional<ScadValue> constant(std::string_view name) {
  if (name == "true") return ScadValue{true};
  if (name == "false") return ScadValue{false};
  if (name == "undef") return ScadValue{};
  if (name == "inf") return ScadValue{kInf};
  if (name == "nan") return ScadValue{std::numeric_limits<double>::quiet_NaN()};
  return std::nullopt;
}

/// Recursive descent with one token of look-ahead. Functions that return false have reported why.
class Parser {
 public:
  Parser(std::string_view text, OpenscadReport& report, const ScadLimits& limits)
      : limits_(limits), lexer_(text), report_(report) {
    advance();
  }

  std::vector<ScadModule> file() {
    std::vector<ScadModule> modules;
    while (token_.kind != Kind::kEnd) {
      statement(modules);
      if (token_.is("}")) {
        fail("a '}' that closes nothing");
        advance();
      }
    }
    return modules;
  }

 private:
  void advance() { token_ = stopped_ ? ScadToken{} : lexer_.next(); }

  bool fail(const std::string& message) {
    if (!stopped_) report_.error(token_.line, message);
    return false;
  }
  bool unexpected(const std::string& wanted, const char* hint = "") {
    if (token_.kind == Kind::kBad) return fail(lexer_.trouble() + hint);
    return fail("expected " + wanted + ", found " + described(token_) + hint);
  }
  /// A limit is exceeded: the rest of the text isn't examined.
  bool stop(const std::string& message) {
    fail(message);
    stopped_ = true;
    token_ = {};
    return false;
  }
  bool take(std::string_view symbol) {
    if (!token_.is(symbol)) return false;
    advance();
    return true;
  }

  /// Appends at most one module; consumes at least a token unless it stands before a '}'.
  void statement(std::vector<ScadModule>& modules) {
    if (take(";") || token_.is("}")) return;
    if (++module_count_ > limits_.modules) {
      stop("more than " + std::to_string(limits_.modules) + " modules");
      return;
    }
    if (++depth_ > kMaxOpenscadNesting) {
      stop("modules nested more than " + std::to_string(kMaxOpenscadNesting) + " deep");
      return;
    }
    ScadModule module;
    if (header(module) && tail(module)) {
      modules.push_back(std::move(module));
    } else {
      recover(module);
      modules.push_back(std::move(module));
    }
    --depth_;
  }

  bool header(ScadModule& module) {
    while (token_.is("%") || token_.is("*") || token_.is("!") || token_.is("#")) {
      module.left_out = module.left_out || token_.is("%") || token_.is("*");
      module.root = module.root || token_.is("!");
      advance();
    }
    module.line = token_.line;
    if (token_.kind != Kind::kIdentifier) return unexpected("the name of a module");
    module.name = token_.text;
    advance();
    if (!take("("))
      return unexpected("'(' after " + module.name.substr(0, kMaxQuotedLength), kHint);
    return arguments(module);
  }

  bool tail(ScadModule& module) {
    if (take(";")) return true;
    if (token_.is("{")) return block(module);
    if (token_.is("}") || token_.kind == Kind::kEnd) return unexpected("';' or '{'");
    statement(module.children);
    return true;
  }

  bool block(ScadModule& module) {
    const int opened = token_.line;
    advance();
    while (!token_.is("}") && token_.kind != Kind::kEnd) statement(module.children);
    if (take("}")) return true;
    return fail("the '{' of line " + std::to_string(opened) + " is never closed");
  }

  /// Skips the rest of a broken statement. Its children are kept, as a group, so that their errors
  /// show too.
  void recover(ScadModule& module) {
    module.name = "group";
    module.arguments.clear();
    while (token_.kind != Kind::kEnd && !token_.is("}")) {
      if (take(";")) return;
      if (token_.is("{")) {
        block(module);
        return;
      }
      advance();
    }
  }

  bool arguments(ScadModule& module) {
    if (take(")")) return true;
    while (true) {
      ScadArgument argument;
      if (token_.kind == Kind::kIdentifier && !constant(token_.text)) {
        argument.name = token_.text;
        advance();
        if (!take("="))
          return unexpected("'=' after " + argument.name.substr(0, kMaxQuotedLength), kHint);
      }
      if (!value(argument.value, 0)) return false;
      module.arguments.push_back(std::move(argument));
      if (take(")")) return true;
      if (!take(",")) return unexpected("',' or ')'", kHint);
    }
  }

  bool value(ScadValue& result, int list_depth) {
    if (++value_count_ > limits_.values) {
      return stop("more than " + std::to_string(limits_.values) + " values");
    }
    if (token_.is("[")) return list(result, list_depth + 1);
    const bool negative = take("-");
    if (token_.kind == Kind::kNumber) {
      result.value = token_.number;
    } else if (token_.kind == Kind::kString && !negative) {
      result.value = std::string(token_.text);
    } else if (auto word = token_.kind == Kind::kIdentifier ? constant(token_.text) : std::nullopt;
               word && (!negative || word->number() != nullptr)) {
      result = std::move(*word);
    } else {
      return unexpected("a value", kHint);
    }
    if (negative) result.value = -*result.number();
    advance();
    return true;
  }

  bool list(ScadValue& result, int list_depth) {
    if (list_depth > kMaxOpenscadListNesting) {
      return stop("lists nested more than " + std::to_string(kMaxOpenscadListNesting) + " deep");
    }
    advance();
    ScadList items;
    while (!take("]")) {
      if (!items.empty() && !take(",")) return unexpected("',' or ']'", kHint);
      ScadValue item;
      if (!value(item, list_depth)) return false;
      items.push_back(std::move(item));
    }
    result.value = std::move(items);
    return true;
  }

  ScadLimits limits_;
  ScadLexer lexer_;
  OpenscadReport& report_;
  ScadToken token_;
  bool stopped_ = false;
  int depth_ = 0;
  std::size_t module_count_ = 0;
  std::size_t value_count_ = 0;
};

}  // namespace

const ScadValue* ScadModule::argument(std::string_view argument_name, int position) const {
  const ScadValue* named = nullptr;
  const ScadValue* positional = nullptr;
  for (const ScadArgument& candidate : arguments) {
    if (candidate.name == argument_name) named = &candidate.value;
    if (candidate.name.empty() && position-- == 0) positional = &candidate.value;
  }
  const ScadValue* found = named != nullptr ? named : positional;
  return found == nullptr || found->is_undef() ? nullptr : found;
}

namespace {

bool ends_in(const ScadValue* name, std::string_view ending) {
  const auto* text = name == nullptr ? nullptr : std::get_if<std::string>(&name->value);
  return text != nullptr && text->size() >= ending.size() &&
         std::equal(ending.begin(), ending.end(),
                    text->end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
}

int own_dimension(const ScadModule& module) {
  constexpr std::array<std::string_view, 5> kFlat{"square", "circle", "polygon", "text",
                                                  "projection"};
  constexpr std::array<std::string_view, 7> kSolid{
      "cube", "sphere", "cylinder", "polyhedron", "linear_extrude", "rotate_extrude", "surface"};
  if (std::find(kFlat.begin(), kFlat.end(), module.name) != kFlat.end()) return 2;
  if (std::find(kSolid.begin(), kSolid.end(), module.name) != kSolid.end()) return 3;
  if (module.name != "import") return 0;
  const ScadValue* file = module.argument("file", 0);
  return ends_in(file, ".dxf") || ends_in(file, ".svg") ? 2 : 3;
}

void note_dimensions(std::vector<ScadModule>& modules) {
  for (ScadModule& module : modules) {
    note_dimensions(module.children);
    module.dimension = own_dimension(module);
    for (const ScadModule& child : module.children) {
      if (module.dimension == 0 && !child.left_out) module.dimension = child.dimension;
    }
    // A roof stands on what is flat.
    if (module.name == "roof" && module.dimension == 2) module.dimension = 3;
  }
}

}  // namespace

std::vector<ScadModule> parse_openscad(std::string_view text, OpenscadReport& report,
                                       const ScadLimits& limits) {
  std::vector<ScadModule> modules = Parser(text, report, limits).file();
  note_dimensions(modules);
  return modules;
}

}  // namespace graycube
