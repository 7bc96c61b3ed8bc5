#include "transport/curve_keys.hpp"

#include <sodium.h>

#include "check.hpp"

namespace graycube {
namespace {

/// What is derived, by number. A farm's key and files of keys outlive programs, so neither these
/// nor the contexts ever change.
enum Derived : std::uint64_t { kNodeSecret = 1, kClients = 2, kDoor = 3, kNodes = 1 };
constexpr char kOfFarm[crypto_kdf_CONTEXTBYTES + 1] = "graycube";
constexpr char kOfNodes[crypto_kdf_CONTEXTBYTES + 1] = "gc-nodes";

static_assert(sizeof(Secret) == crypto_kdf_KEYBYTES);
static_assert(sizeof(CurveKey) == crypto_scalarmult_SCALARBYTES);

const unsigned char* bytes(const std::array<std::byte, 32>& key) {
  return reinterpret_cast<const unsigned char*>(key.data());
}
unsigned char* bytes(std::array<std::byte, 32>& key) {
  return reinterpret_cast<unsigned char*>(key.data());
}

/// Chooses the fastest ways for this machine; any thread may, any number of times.
void begin_sodium() {
  static const int begun = ::sodium_init();
  GRAYCUBE_CHECK(begun >= 0, "libsodium: %d", begun);
}

std::array<std::byte, 32> derive(const Secret& key, Derived which, const char* context) {
  begin_sodium();
  std::array<std::byte, 32> derived;
  const int failed =
      crypto_kdf_derive_from_key(bytes(derived), derived.size(), which, context, bytes(key));
  GRAYCUBE_CHECK(failed == 0, "no key can be derived: %d", failed);
  return derived;
}

}  // namespace

CurvePair pair_of(const CurveKey& secret_key) {
  begin_sodium();
  CurvePair pair{{}, secret_key};
  const int failed = crypto_scalarmult_base(bytes(pair.public_key), bytes(secret_key));
  GRAYCUBE_CHECK(failed == 0, "no public key: %d", failed);
  return pair;
}

FarmKeys farm_keys_of(const Secret& farm_key) {
  FarmKeys keys;
  keys.node_secret = derive(farm_key, kNodeSecret, kOfFarm);
  keys.nodes = node_pair_of(keys.node_secret);
  keys.clients = pair_of(derive(farm_key, kClients, kOfFarm));
  keys.door = pair_of(derive(farm_key, kDoor, kOfFarm));
  return keys;
}

CurvePair node_pair_of(const Secret& node_secret) {
  return pair_of(derive(node_secret, kNodes, kOfNodes));
}

ClientKeys client_keys_of(const FarmKeys& keys) {
  return {keys.clients.secret_key, keys.door.public_key};
}

CurveAccess access_between_nodes(const CurvePair& nodes) { return {nodes, nodes.public_key}; }
CurveAccess access_of_node(const FarmKeys& keys) { return {keys.nodes, keys.door.public_key}; }
CurveAccess access_of_client(const ClientKeys& keys) {
  return {pair_of(keys.client_secret), keys.door_public};
}

}  // namespace graycube
