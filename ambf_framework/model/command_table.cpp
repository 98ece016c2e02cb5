#include "model/command_table.h"

#include "base/clock.h"
#include "model/detail/command_slots.h"
#include "model/detail/state_bytes.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"

namespace ambf::model {
namespace {

class Port : public state::CommandPort {
 public:
  Port(std::shared_ptr<CommandSlots> slots, CommandSlot& slot, CommandTable& table)
      : slots_(std::move(slots)), slot_(slot), table_(table) {}

  void post(const state::Command& command) override { post(command, base::steady_ns()); }
  void post(const state::Command& command, std::int64_t received_ns) override {
    // A command for another kind of object is the caller's mistake; it must not reach the object.
    if (!kind_of(slots_->kind()).accepts(command)) {
      slots_->count_refused();
    } else {
      const double since_s = base::to_seconds(received_ns - slot_.received_ns);
      if (since_s >= 0.0 && since_s <= table_.watchdog_s()) slot_.periods.add(since_s, received_ns);
      slot_.received_ns = received_ns;
      PostedCommand& posted = slot_.latest.begin_write();
      posted.command = command;
      posted.received_ns = received_ns;
      posted.period = slot_.periods.last();
      slot_.latest.commit(base::steady_ns());
    }
    table_.mark(slots_->object().index);
  }
  void keep_alive() override {
    slot_.latest.keep_alive(base::steady_ns());
    table_.mark(slots_->object().index);
  }
  void hold() override { slot_.lasting.store(true, std::memory_order_release); }
  void release() override {
    slot_.lasting.store(false, std::memory_order_release);
    slot_.latest.release();
    table_.mark(slots_->object().index);
  }

 private:
  std::shared_ptr<CommandSlots> slots_;
  CommandSlot& slot_;
  CommandTable& table_;
};

}  // namespace

CommandTable::CommandTable(double watchdog_s) : watchdog_s_(watchdog_s) {}

CommandTable::~CommandTable() = default;

std::unique_ptr<state::CommandPort> CommandTable::bind(state::ObjectId object, state::Source source) {
  const int number = static_cast<int>(source);
  if (number < 0 || number >= base::kMaxSources) return nullptr;
  std::shared_ptr<CommandSlots> slots = slots_of(object);
  if (slots == nullptr) return nullptr;
  CommandSlot& slot = slots->find_or_make(number);
  return std::make_unique<Port>(std::move(slots), slot, *this);
}

std::shared_ptr<CommandSlots> CommandTable::slots_of(state::ObjectId object) {
  const std::lock_guard lock(mutex_);
  if (object.index >= by_index_.size()) return nullptr;
  const std::shared_ptr<CommandSlots>& slots = by_index_[object.index];
  return slots != nullptr && slots->object() == object ? slots : nullptr;
}

CommandSlot* CommandTable::slot_of(state::ObjectId object, state::Source source) {
  const std::shared_ptr<CommandSlots> slots = slots_of(object);
  return slots == nullptr ? nullptr : &slots->find_or_make(static_cast<int>(source));
}

bool CommandTable::replay(const Replayed& posted, const state::Command& command) {
  const std::shared_ptr<CommandSlots> slots = slots_of(posted.object);
  if (slots == nullptr || !kind_of(slots->kind()).accepts(command)) return false;
  CommandSlot& slot = slots->find_or_make(static_cast<int>(posted.source));
  slot.latest.post({command, posted.received_ns, {}}, posted.posted_ns);
  mark(posted.object.index);
  return true;
}

bool CommandTable::replay(const Replayed& posted, const std::vector<std::uint8_t>& kind_command) {
  const std::shared_ptr<CommandSlots> slots = slots_of(posted.object);
  if (slots == nullptr) return false;
  StateReader reader(kind_command.data(), kind_command.size());
  state::Command command;
  kind_of(slots->kind()).transfer(reader, command);
  return reader.good() && reader.left() == 0 && std::holds_alternative<state::KindCommand>(command) &&
         replay(posted, command);
}

bool CommandTable::replay_kept(const Replayed& kept) {
  CommandSlot* slot = slot_of(kept.object, kept.source);
  if (slot == nullptr) return false;
  slot->latest.keep_alive(kept.posted_ns);
  mark(kept.object.index);
  return true;
}

bool CommandTable::replay_ended(state::ObjectId object, state::Source source) {
  CommandSlot* slot = slot_of(object, source);
  if (slot == nullptr) return false;
  slot->latest.release();
  mark(object.index);
  return true;
}

bool CommandTable::replay_lasting(state::ObjectId object, state::Source source, bool lasting) {
  CommandSlot* slot = slot_of(object, source);
  if (slot != nullptr) slot->lasting.store(lasting, std::memory_order_release);
  return slot != nullptr;
}

void CommandTable::count_refused(state::ObjectId object) {
  const std::shared_ptr<CommandSlots> slots = slots_of(object);
  if (slots == nullptr) return;
  slots->count_refused();
  mark(object.index);
}

std::shared_ptr<CommandSlots> CommandTable::add(state::ObjectId object, state::ObjectKind kind) {
  auto slots = std::make_shared<CommandSlots>(object, kind);
  const std::lock_guard lock(mutex_);
  if (by_index_.size() <= object.index) by_index_.resize(object.index + 1);
  by_index_[object.index] = slots;
  return slots;
}

void CommandTable::remove(state::ObjectId object) {
  const std::lock_guard lock(mutex_);
  if (object.index < by_index_.size()) by_index_[object.index].reset();
}

}  // namespace ambf::model
