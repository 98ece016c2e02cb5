// Any bytes as a recording of inputs, and as each type of record in one: values or a refusal, never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "inputs/device_records.h"
#include "inputs/physics_records.h"
#include "inputs/recording.h"

namespace {

using namespace ambf::inputs;

// libFuzzer reports an abort with its input.
void require(bool good) {
  if (!good) std::abort();
}

// What is accepted is written again to the same bytes.
template <class Record>
void check(const Bytes& bytes) {
  const auto record = RawRecord{Record::kType, bytes}.as<Record>();
  if (!record) return;
  Bytes again;
  require(append(again, 0, *record, true));
  require(Bytes(again.begin() + sizeof(RecordHead), again.end()) == bytes);
}

template <class... Records>
void check_each(const Bytes& bytes) {
  (check<Records>(bytes), ...);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_each<SessionRecord, DeviceRecord, SceneChangeRecord, GapRecord, IterationRecord, TakeRecord, PublishedRecord,
             SceneRequestRecord, PauseRecord, ResetRecord, ParameterRecord, PushRecord, GravityRecord, HoldRecord,
             LensRecord, BeamRecord, PickRecord, SetPointRecord, EffectorEndedRecord, CommandRecord, KindCommandRecord,
             CommandKeptRecord, CommandLastingRecord, PickTargetRecord, PickEndedRecord, CycleRecord, BindingRecord>(
      Bytes(data, data + size));
  std::string problem;
  const auto recording = Recording::read(std::make_unique<std::istringstream>(std::string(data, data + size)), problem);
  require((recording == nullptr) == !problem.empty());
  if (recording == nullptr) return 0;
  for (const Stream stream : {kPhysicsStream, kSceneStream, kFirstDeviceStream}) {
    while (const RawRecord* raw = recording->next(stream)) {
      check_each<SessionRecord, DeviceRecord, SceneChangeRecord, IterationRecord, CommandRecord, CycleRecord>(
          raw->bytes);
    }
  }
  return 0;
}
