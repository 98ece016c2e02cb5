// LiveCommands::note_command: a command that was found, into a recording of inputs.
#include "inputs/physics_records.h"
#include "inputs/recorder.h"
#include "model/detail/live_commands.h"
#include "model/detail/state_bytes.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"

namespace ambf::model {

void LiveCommands::note_command(const CommandSlots& slots, const CommandSlot& slot, std::int64_t posted_ns) {
  const PostedCommand& posted = slot.latest.value();
  if (!std::holds_alternative<state::KindCommand>(posted.command)) {
    record_->add(inputs::CommandRef{slots.object(), slot.source, posted.received_ns, posted_ns, posted.command});
    return;
  }
  recorded_bytes_.clear();
  StateWriter writer(recorded_bytes_);
  kind_of(slots.kind()).transfer(writer, const_cast<state::Command&>(posted.command));  // a writer changes nothing
  record_->add(inputs::KindCommandRef{slots.object(), slot.source, posted.received_ns, posted_ns, recorded_bytes_});
}

}  // namespace ambf::model
