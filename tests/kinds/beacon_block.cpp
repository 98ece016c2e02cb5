// The ADF block of a beacon.
#include "beacon.h"
#include "scene/block_kinds.h"

namespace ambf::test {
namespace {

using scene::Key;
using scene::KeyType;

constexpr Key kKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .member = scene::to<&Beacon::parent>(),
     .fallback = "the world",
     .meaning = "Object that it moves with."},
    {.name = "position",
     .type = KeyType::vector,
     .member = scene::to<&Beacon::position>(),
     .unit = "m",
     .meaning = "In the parent's frame."},
    {.name = "blink rate",
     .type = KeyType::number,
     .member = scene::to<&Beacon::rate_hz>(),
     .unit = "Hz",
     .meaning = "Blinks a second.",
     .rule = scene::Rule::not_negative,
     .max = kMaxBeaconRate_hz},
};
constexpr const scene::Group* kIncludes[] = {&scene::group::kIdentity};
const scene::Group kBeacon{
    .title = "beacon", .meaning = "A made-up kind.", .keys = kKeys, .includes = kIncludes, .is_block = true};

const scene::BlockKind kBeacons{
    .group = &kBeacon,
    .list = {.name = "beacons", .type = KeyType::texts, .meaning = "Beacon blocks to load."},
    .prefix = "BEACON ",
    .simulated = true,
    .make = scene::make_description<Beacon>};

const bool kRegistered = [] {
  scene::register_block_kind(kBeacons);
  return true;
}();

}  // namespace

const scene::BlockKind& beacon_blocks() { return kBeacons; }

}  // namespace ambf::test
