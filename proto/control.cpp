#include "proto/control.hpp"

#include <array>
#include <type_traits>
#include <utility>

#include "proto/control_names.hpp"

namespace graycube {
namespace {

template <class Variant>
struct TypesOf;
template <class... Message>
struct TypesOf<std::variant<Message...>> {
  static constexpr std::array<std::string_view, sizeof...(Message)> kAll{Message::kType...};
};

}  // namespace

std::string_view type_of(const ControlMessage& message) {
  return TypesOf<ControlMessage>::kAll[message.index()];
}

std::span<const std::string_view> control_types() { return TypesOf<ControlMessage>::kAll; }

std::string_view to_string(Algorithm value) { return control_names::name_of(value); }
std::string_view to_string(Grain value) { return control_names::name_of(value); }
std::string_view to_string(ShadowMode value) { return control_names::name_of(value); }
std::string_view to_string(PartitionMode value) { return control_names::name_of(value); }
std::string_view to_string(FlowMode value) { return control_names::name_of(value); }
std::string_view to_string(SumsMode value) { return control_names::name_of(value); }
std::string_view to_string(ReturnsMode value) { return control_names::name_of(value); }
std::string_view to_string(BoundariesMode value) { return control_names::name_of(value); }
std::string_view to_string(Subdivision value) { return control_names::name_of(value); }
std::string_view to_string(Entry value) { return control_names::name_of(value); }
std::string_view to_string(JobState value) { return control_names::name_of(value); }
std::string_view to_string(NodeState value) { return control_names::name_of(value); }
std::string_view to_string(FailureCode value) { return control_names::name_of(value); }

}  // namespace graycube
