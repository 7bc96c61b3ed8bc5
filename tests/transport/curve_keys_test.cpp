#include "transport/curve_keys.hpp"

#include <set>

#include "catch.hpp"

namespace graycube {
namespace {

TEST_CASE("all that is derived from a farm's key differs, and is the same each time") {
  const Secret key = make_secret();
  const FarmKeys keys = farm_keys_of(key), again = farm_keys_of(key);
  const std::set<Secret> secrets{key, keys.node_secret, keys.nodes.secret_key,
                                 keys.clients.secret_key, keys.door.secret_key};
  CHECK(secrets.size() == 5);
  CHECK(again.node_secret == keys.node_secret);
  CHECK(again.door.public_key == keys.door.public_key);
  CHECK(farm_keys_of(make_secret()).door.public_key != keys.door.public_key);
}

TEST_CASE("keys of files that were written before stay what they were") {
  // Of the key 00 01 02 … 1f, as this program first derived them.
  Secret key;
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::byte>(i);
  const FarmKeys keys = farm_keys_of(key);
  CHECK(hex_of(keys.node_secret) ==
        "3eef9e8fe1336c686ddabed92e0d14cc74a17b6e8e67b5a7572caac95fcac79a");
  CHECK(hex_of(keys.nodes.public_key) ==
        "8dbdfa206fc1b0f4b35e1b74bc6180e1b8a59db90191f72e87248f0f5ba30e40");
  CHECK(hex_of(keys.clients.public_key) ==
        "adae54b6fb17814455ac2fa0c8e3104c4902d65df2f86fe9db534e18e8f04d18");
  CHECK(hex_of(keys.door.public_key) ==
        "710023255d2b95d6170bae4b80ac19c50d20d69f5378809eabe581dd9cf62928");
}

TEST_CASE("a node's secret is enough for the nodes' pair") {
  const FarmKeys keys = farm_keys_of(make_secret());
  CHECK(node_pair_of(keys.node_secret).secret_key == keys.nodes.secret_key);
  CHECK(node_pair_of(keys.node_secret).public_key == keys.nodes.public_key);
}

}  // namespace
}  // namespace graycube
